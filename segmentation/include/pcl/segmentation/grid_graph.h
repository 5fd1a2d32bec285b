// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>
#include <pcl/segmentation/sensor_noise.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How GridGraph joins the cells of a grid. */
struct GridGraphOptions {
  /** 4 (rows and columns) or 8 (diagonals too). */
  int connectivity = 8;
  /** A surface seen at grazing angle has neighbours farther apart than one that faces
   * the sensor; their distance is expected to grow up to this many times. */
  float incidence_cap = 20.0F;
  /** Number of threads; the result does not depend on it. */
  int threads = 1;
};

/** \brief Weight of paper and default: exp(-|p_i - p_j|^2 / (2 sigma_ij^2)). */
struct DistanceWeight {
  float
  operator()(std::size_t, std::size_t, float squared_distance, float variance) const
  {
    return std::exp(-0.5F * squared_distance / variance);
  }
};

/** \brief Weighted lattice graph over the points of a grid: one node per cell, edges
 * between neighbours in rows, columns and diagonals, over the seam of a grid that
 * wraps, and over at most geometry.max_gap - 1 empty cells.
 *
 * Edges are kept by direction in dense arrays: edge (d, i) joins cell i with the next
 * point in direction d. Following one direction from edge to edge walks a straight line
 * of the grid. Nothing is allocated per edge; an object that is built again keeps its
 * memory.
 * \ingroup segmentation
 */
class PCL_NURBS_SEGMENTATION_EXPORT GridGraph {
public:
  static constexpr std::int32_t kNone = -1;

  enum Direction { kRight = 0, kDown = 1, kDownRight = 2, kDownLeft = 3 };

  /** \brief Find the edges, the distance along each and the distance to be expected.
   *
   * The variance sigma_ij^2 of an edge is the squared spacing of neighbours at its
   * depth, stretched where the next edges of the same line are long as well (slope
   * continuity: a floor at grazing angle), plus the depth noise of both ends.
   * All weights are zero until setWeights(). O(cells).
   * \param[in] points organized points
   * \param[in] noise depth noise of the sensor
   * \param[in] options connectivity and limits
   * \throws std::invalid_argument when the connectivity is neither 4 nor 8 or a limit
   *         makes no sense
   */
  void
  build(const GridPoints& points,
        const SensorNoise& noise,
        const GridGraphOptions& options = {});

  /** \brief Give each edge its weight.
   * \param[in] weight policy called as weight(cell_i, cell_j, squared_distance,
   *            variance); one that looks at normals, intensity or colour holds them by
   *            cell
   */
  template <typename Weight = DistanceWeight>
  void
  setWeights(const Weight& weight = {});

  /** \brief setWeights() with DistanceWeight, by so many threads. */
  void
  setDistanceWeights(int threads);

  /** \brief Number of directions: 2 or 4. */
  int
  numDirections() const
  {
    return directions_;
  }

  /** \brief Number of nodes, empty cells included. */
  std::size_t
  numCells() const
  {
    return cells_;
  }

  /** \brief Number of edges. O(cells). */
  std::size_t
  numEdges() const;

  /** \brief Cell at the far end of each edge (d, cell), or kNone. */
  const std::vector<std::int32_t>&
  target(int direction) const
  {
    return lines_[static_cast<std::size_t>(direction)].target;
  }

  /** \brief Cell whose edge in this direction ends here, or kNone. */
  const std::vector<std::int32_t>&
  source(int direction) const
  {
    return lines_[static_cast<std::size_t>(direction)].source;
  }

  /** \brief Number of edges of a cell, whatever their weight. */
  std::size_t
  degree(std::size_t cell) const
  {
    std::size_t edges = 0;
    for (int d = 0; d < directions_; ++d)
      edges += (target(d)[cell] != kNone ? 1 : 0) + (source(d)[cell] != kNone ? 1 : 0);
    return edges;
  }

  /** \brief Squared distance of the ends of each edge. */
  const std::vector<float>&
  squaredDistance(int direction) const
  {
    return lines_[static_cast<std::size_t>(direction)].squared_distance;
  }

  /** \brief Variance sigma_ij^2 of each edge. */
  const std::vector<float>&
  variance(int direction) const
  {
    return lines_[static_cast<std::size_t>(direction)].variance;
  }

  /** \brief Weight of each edge, 0 where there is none. */
  const std::vector<float>&
  weight(int direction) const
  {
    return lines_[static_cast<std::size_t>(direction)].weight;
  }

private:
  struct Lines {
    std::vector<std::int32_t> target;
    std::vector<std::int32_t> source;
    std::vector<float> squared_distance;
    std::vector<float> variance;
    std::vector<float> weight;
  };

  void
  findEdges(const GridPoints& points, int direction);

  void
  expectDistances(const GridPoints& points,
                  const std::vector<float>& noise_variance,
                  float cap,
                  int direction);

  template <typename Weight>
  void
  setLineWeights(const Weight& weight, int direction);

  int directions_ = 0;
  std::size_t cells_ = 0;
  std::array<Lines, 4> lines_;
};

template <typename Weight>
void
GridGraph::setWeights(const Weight& weight)
{
  for (int d = 0; d < directions_; ++d)
    setLineWeights(weight, d);
}

template <typename Weight>
void
GridGraph::setLineWeights(const Weight& weight, int direction)
{
  Lines& line = lines_[static_cast<std::size_t>(direction)];
  for (std::size_t i = 0; i < cells_; ++i)
    if (line.target[i] != kNone)
      line.weight[i] = weight(i,
                              static_cast<std::size_t>(line.target[i]),
                              line.squared_distance[i],
                              line.variance[i]);
}

} // namespace nurbs
} // namespace pcl
