// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/scan_source.h>
#include <pcl/mapping/simulator/sensor_models.h>
#include <pcl/mapping/simulator/town.h>

#include <memory>
#include <variant>

namespace pcl {
namespace nurbs {

/** \brief How a drive is simulated. */
struct SimulationOptions {
  TownOptions town;
  /** Noise of ranges or disparities and intensities, and lost returns. */
  bool noise = true;
  /** Whether the sensor and the town move during a scan of a laser; otherwise all of a
   * scan is measured at its stamp. */
  bool motion_distortion = false;
  /** Threads for one scan, 0 for all cores; they do not change the result. */
  int threads = 0;
  /** The sensor on the body whose poses are driven. */
  Eigen::Isometry3d T_body_sensor = Eigen::Isometry3d::Identity();
};

/** \brief A scan with what is true about it, point by point. */
struct SimulatedScan {
  Scan scan;
  /** Surface of each point (BeamHit::kNothing without a return). */
  std::vector<std::uint32_t> surfaces;
  /** Where the beam met the surface, in the world at the time of the point. */
  std::vector<Eigen::Vector3d> true_points;
};

/** \brief A drive through a procedural town, as a source of scans with exact truth.
 *
 * Clouds are organized: rows are beams or image rows, points without a return NaN. The
 * same drive, sensor and options give the same bytes on any number of threads.
 * \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT SimulatedDrive : public ScanSource {
public:
  using Sensor = std::variant<LaserModel, DepthCameraModel>;

  /** \brief Build the town.
   * \param[in] drive poses of the body, x ahead and z up, one per scan
   * \param[in] sensor what measures
   * \param[in] options how
   * \throws std::invalid_argument for what Town refuses, and for a sensor without
   * beams, pixels or range */
  SimulatedDrive(const Trajectory& drive,
                 Sensor sensor,
                 const SimulationOptions& options = {});

  ~SimulatedDrive() override;

  std::size_t
  size() const override
  {
    return truth_.size();
  }

  double
  stamp(std::size_t index) const override;

  Scan
  read(std::size_t index) const override;

  const Trajectory*
  truth() const override
  {
    return &truth_;
  }

  /** \brief From the laser to a camera ahead of it that looks ahead; the identity for a
   * camera. */
  Eigen::Isometry3d
  calibration() const override;

  const std::vector<std::string>&
  problems() const override
  {
    return problems_;
  }

  /** \brief A scan with its truth; thread-safe.
   * \throws std::invalid_argument when there is no such scan */
  SimulatedScan
  simulate(std::size_t index) const;

  /** \brief Pose of the sensor at any time: straight and turning evenly between the
   * poses of the truth, and going on like that beyond them. */
  Eigen::Isometry3d
  sensorPose(double time) const;

  const Town&
  town() const
  {
    return *town_;
  }

  const Sensor&
  sensor() const
  {
    return sensor_;
  }

private:
  Sensor sensor_;
  SimulationOptions options_;
  std::unique_ptr<const Town> town_;
  Trajectory truth_;
  std::vector<std::string> problems_;
  std::vector<bool> hidden_; // beams of a laser behind its own vehicle
};

} // namespace nurbs
} // namespace pcl
