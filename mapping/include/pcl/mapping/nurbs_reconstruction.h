// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/surface_reconstruction.h>
#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/entropy_rate_segmentation.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace pcl {

/** \brief Turns a point cloud into trimmed NURBS surfaces: organize, segment, fit,
 * trim.
 *
 * \code pcl::NurbsReconstruction<pcl::PointXYZ> reconstruction;
 * reconstruction.setInputCloud(cloud); pcl::nurbs::SurfaceModel model; if
 * (reconstruction.reconstruct(model)) pcl::nurbs::writeNurbsFile("cloud.nurbs", model);
 * \endcode Every stage has a default and can be replaced: the raster by setGeometry(),
 * the noise by setSensorNoise(), the segmentation by setSegmentation().
 * \ingroup mapping */
template <typename PointT>
class NurbsReconstruction : public PCLBase<PointT> {
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

public:
  using Ptr = shared_ptr<NurbsReconstruction<PointT>>;
  using ConstPtr = shared_ptr<const NurbsReconstruction<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;
  using Segmentation = GridSegmentation<PointT>;

  /** \brief Wall-clock time of each stage of the last call, seconds. */
  struct Seconds {
    double organize = 0.0;
    double segment = 0.0;
    double fit = 0.0;
    double trim = 0.0;
  };

  /** \brief How a cloud that is not organized gets a raster. */
  void
  setProjection(typename CloudOrganizer<PointT>::Projection projection)
  {
    projection_ = projection;
  }

  /** \brief Raster of an organized cloud, when it is known; otherwise it is recognised
   * from the points. */
  void
  setGeometry(const GridGeometry& geometry)
  {
    geometry_ = geometry;
  }

  /** \brief Depth noise of the sensor, when it is known; otherwise it is measured. */
  void
  setSensorNoise(const SensorNoise& noise)
  {
    noise_ = noise;
  }

  /** \brief Segmentation to use; EntropyRateSegmentation if none is given, with
   * segments as small as the smallest patch. */
  void
  setSegmentation(const typename Segmentation::Ptr& segmentation)
  {
    segmentation_ = segmentation;
  }

  void
  setOptions(const nurbs::ReconstructionOptions& options)
  {
    options_ = options;
  }

  const nurbs::ReconstructionOptions&
  getOptions() const
  {
    return options_;
  }

  /** \brief Reconstruct the surfaces of the input cloud, in its frame.
   * \param[out] model patches; empty on failure
   * \return whether there is at least one patch */
  bool
  reconstruct(nurbs::SurfaceModel& model);

  /** \brief The cloud on its raster, as the last call used it. */
  const typename PointCloud::Ptr&
  getOrganizedCloud() const
  {
    return organized_;
  }

  /** \brief The raster of the last call. */
  const GridGeometry&
  getGeometry() const
  {
    return used_geometry_;
  }

  /** \brief Labels and distances per cell of the organized cloud. */
  const nurbs::Reconstruction&
  getReconstruction() const
  {
    return result_;
  }

  /** \brief Noise the last call worked with. */
  const SensorNoise&
  getUsedNoise() const
  {
    return used_noise_;
  }

  /** \brief Number of segments before fitting. */
  std::size_t
  getNumSegments() const
  {
    return num_segments_;
  }

  const Seconds&
  getSeconds() const
  {
    return seconds_;
  }

  PCL_MAKE_ALIGNED_OPERATOR_NEW

private:
  unsigned int
  numberOfThreads() const
  {
    return static_cast<unsigned int>(std::max(options_.threads, 1));
  }

  bool
  organize();

  bool
  segment();

  std::optional<GridGeometry> geometry_;
  std::optional<SensorNoise> noise_;
  typename CloudOrganizer<PointT>::Projection projection_ =
      CloudOrganizer<PointT>::AUTO;
  typename Segmentation::Ptr segmentation_;
  nurbs::ReconstructionOptions options_;

  typename PointCloud::Ptr organized_{new PointCloud};
  GridGeometry used_geometry_;
  SensorNoise used_noise_;
  std::vector<std::uint32_t> segment_labels_;
  std::size_t num_segments_ = 0;
  nurbs::Reconstruction result_;
  Seconds seconds_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/mapping/impl/nurbs_reconstruction.hpp>
#endif
