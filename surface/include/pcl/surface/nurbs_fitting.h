// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs_fitting_settings.h>

#include <pcl/search/search.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>

#include <vector>

namespace pcl {

/** \brief Fits one NURBS surface to a cloud, or to a segment of it.
 *
 * Degrees and knots are searched where the points show structure (salient points by
 * group testing, under an information criterion), a plane stays one bilinear patch.
 * Whatever is set (see NurbsFittingSettings) is fixed instead. Points that are not
 * finite are skipped.
 *
 * \code
 * pcl::NurbsFitting<pcl::PointXYZ> fitting;
 * fitting.setInputCloud (cloud);
 * fitting.setIndices (segment);
 * pcl::nurbs::NurbsSurface surface;
 * if (fitting.compute (surface))
 *   std::cout << fitting.getReport ().rmse << " m\n";
 * \endcode
 * \ingroup surface
 */
template <typename PointT>
class NurbsFitting : public PCLBase<PointT>, public NurbsFittingSettings {
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

public:
  using Ptr = shared_ptr<NurbsFitting<PointT>>;
  using ConstPtr = shared_ptr<const NurbsFitting<PointT>>;
  using SearchPtr = typename search::Search<PointT>::Ptr;

  /** \brief Search for neighbours in clouds that are not organized; a kd-tree if none
   * is set. */
  void
  setSearchMethod(const SearchPtr& search)
  {
    search_ = search;
  }

  SearchPtr
  getSearchMethod() const
  {
    return search_;
  }

  /** \brief Fit a surface to the input cloud (its indices, when set).
   * \param[out] surface result, untouched on failure
   * \return whether there is one; PCL_ERROR says why not, getReport() how good it is */
  bool
  compute(nurbs::NurbsSurface& surface);

  /** \brief How the last compute() went; message says what went wrong. */
  const nurbs::FitReport&
  getReport() const
  {
    return report_;
  }

  /** \brief Cloud indices of the points that the last compute() used. */
  const Indices&
  getUsedIndices() const
  {
    return used_;
  }

  PCL_MAKE_ALIGNED_OPERATOR_NEW

private:
  /** Finite points of the indices. */
  nurbs::FitPoints
  gatherPoints();

  /** Neighbourhoods of an even choice of the used points. */
  std::vector<Eigen::Matrix3Xd>
  gatherNeighbourhoods();

  Indices
  gridNeighbours(index_t centre) const;

  SearchPtr search_;
  nurbs::FitReport report_;
  Indices used_;
  std::vector<bool> is_used_; // per point of the cloud
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/nurbs_fitting.hpp>
#endif
