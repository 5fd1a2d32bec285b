// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_segmentation.h>
#include <pcl/segmentation/object_grouping.h>
#include <pcl/segmentation/point_weights.h>
#include <pcl/segmentation/segment_borders.h>
#include <pcl/segmentation/superpixels.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl {

/** \brief Segmentation of an organized cloud by a random walk on its lattice graph.
 *
 * A walker that steps to a neighbour the likelier the closer it is rarely crosses from
 * one surface to the next. Three modes:
 * - SURFACES (default): groups are the surfaces of a scene (Norouzzadeh Ravari,
 *   Taghirad, "NURBS-based Representation of Urban Environments for Mobile Robots",
 *   Algorithm 1); see nurbs::groupSurfaces();
 * - OBJECTS: surfaces that meet in convex folds together; see nurbs::groupObjects();
 * - SUPERPIXELS: K groups of similar size that keep to the edges of surfaces (Liu,
 *   Tuzel, Ramalingam, Chellappa, "Entropy Rate Superpixel Segmentation", CVPR 2011);
 *   see nurbs::entropyRateSuperpixels().
 *
 * \code
 * pcl::EntropyRateSegmentation<pcl::PointXYZRGB> segmentation;
 * segmentation.setMode (pcl::EntropyRateSegmentation<pcl::PointXYZRGB>::SUPERPIXELS);
 * segmentation.setNumberOfSuperpixels (500);
 * segmentation.setWeightFunction (pcl::nurbs::ColorWeight ());
 * segmentation.setInputCloud (organized_cloud);
 * std::vector<pcl::PointIndices> segments;
 * segmentation.segment (segments);
 * \endcode
 *
 * The cloud must be organized; segmentUnorganized() takes any. What is wrong with an
 * input is said by PCL_ERROR, and there are no segments then. The result is the same
 * for any number of threads.
 * \ingroup segmentation
 */
template <typename PointT>
class EntropyRateSegmentation : public GridSegmentation<PointT> {
  using PCLBase<PointT>::input_;

public:
  using Ptr = shared_ptr<EntropyRateSegmentation<PointT>>;
  using ConstPtr = shared_ptr<const EntropyRateSegmentation<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  enum Mode { SURFACES, SUPERPIXELS, OBJECTS };

  void
  setMode(Mode mode)
  {
    mode_ = mode;
  }

  Mode
  getMode() const
  {
    return mode_;
  }

  /** \brief How surfaces are grouped. Its min_weight, min_size and threads are not
   * used: setMinWeight(), setMinSegmentSize() and setNumberOfThreads() tell them. */
  void
  setSurfaceOptions(const nurbs::SurfaceGroupingOptions& options)
  {
    surfaces_ = options;
  }

  const nurbs::SurfaceGroupingOptions&
  getSurfaceOptions() const
  {
    return surfaces_;
  }

  /** \brief How surfaces are grouped to objects in mode OBJECTS. */
  void
  setObjectOptions(const nurbs::ObjectGroupingOptions& options)
  {
    object_options_ = options;
  }

  const nurbs::ObjectGroupingOptions&
  getObjectOptions() const
  {
    return object_options_;
  }

  /** \brief Objects of the last segment() call in mode OBJECTS, that of label k at
   * k - 1, with the labels of their surfaces; none after another mode. */
  const std::vector<nurbs::ObjectGroup>&
  getObjects() const
  {
    return objects_;
  }

  /** \brief Surface of each cell after mode OBJECTS, whose labels are objects; empty
   * after another mode. */
  const std::vector<std::uint32_t>&
  getSurfaceLabels() const
  {
    return surface_labels_;
  }

  /** \brief Models of the surfaces of the last segment() call in mode SURFACES (that of
   * label k at k - 1) or OBJECTS (that of surface label k); none after another. */
  const std::vector<nurbs::SurfaceGroup>&
  getSurfaceGroups() const
  {
    return groups_;
  }

