// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/conics.h>
#include <pcl/surface/nurbs/segment_fitter.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl {

/** \brief What NurbsFitting can be told, whatever the type of the points. \ingroup
 * surface */
class NurbsFittingSettings {
public:
  using Parameterization = nurbs::Parameterization;

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
  setAxis(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
  {
    options_.base = nurbs::frameFromAxis(origin, direction);
  }

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

protected:
  NurbsFittingSettings() = default;
  NurbsFittingSettings(const NurbsFittingSettings&) = default;
  NurbsFittingSettings&
  operator=(const NurbsFittingSettings&) = default;
  ~NurbsFittingSettings() = default;

  nurbs::SegmentFitOptions options_;
  Eigen::Matrix2Xd given_;
  double noise_ = 0.0;
  double used_noise_ = 0.0;
};

} // namespace pcl
