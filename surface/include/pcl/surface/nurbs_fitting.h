// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/segment_fitter.h>

#include <pcl/search/search.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>

#include <vector>

namespace pcl {

/** \brief Fits one NURBS surface to a cloud, or to a segment of it.
 *
 * Degrees and knots are searched where the points show structure (salient points by
 * group testing, under an information criterion), a plane stays one bilinear patch.
 * Whatever is set is fixed instead. Points that are not finite are skipped.
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
class NurbsFitting : public PCLBase<PointT> {
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

public:
  using Ptr = shared_ptr<NurbsFitting<PointT>>;
  using ConstPtr = shared_ptr<const NurbsFitting<PointT>>;
  using SearchPtr = typename search::Search<PointT>::Ptr;
  using Parameterization = nurbs::Parameterization;

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

  void
  setParameterization(Parameterization parameterization)
  {
    options_.parameterization = parameterization;
  }

  Parameterization
  getParameterization() const
  {
    return options_.parameterization;
  }

  /** \brief Camera of Parameterization::Perspective. */
  void
  setCamera(const nurbs::PinholeCamera& camera)
  {
    options_.camera = camera;
  }

  /** \brief Fix the base: the xy plane of Parameterization::Plane, or the z axis of
   * Parameterization::Cylinder. */
  void
  setBase(const Eigen::Isometry3d& frame)
  {
    options_.base = frame;
  }

  /** \brief Fix the axis of a cylinder, or the normal of the base plane. */
  void
  setAxis(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

  /** \brief A full turn of a cylinder, whose ends meet. */
  void
  setClosed(bool closed)
  {
    options_.closed = closed;
  }

  bool
  getClosed() const
  {
    return options_.closed;
  }

  /** \brief One (u, v) per point of the input cloud, for Parameterization::Given. */
  void
  setParameters(const Eigen::Matrix2Xd& parameters)
  {
    given_ = parameters;
  }

  /** \brief Fix the degrees; 0 leaves one to the search. */
  void
  setDegree(int degree_u, int degree_v)
  {
    options_.degree_u = degree_u;
    options_.degree_v = degree_v;
  }

  /** \brief Fix degrees and knots; their domain is mapped to the box of the parameters,
   * unless those are given. */
  void
  setKnots(const nurbs::KnotVector& knots_u, const nurbs::KnotVector& knots_v)
  {
    options_.knots_u = knots_u;
    options_.knots_v = knots_v;
  }

  /** \brief Whether knots and degrees that are not fixed are searched (default), or are
   * one cubic span. */
  void
  setAdaptive(bool adaptive,
              const nurbs::KnotSearchOptions& search = nurbs::KnotSearchOptions())
  {
    options_.adaptive = adaptive;
    options_.search = search;
  }

  bool
  getAdaptive() const
  {
    return options_.adaptive;
  }

  void
  setDistance(nurbs::FitDistance distance)
  {
    options_.fit.distance = distance;
  }

  nurbs::FitDistance
  getDistance() const
  {
    return options_.fit.distance;
  }

  /** \brief Robust loss; \a scale in standard deviations of the noise. */
  void
  setLoss(nurbs::RobustLoss loss, double scale = 3.0)
  {
    options_.fit.loss = loss;
    options_.fit.loss_scale = scale;
  }

  nurbs::RobustLoss
  getLoss() const
  {
    return options_.fit.loss;
  }

  /** \brief Let the NURBS weights move as well. */
  void
  setOptimizeWeights(bool optimize)
  {
    options_.optimize_weights = optimize;
  }

  bool
  getOptimizeWeights() const
  {
    return options_.optimize_weights;
  }

  /** \brief Weight of the thin-plate energy beside the information of the points. */
  void
  setFairness(double weight)
  {
    options_.fit.fairness = weight;
  }

  double
  getFairness() const
  {
    return options_.fit.fairness;
  }

  void
  setMaximumIterations(int iterations)
  {
    options_.fit.max_iterations = iterations;
  }

  int
  getMaximumIterations() const
  {
    return options_.fit.max_iterations;
  }

  void
  addBorderConstraint(const nurbs::BorderConstraint& constraint)
  {
    options_.constraints.push_back(constraint);
  }

  void
  clearBorderConstraints()
  {
    options_.constraints.clear();
  }

  /** \brief Standard deviation of the points in metres; 0 (default) estimates it from
   * local quadrics through neighbouring points. */
  void
  setNoise(double sigma)
  {
    noise_ = sigma;
  }

  /** \brief Noise that was set or, after compute(), used, in metres. */
  double
  getNoise() const
  {
    return noise_ > 0.0 ? noise_ : used_noise_;
  }

  /** \brief Hold every so-manieth point out of the fit and only measure it; 0 for none.
   */
  void
  setHoldOut(int every)
  {
    options_.fit.hold_out_every = every;
  }

  int
  getHoldOut() const
  {
    return options_.fit.hold_out_every;
  }

  void
  setNumberOfThreads(int threads)
  {
    options_.fit.threads = threads;
  }

  int
  getNumberOfThreads() const
  {
    return options_.fit.threads;
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

  nurbs::SegmentFitOptions options_;
  SearchPtr search_;
  Eigen::Matrix2Xd given_;
  double noise_ = 0.0;
  double used_noise_ = 0.0;
  nurbs::FitReport report_;
  Indices used_;
  std::vector<bool> is_used_; // per point of the cloud
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/surface/impl/nurbs_fitting.hpp>
#endif
