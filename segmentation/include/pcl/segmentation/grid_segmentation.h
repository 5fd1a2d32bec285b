// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/connected_groups.h>

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace pcl {

/** \brief Base of segmentations that work on the lattice graph of an organized cloud.
 *
 * The base finds the raster, the noise and the graph; a derived class gives every cell
 * a label in performSegmentation(). Labels are 0 = none and 1.. by decreasing size.
 * Results are the same for the same input, whatever the machine's load.
 * \ingroup segmentation
 */
template <typename PointT>
class GridSegmentation : public PCLBase<PointT> {
protected:
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

public:
  using Ptr = shared_ptr<GridSegmentation<PointT>>;
  using ConstPtr = shared_ptr<const GridSegmentation<PointT>>;

  virtual ~GridSegmentation() = default;

  /** \brief Raster of the input, when it is known (CloudOrganizer::getGeometry());
   * otherwise it is estimated from the points. */
  void
  setGeometry(const GridGeometry& geometry)
  {
    geometry_ = geometry;
  }

  /** \brief Depth noise of the sensor, when it is known; otherwise it is measured in
   * the cloud. */
  void
  setSensorNoise(const SensorNoise& noise)
  {
    noise_ = noise;
  }

  void
  setGraphOptions(const nurbs::GridGraphOptions& options)
  {
    graph_options_ = options;
  }

  const nurbs::GridGraphOptions&
  getGraphOptions() const
  {
    return graph_options_;
  }

  /** \brief Number of threads (default 1); the result does not depend on it. */
  void
  setNumberOfThreads(unsigned int threads)
  {
    graph_options_.threads = static_cast<int>(std::max(threads, 1U));
  }

  unsigned int
  getNumberOfThreads() const
  {
    return static_cast<unsigned int>(graph_options_.threads);
  }

  /** \brief Smaller segments are dropped (points). */
  void
  setMinSegmentSize(std::size_t points)
  {
    min_segment_size_ = points;
  }

  std::size_t
  getMinSegmentSize() const
  {
    return min_segment_size_;
  }

  /** \brief Segment the input cloud, which must be organized.
   * \param[out] segments point indices per segment, by decreasing size; empty on
   * failure
   */
  void
  segment(std::vector<PointIndices>& segments);

  /** \brief Label per cell of the last segment() call, 0 = none. */
  const std::vector<std::uint32_t>&
  getLabels() const
  {
    return labels_;
  }

  /** \brief Number of segments of the last call. */
  std::uint32_t
  getNumSegments() const
  {
    return count_;
  }

  /** \brief Noise the last call worked with. */
  const SensorNoise&
  getUsedNoise() const
  {
    return used_noise_;
  }

  /** \brief The input's points with their labels, organized as the input. */
  pcl::PointCloud<pcl::PointXYZL>::Ptr
  getLabelCloud() const;

  /** \brief The input's points in a colour per segment, black where there is none. */
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr
  getColoredCloud() const;

  PCL_MAKE_ALIGNED_OPERATOR_NEW

protected:
  /** \brief Label the cells.
   * \param[in] points points of the input; cells outside of the indices are empty
   * \param[in] graph their graph with the default weights
   * \param[in] noise depth noise
   * \param[out] labels label per cell
   * \return number of labels
   */
  virtual std::uint32_t
  performSegmentation(const nurbs::GridPoints& points,
                      nurbs::GridGraph& graph,
                      const SensorNoise& noise,
                      std::vector<std::uint32_t>& labels) = 0;

private:
  nurbs::GridPoints
  gatherPoints() const;

  GridGeometry
  estimateGeometry(const nurbs::GridPoints& points) const;

  std::optional<GridGeometry> geometry_;
  std::optional<SensorNoise> noise_;
  nurbs::GridGraphOptions graph_options_;
  std::size_t min_segment_size_ = 100;
  SensorNoise used_noise_;
  nurbs::GridGraph graph_;
  std::vector<std::uint32_t> labels_;
  std::uint32_t count_ = 0;
};

/** \brief Segments are connected sheets: they end at depth jumps and, by default, where
 * the surface folds. See nurbs::connectedGroups().
 * \ingroup segmentation
 */
template <typename PointT>
class ConnectedGroupsSegmentation : public GridSegmentation<PointT> {
public:
  using Ptr = shared_ptr<ConnectedGroupsSegmentation<PointT>>;
  using ConstPtr = shared_ptr<const ConnectedGroupsSegmentation<PointT>>;

  /** \brief Edges with a smaller weight are removed. */
  void
  setMinWeight(float weight)
  {
    options_.min_weight = weight;
  }

  /** \brief How many standard deviations of the noise make a depth jump. */
  void
  setJumpSigmas(float sigmas)
  {
    options_.jump_sigmas = sigmas;
  }

  /** \brief Whether segments end where the surface folds. */
  void
  setSplitCreases(bool split)
  {
    options_.split_creases = split;
  }

  /** \brief Turn of the normal (radians) that makes a fold. */
  void
  setCreaseAngle(float angle)
  {
    options_.crease_angle = angle;
  }

  const nurbs::ConnectedGroupsOptions&
  getOptions() const
  {
    return options_;
  }

protected:
  std::uint32_t
  performSegmentation(const nurbs::GridPoints& points,
                      nurbs::GridGraph& graph,
                      const SensorNoise& noise,
                      std::vector<std::uint32_t>& labels) override;

private:
  nurbs::ConnectedGroupsOptions options_;
};

namespace nurbs {

/** \brief Colour of a label: easily told apart, black for 0. */
PCL_NURBS_SEGMENTATION_EXPORT RGB
labelColor(std::uint32_t label);

} // namespace nurbs
} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/segmentation/impl/grid_segmentation.hpp>
#endif
