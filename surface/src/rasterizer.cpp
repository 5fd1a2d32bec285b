// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "rasterizer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

Rgb
toRgb(const Eigen::Vector3f& colour)
{
  const auto channel = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  };
  return {channel(colour.x()), channel(colour.y()), channel(colour.z())};
}

} // namespace

Eigen::Isometry3d
cameraTransform(const Camera& camera)
{
  const Eigen::Vector3d forwards = camera.target - camera.eye;
  const Eigen::Vector3d right = forwards.cross(camera.up);
  if (!(right.norm() > 1e-9 * forwards.norm() * camera.up.norm()))
    throw std::invalid_argument("Camera: it must look somewhere, and not along its up");
  Eigen::Matrix3d rotation;
  rotation.row(0) = right.normalized();
  rotation.row(1) = forwards.cross(right).normalized();
  rotation.row(2) = forwards.normalized();
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = rotation;
  transform.translation() = -rotation * camera.eye;
  return transform;
}

Rasterizer::Rasterizer(int width,
                       int height,
                       double vertical_fov,
                       const Rgb& background)
    : width_(width * kSamples), height_(height * kSamples)
{
  constexpr int kMaxPixels = 1 << 14;
  if (width < 1 || height < 1 || width > kMaxPixels || height > kMaxPixels)
    throw std::invalid_argument("render: the picture needs 1 to 16384 pixels a side");
  if (!(vertical_fov > 0.0 && vertical_fov < M_PI))
    throw std::invalid_argument("render: the field of view must be within (0, pi)");
  focal_ = static_cast<float>(0.5 * height_ / std::tan(0.5 * vertical_fov));
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  inverse_depth_.assign(count, 0.0F);
  colour_.assign(count, background);
}

Rasterizer::ScreenVertex
Rasterizer::project(const ShadedVertex& vertex) const
{
  const float inverse = 1.0F / vertex.position.z();
  return {{0.5F * static_cast<float>(width_) + focal_ * vertex.position.x() * inverse,
           0.5F * static_cast<float>(height_) + focal_ * vertex.position.y() * inverse},
          inverse,
          vertex.colour};
}

void
Rasterizer::drawTriangle(const ShadedVertex& a,
                         const ShadedVertex& b,
                         const ShadedVertex& c)
{
  // Clipped at the near plane a triangle has up to four corners.
  const std::array<const ShadedVertex*, 3> corners = {&a, &b, &c};
  std::array<ScreenVertex, 4> visible;
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ShadedVertex& from = *corners[i];
    const ShadedVertex& to = *corners[(i + 1) % 3];
    const bool is_visible = from.position.z() >= near_;
    if (is_visible)
      visible[n++] = project(from);
    if (is_visible != (to.position.z() >= near_)) {
      const float t = (near_ - from.position.z()) / (to.position.z() - from.position.z());
      ShadedVertex cut{from.position + t * (to.position - from.position),
                       from.colour + t * (to.colour - from.colour)};
      cut.position.z() = near_;
      visible[n++] = project(cut);
    }
  }
  for (std::size_t i = 2; i < n; ++i)
    fill(visible[0], visible[i - 1], visible[i]);
}

