// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "registration_scenes.h"

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/scan_source.h>

#include <functional>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace test {

/** A closed drive: an ellipse with half axes, looking ahead. */
struct Ellipse {
  double a = 15.0; // about 62 m around, in street()
  double b = 2.0;
};

inline Eigen::Isometry3d
onEllipse(double angle, const Ellipse& ellipse = {})
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << ellipse.a * std::cos(angle), ellipse.b * std::sin(angle), 0.0;
  pose.linear() = Eigen::AngleAxisd(std::atan2(ellipse.b * std::cos(angle),
                                               -ellipse.a * std::sin(angle)),
                                    Eigen::Vector3d::UnitZ())
                      .matrix();
  return pose;
}

/** A drive through a scene as a source of scans; what a scan holds can be changed. */
class SceneDrive : public ScanSource {
public:
  using Change = std::function<void(std::size_t, Scan&)>;

  SceneDrive(Scene scene, Trajectory truth, int points)
      : scene_(std::move(scene)), truth_(std::move(truth)), points_(points)
  {
  }

  /** Called with each scan before it is given away; may throw. */
  void
  setChange(Change change)
  {
    change_ = std::move(change);
  }

  std::size_t
  size() const override
  {
    return truth_.size();
  }

  double
  stamp(std::size_t index) const override
  {
    return truth_.at(index).stamp;
  }

  Scan
  read(std::size_t index) const override
  {
    std::mt19937 random(static_cast<unsigned>(index));
    Scan scan;
    scan.stamp = stamp(index);
    scan.cloud = cloudSeenFrom<pcl::PointXYZI>(
        truth_.at(index).T_world_body, sampleScene(scene_, points_, 0.01, random));
    if (change_)
      change_(index, scan);
    return scan;
  }

  const Trajectory*
  truth() const override
  {
    return &truth_;
  }

  Eigen::Isometry3d
  calibration() const override
  {
    return Eigen::Isometry3d::Identity();
  }

  const std::vector<std::string>&
  problems() const override
  {
    return problems_;
  }

private:
  Scene scene_;
  Trajectory truth_;
  int points_;
  Change change_;
  std::vector<std::string> problems_;
};

/** Poses on the ellipse, a tenth of a second apart. */
inline Trajectory
ellipseDrive(std::size_t scans, double step, const Ellipse& ellipse = {})
{
  Trajectory drive;
  for (std::size_t k = 0; k < scans; ++k)
    drive.push_back({0.1 * static_cast<double>(k),
                     onEllipse(step * static_cast<double>(k), ellipse)});
  return drive;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
