// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_render.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Vertex in camera axes (x right, y down, z forwards) with a colour, 0..255. */
struct ShadedVertex {
  Eigen::Vector3f position;
  Eigen::Vector3f colour;
};

/** \brief Z-buffer with 2 x 2 samples per pixel. */
class Rasterizer {
public:
  static constexpr int kSamples = 2; // per pixel and axis

  /** \throws std::invalid_argument for a picture without pixels or a bad angle */
  Rasterizer(int width, int height, double vertical_fov, const Rgb& background);

  void
  drawTriangle(const ShadedVertex& a, const ShadedVertex& b, const ShadedVertex& c);

  /** \brief Line of one pixel's width, in front of what is as far up to \a bias. */
  void
  drawLine(const Eigen::Vector3f& a,
           const Eigen::Vector3f& b,
           const Eigen::Vector3f& colour,
           float bias);

  /** \brief Square dot of one pixel. */
  void
  drawDot(const Eigen::Vector3f& point, const Eigen::Vector3f& colour, float bias);

  /** \brief The picture, samples averaged. */
  Image
  resolve() const;

private:
  struct ScreenVertex {
    Eigen::Vector2f position; // in samples
    float inverse_depth;
    Eigen::Vector3f colour;
  };

  ScreenVertex
  project(const ShadedVertex& vertex) const;

  void
  fill(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c);

  void
  plotDot(const Eigen::Vector2f& centre,
          float inverse_depth,
          const Eigen::Vector3f& colour);

  int width_;  // in samples
  int height_;
  float focal_; // in samples
  float near_ = 1e-3F;
  std::vector<float> inverse_depth_; // 0 is infinitely far
  std::vector<Rgb> colour_;
};

/** \brief Rotation into camera axes, translation so that the eye is the origin.
 * \throws std::invalid_argument if the camera looks nowhere or along its up */
Eigen::Isometry3d
cameraTransform(const Camera& camera);

} // namespace nurbs
} // namespace pcl