void
Rasterizer::fill(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c)
{
  const Eigen::Vector2f ab = b.position - a.position;
  const Eigen::Vector2f ac = c.position - a.position;
  const float area = ab.x() * ac.y() - ab.y() * ac.x();
  if (area == 0.0F || !std::isfinite(area))
    return;
  const auto bounds = [](float p, float q, float r, int size) {
    const float limit = static_cast<float>(size);
    const float low = std::ceil(std::clamp(std::min({p, q, r}) - 0.5F, 0.0F, limit));
    const float high =
        std::floor(std::clamp(std::max({p, q, r}) - 0.5F, -1.0F, limit - 1.0F));
    return std::pair(static_cast<int>(low), static_cast<int>(high));
  };
  const auto [x0, x1] =
      bounds(a.position.x(), b.position.x(), c.position.x(), width_);
  const auto [y0, y1] =
      bounds(a.position.y(), b.position.y(), c.position.y(), height_);
  // Weights of b and c are linear in the picture.
  const float b_dx = ac.y() / area;
  const float b_dy = -ac.x() / area;
  const float c_dx = -ab.y() / area;
  const float c_dy = ab.x() / area;
  constexpr float kOverlap = -1e-4F; // neighbours overlap rather than leave a gap
  for (int y = y0; y <= y1; ++y) {
    const Eigen::Vector2f start(static_cast<float>(x0) + 0.5F - a.position.x(),
                                static_cast<float>(y) + 0.5F - a.position.y());
    float wb = b_dx * start.x() + b_dy * start.y();
    float wc = c_dx * start.x() + c_dy * start.y();
    std::size_t sample = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                         static_cast<std::size_t>(x0);
    for (int x = x0; x <= x1; ++x, ++sample, wb += b_dx, wc += c_dx) {
      const float wa = 1.0F - wb - wc;
      if (wa < kOverlap || wb < kOverlap || wc < kOverlap)
        continue;
      const float depth =
          wa * a.inverse_depth + wb * b.inverse_depth + wc * c.inverse_depth;
      if (depth <= inverse_depth_[sample])
        continue;
      inverse_depth_[sample] = depth;
      colour_[sample] = toRgb(wa * a.colour + wb * b.colour + wc * c.colour);
    }
  }
}

void
Rasterizer::plotDot(const Eigen::Vector2f& centre,
                    float inverse_depth,
                    const Eigen::Vector3f& colour)
{
  const float half = 0.5F * kSamples;
  const int x0 = static_cast<int>(std::lround(centre.x() - half));
  const int y0 = static_cast<int>(std::lround(centre.y() - half));
  for (int y = std::max(y0, 0); y < std::min(y0 + kSamples, height_); ++y)
    for (int x = std::max(x0, 0); x < std::min(x0 + kSamples, width_); ++x) {
      const std::size_t sample =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
          static_cast<std::size_t>(x);
      if (inverse_depth <= inverse_depth_[sample])
        continue;
      inverse_depth_[sample] = inverse_depth;
      colour_[sample] = toRgb(colour);
    }
}

void
Rasterizer::drawLine(const Eigen::Vector3f& a,
                     const Eigen::Vector3f& b,
                     const Eigen::Vector3f& colour,
                     float bias)
{
  if (a.z() < near_ || b.z() < near_)
    return; // borders are cut fine: no need to clip
  const ScreenVertex from = project({a, colour});
  const ScreenVertex to = project({b, colour});
  const Eigen::Vector2f along = to.position - from.position;
  const float steps = std::ceil(along.lpNorm<Eigen::Infinity>());
  const auto longest = static_cast<float>(2 * (width_ + height_));
  if (!(steps <= longest))
    return; // mostly outside of the picture
  for (float k = 0.0F; k <= steps; k += 1.0F) {
    const float t = steps > 0.0F ? k / steps : 0.0F;
    const float inverse =
        from.inverse_depth + t * (to.inverse_depth - from.inverse_depth);
    plotDot(from.position + t * along, inverse / (1.0F - bias), colour);
  }
}

void
Rasterizer::drawDot(const Eigen::Vector3f& point,
                    const Eigen::Vector3f& colour,
                    float bias)
{
  if (!(point.z() >= near_))
    return;
  const ScreenVertex dot = project({point, colour});
  if (dot.position.x() > -2.0F && dot.position.y() > -2.0F &&
      dot.position.x() < static_cast<float>(width_ + 2) &&
      dot.position.y() < static_cast<float>(height_ + 2))
    plotDot(dot.position, dot.inverse_depth / (1.0F - bias), colour);
}

Image
Rasterizer::resolve() const
{
  Image image;
  image.width = width_ / kSamples;
  image.height = height_ / kSamples;
  image.pixels.reserve(colour_.size() / (kSamples * kSamples));
  for (int y = 0; y < height_; y += kSamples)
    for (int x = 0; x < width_; x += kSamples) {
      std::array<int, 3> sum{};
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const auto row = static_cast<std::size_t>(y + k / kSamples);
        const auto column = static_cast<std::size_t>(x + k % kSamples);
        const Rgb& sample = colour_[row * static_cast<std::size_t>(width_) + column];
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += sample[c];
      }
      Rgb pixel;
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>((sum[c] + 2) / (kSamples * kSamples));
      image.pixels.push_back(pixel);
    }
  return image;
}

} // namespace nurbs
} // namespace pcl