  /** \brief Number K of superpixels (default 1000). Connected parts of the graph of
   * fewer points than setMinSegmentSize() get no label and do not count; if there are
   * more than K others, each of them is a superpixel. */
  void
  setNumberOfSuperpixels(std::size_t number)
  {
    superpixels_.number = number;
  }

  std::size_t
  getNumberOfSuperpixels() const
  {
    return superpixels_.number;
  }

  /** \brief Weight of equal sizes of superpixels (default 0.5). It is scaled by the
   * number of superpixels and by the ratio of the largest first gains of both terms
   * (Liu et al.), so that the same value suits any cloud. */
  void
  setBalance(double balance)
  {
    superpixels_.balance = balance;
  }

  double
  getBalance() const
  {
    return superpixels_.balance;
  }

  /** \brief 4 (rows and columns) or 8 (diagonals too, default) neighbours. */
  void
  setConnectivity(int connectivity);

  int
  getConnectivity() const
  {
    return this->getGraphOptions().connectivity;
  }

  /** \brief Edges with a smaller weight are removed (default 1e-4). */
  void
  setMinWeight(float weight)
  {
    min_weight_ = weight;
  }

  float
  getMinWeight() const
  {
    return min_weight_;
  }

  /** \brief Weights of edges, called as weight(p, q, squared_distance, variance) with
   * the points at the ends, their squared distance and the variance to be expected of
   * it (GridGraph::variance()). Ready-made: nurbs::NormalWeight, nurbs::IntensityWeight
   * and nurbs::ColorWeight. Values must be finite and not negative; 0 separates. */
  template <typename Weight>
  void
  setWeightFunction(const Weight& weight);

  /** \brief Weights by distance alone, the default: nurbs::DistanceWeight. */
  void
  resetWeightFunction()
  {
    set_weights_ = nullptr;
  }

  /** \brief Pairs of segments of the last segment() call that touch, with the length of
   * their border. */
  std::vector<nurbs::SegmentBorder>
  getAdjacency() const
  {
    if (this->getNumSegments() == 0)
      return {};
    return borders_;
  }

protected:
  std::uint32_t
  performSegmentation(const nurbs::GridPoints& points,
                      nurbs::GridGraph& graph,
                      const SensorNoise& noise,
                      std::vector<std::uint32_t>& labels) override;

private:
  std::uint32_t
  groupToObjects(const nurbs::GridPoints& points,
                 const nurbs::GridGraph& graph,
                 const SensorNoise& noise,
                 const nurbs::SurfaceGroupingOptions& options,
                 std::vector<std::uint32_t>& labels);

  std::uint32_t
  groupPoints(const nurbs::GridPoints& points,
              const nurbs::GridGraph& graph,
              const SensorNoise& noise,
              std::vector<std::uint32_t>& labels);

  Mode mode_ = SURFACES;
  nurbs::SurfaceGroupingOptions surfaces_;
  nurbs::SuperpixelOptions superpixels_;
  float min_weight_ = 1e-4F;
  std::function<void(nurbs::GridGraph&, const PointCloud&)> set_weights_;
  std::vector<nurbs::SegmentBorder> borders_;
  std::vector<nurbs::SurfaceGroup> groups_;
  nurbs::ObjectGroupingOptions object_options_;
  std::vector<nurbs::ObjectGroup> objects_;
  std::vector<std::uint32_t> surface_labels_;
};

template <typename PointT>
template <typename Weight>
void
EntropyRateSegmentation<PointT>::setWeightFunction(const Weight& weight)
{
  // Only the whole loop is behind a pointer, so that the weight itself is inlined.
  set_weights_ = [weight](nurbs::GridGraph& graph, const PointCloud& cloud) {
    graph.setWeights([&](std::size_t i, std::size_t j, float distance, float variance) {
      return static_cast<float>(weight(cloud[i], cloud[j], distance, variance));
    });
  };
}

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/segmentation/impl/entropy_rate_segmentation.hpp>
#endif
