// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "coded_net.h"

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {
namespace {

using Points = NurbsSurface::HomogeneousPoints;

std::vector<double>
abscissae(const KnotVector& knots)
{
  std::vector<double> values;
  for (int i = 0; i < knots.numControlPoints(); ++i)
    values.push_back(knots.greville(i));
  return values;
}

int
rows(const GrevilleGrid& greville)
{
  return static_cast<int>(greville.values[0].size());
}

int
cols(const GrevilleGrid& greville)
{
  return static_cast<int>(greville.values[1].size());
}

/** One column per control point, made by \a point from its two indices. */
template <class PointOfIndices>
Points
assembled(const GrevilleGrid& greville, PointOfIndices point)
{
  Points points(4, static_cast<Eigen::Index>(rows(greville)) * cols(greville));
  Eigen::Index column = 0;
  for (int i = 0; i < rows(greville); ++i)
    for (int j = 0; j < cols(greville); ++j)
      points.col(column++) = point(i, j);
  return points;
}

IntegerGrid
emptyGrid(const GrevilleGrid& greville)
{
  return {rows(greville), cols(greville)};
}

} // namespace

GrevilleGrid::GrevilleGrid(const KnotVector& knots_u, const KnotVector& knots_v)
    : values{abscissae(knots_u), abscissae(knots_v)}
{
}

double
GrevilleGrid::centre(int direction) const
{
  const std::vector<double>& all = values[static_cast<std::size_t>(direction)];
  return 0.5 * (all.front() + all.back());
}

double
GrevilleGrid::halfWidth(int direction) const
{
  const std::vector<double>& all = values[static_cast<std::size_t>(direction)];
  const double half = 0.5 * (all.back() - all.front());
  return half > 0.0 ? half : 1.0;
}

Points
ExactNet::decoded(const GrevilleGrid& greville) const
{
  require(values.size() ==
              4 * static_cast<std::size_t>(rows(greville)) * cols(greville),
          "wrong number of control values");
  return Eigen::Map<const Points>(
      values.data(), 4, static_cast<Eigen::Index>(values.size() / 4));
}

Points
GeneralNet::decoded(const GrevilleGrid& greville) const
{
  const double size = stepFromCode(step);
  const double weight_size = rational ? stepFromCode(weight_step) : 1.0;
  return assembled(greville, [&](int i, int j) {
    const double weight =
        rational ? weight_size * static_cast<double>(weights.at(i, j)) : 1.0;
    Eigen::Vector4d point;
    for (int d = 0; d < 3; ++d)
      point(d) = weight * (size * static_cast<double>(coordinates[d].at(i, j)));
    point(3) = weight;
    return point;
  });
}

double
HeightNet::frameStep() const
{
  return 0.5 * stepFromCode(step);
}

HeightNet::Frame
HeightNet::frame(const GrevilleGrid& greville) const
{
  Frame frame;
  const double unit = frameStep();
  const double half_u = greville.halfWidth(0);
  const double half_v = greville.halfWidth(1);
  for (int d = 0; d < 3; ++d) {
    frame.origin(d) = unit * static_cast<double>(origin[d]);
    frame.a(d) = unit / half_u * static_cast<double>(axes[d]);
    frame.b(d) = unit / half_v * static_cast<double>(axes[3 + d]);
  }
  if (orthogonal) {
    const double turn = 0.5 * unit / std::max(scales[0] * half_u, scales[1] * half_v);
    Eigen::Vector4d parts; // x, y, z, w
    double rest = 1.0;
    for (int k = 0, part = 0; part < 4; ++part)
      if (part != dropped) {
        parts(part) = turn * static_cast<double>(rotation[k++]);
        rest -= parts(part) * parts(part);
      }
    parts(dropped) = std::sqrt(std::max(rest, 0.0));
    const Eigen::Matrix3d axes_of_plane =
        Eigen::Quaterniond(parts).normalized().toRotationMatrix();
    frame.a = scales[0] * axes_of_plane.col(0);
    frame.b = scales[1] * axes_of_plane.col(1);
    frame.n = axes_of_plane.col(2);
  }
  else {
    frame.n = frame.a.cross(frame.b).normalized();
  }
  return frame;
}

Points
HeightNet::decoded(const GrevilleGrid& greville) const
{
  const Frame plane = frame(greville);
  const double size = stepFromCode(step);
  return assembled(greville, [&](int i, int j) {
    const double height = flat ? 0.0 : size * static_cast<double>(heights.at(i, j));
    const Eigen::Vector3d point =
        plane.origin + (greville.values[0][i] - greville.centre(0)) * plane.a +
        (greville.values[1][j] - greville.centre(1)) * plane.b + height * plane.n;
    return Eigen::Vector4d(point.homogeneous());
  });
}

Points
PerspectiveNet::decoded(const GrevilleGrid& greville) const
{
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> columns(camera.data());
  const double size = stepFromCode(step);
  return assembled(greville, [&](int i, int j) {
    const double q = size * static_cast<double>(inverse_depths.at(i, j));
    Eigen::Vector4d point;
    point << columns.col(0) + greville.values[0][i] * columns.col(1) +
                 greville.values[1][j] * columns.col(2) + q * columns.col(3),
        q;
    return point;
  });
}

template <class Coder>
void
NetCodec::codeStep(Coder& coder, std::int64_t& step)
{
  codeDifference(coder, step_, step, last_step_);
  require(std::abs(step) <= 2000, "quantisation step out of range");
  last_step_ = step;
}

template <class Coder>
void
NetCodec::codeNet(Coder& coder, ExactNet& net)
{
  exact_.code(coder, net.values, 4);
}

template <class Coder>
void
NetCodec::codeNet(Coder& coder, GeneralNet& net)
{
  codeStep(coder, net.step);
  for (IntegerGrid& grid : net.coordinates)
    coordinate_.code(coder, grid);
  coder.bit(rational_, net.rational);
  if (!net.rational)
    return;
  weight_step_.code(coder, net.weight_step);
  weight_.code(coder, net.weights);
}

template <class Coder>
void
NetCodec::codeOrigin(Coder& coder, HeightNet& net)
{
  const double unit = net.frameStep();
  for (int d = 0; d < 3; ++d) {
    codeDifference(
        coder, origin_, net.origin[d], predictedInteger(last_origin_(d), unit));
    last_origin_(d) = unit * static_cast<double>(net.origin[d]);
  }
}

template <class Coder>
void
NetCodec::codeNet(Coder& coder, HeightNet& net)
{
  codeStep(coder, net.step);
  codeOrigin(coder, net);
  coder.bit(orthogonal_, net.orthogonal);
  if (net.orthogonal) {
    for (double& scale : net.scales)
      scale_.code(coder, scale);
    dropped_.code(coder, net.dropped);
    require(net.dropped >= 0 && net.dropped < 4, "unknown part of a rotation");
    for (std::int64_t& part : net.rotation)
      rotation_.code(coder, part);
  }
  else {
    for (std::int64_t& part : net.axes)
      axis_.code(coder, part);
  }
  coder.bit(flat_, net.flat);
  if (!net.flat)
    height_.code(coder, net.heights);
}

template <class Coder>
void
NetCodec::codeNet(Coder& coder, PerspectiveNet& net)
{
  net.same_camera = net.camera == last_camera_;
  coder.bit(same_camera_, net.same_camera);
  if (net.same_camera)
    net.camera = last_camera_;
  else
    for (double& number : net.camera)
      camera_.code(coder, number);
  last_camera_ = net.camera;
  codeStep(coder, net.step);
  inverse_depth_.code(coder, net.inverse_depths);
}

template <class Coder>
void
NetCodec::code(Coder& coder, CodedNet& net, const GrevilleGrid& greville)
{
  auto choice = static_cast<Class>(net.index());
  class_.code(coder, choice);
  if constexpr (Coder::kDecodes) {
    const IntegerGrid grid = emptyGrid(greville);
    if (choice == Class::Exact)
      net = ExactNet{std::vector<double>(4 * grid.values.size())};
    else if (choice == Class::General)
      net = GeneralNet{0, {grid, grid, grid}, false, 0, grid};
    else if (choice == Class::Height)
      net.emplace<HeightNet>().heights = grid;
    else
      net.emplace<PerspectiveNet>().inverse_depths = grid;
  }
  std::visit([&](auto& alternative) { codeNet(coder, alternative); }, net);
}

template void
NetCodec::code(RangeEncoder&, CodedNet&, const GrevilleGrid&);
template void
NetCodec::code(RangeDecoder&, CodedNet&, const GrevilleGrid&);

} // namespace nurbs
} // namespace pcl
