// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "affine_structure.h"

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {
namespace {

using Points = NurbsSurface::HomogeneousPoints;

constexpr double kExact = 1e-12; // relative: rounding of the writer's own arithmetic

Eigen::Matrix3Xd
cartesian(const Points& points)
{
  return points.colwise().hnormalized();
}

double
spread(const Eigen::Matrix3Xd& points)
{
  return (points.colwise() - points.rowwise().mean().eval()).cwiseAbs().maxCoeff();
}

/** Whether \a net stands for the control points well enough: lattice rounding leaves
 * at most about 0.3 steps of root mean square in each coordinate. */
template <class Net>
bool
holds(const Net& net, const Points& points, const GrevilleGrid& greville, double step)
{
  const Points decoded = net.decoded(greville);
  if (!decoded.allFinite() || !(decoded.row(3).minCoeff() > 0.0))
    return false;
  const Eigen::Matrix3Xd error = cartesian(decoded) - cartesian(points);
  return error.squaredNorm() <= 0.75 * step * step * static_cast<double>(error.cols());
}

/** Fill \a grid with value(column) / step, row by row. */
template <class ValueOfColumn>
bool
quantiseGrid(IntegerGrid& grid, double step, ValueOfColumn value)
{
  Eigen::Index column = 0;
  for (std::int64_t& integer : grid.values)
    if (!quantise(value(column++), step, integer))
      return false;
  return true;
}

IntegerGrid
gridFor(const GrevilleGrid& greville)
{
  return {static_cast<int>(greville.values[0].size()),
          static_cast<int>(greville.values[1].size())};
}

bool
quantiseVector(const Eigen::Vector3d& value, double step, std::int64_t* integers)
{
  return quantise(value.x(), step, integers[0]) &&
         quantise(value.y(), step, integers[1]) &&
         quantise(value.z(), step, integers[2]);
}

/** Rotation and lengths of orthogonal axes. */
bool
quantiseRotation(const HeightNet::Frame& plane,
                 const GrevilleGrid& greville,
                 HeightNet& net)
{
  const double unit = net.frameStep();
  const std::array<double, 2> half{greville.halfWidth(0), greville.halfWidth(1)};
  net.scales = {roundedToTolerance(plane.a.norm(), 0.25 * unit / half[0]),
                roundedToTolerance(plane.b.norm(), 0.25 * unit / half[1])};
  Eigen::Matrix3d axes;
  axes.col(0) = plane.a.normalized();
  axes.col(2) = plane.n;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Eigen::Vector4d parts = Eigen::Quaterniond(axes).normalized().coeffs();
  parts.cwiseAbs().maxCoeff(&net.dropped);
  if (parts(net.dropped) < 0.0)
    parts = -parts;
  const double turn =
      0.5 * unit / std::max(net.scales[0] * half[0], net.scales[1] * half[1]);
  for (int k = 0, part = 0; part < 4; ++part)
    if (part != net.dropped && !quantise(parts(part), turn, net.rotation[k++]))
      return false;
  return true;
}

bool
quantiseFrame(const HeightNet::Frame& plane,
              const GrevilleGrid& greville,
              HeightNet& net)
{
  const double unit = net.frameStep();
  const double half_u = greville.halfWidth(0);
  const double half_v = greville.halfWidth(1);
  const double size =
      std::max(plane.a.norm() * half_u, plane.b.norm() * half_v); // of the patch
  const double cosine = plane.a.normalized().dot(plane.b.normalized());
  net.orthogonal = std::abs(cosine) * size <= std::max(1e-9 * size, 0.125 * unit);
  return quantiseVector(plane.origin, unit, net.origin.data()) &&
         (net.orthogonal
              ? quantiseRotation(plane, greville, net)
              : quantiseVector(plane.a, unit / half_u, net.axes.data()) &&
                    quantiseVector(plane.b, unit / half_v, net.axes.data() + 3));
}

/** Affine part and direction as a plane whose axes are perpendicular to the heights;
 * empty if the heights do not rise from the plane. */
std::optional<HeightNet::Frame>
basePlane(const AffinePlusScalar& fit)
{
  HeightNet::Frame plane;
  plane.origin = fit.affine.col(0);
  plane.n = fit.direction;
  plane.a = fit.affine.col(1) - plane.n * plane.n.dot(fit.affine.col(1));
  plane.b = fit.affine.col(2) - plane.n * plane.n.dot(fit.affine.col(2));
  const Eigen::Vector3d normal = plane.a.cross(plane.b);
  if (!(normal.norm() > 0.1 * plane.a.norm() * plane.b.norm()))
    return std::nullopt;
  plane.n = normal.normalized();
  return plane;
}

std::optional<HeightNet>
heightNet(const Points& points,
          const GrevilleGrid& greville,
          const GrevilleGrid& coded_greville,
          double step)
{
  const double weight = points(3, 0);
  if ((points.row(3).array() - weight).abs().maxCoeff() > kExact * weight)
    return std::nullopt;
  const Eigen::Matrix3Xd net_points = cartesian(points);
  const double tolerance =
      std::max(kExact * net_points.cwiseAbs().maxCoeff(), step / 64.0);
  const auto fit = affinePlusScalar(net_points, greville, tolerance);
  const auto plane = fit ? basePlane(*fit) : std::nullopt;
  HeightNet net;
  net.step = codeFromStep(step);
  net.heights = gridFor(greville);
  if (!plane || !quantiseFrame(*plane, coded_greville, net))
    return std::nullopt;
  net.flat = fit->direction.isZero(0.0);
  // Heights over the plane as it will be decoded, so they take up its rounding.
  const HeightNet::Frame coded = net.frame(coded_greville);
  const Eigen::Matrix3Xd basis = affineBasis(greville);
  const auto height = [&](Eigen::Index column) {
    return coded.n.dot(net_points.col(column) - coded.origin -
                       coded.a * basis(1, column) - coded.b * basis(2, column));
  };
  if (!net.flat && !quantiseGrid(net.heights, stepFromCode(net.step), height))
    return std::nullopt;
  return net;
}

/** Rays and centre of a camera, rounded far below what can be seen, so that equal
 * cameras of many patches become equal numbers. */
bool
fitCamera(const Points& points,
          const GrevilleGrid& greville,
          Eigen::Matrix<double, 3, 4>& camera)
{
  const double tolerance = kExact * points.cwiseAbs().maxCoeff();
  const auto fit = affinePlusScalar(points, greville, tolerance);
  if (!fit || (!fit->direction.isZero(0.0) && std::abs(fit->direction(3)) < 1e-9))
    return false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  if (!fit->direction.isZero(0.0))
    centre = fit->direction.head<3>() / fit->direction(3);
  const double size = cartesian(points).cwiseAbs().maxCoeff();
  const double centre_size = centre.cwiseAbs().maxCoeff();
  if (centre_size < std::ldexp(size, -36))
    centre.setZero();
  Eigen::Matrix3d rays = fit->affine.topRows<3>() - centre * fit->affine.row(3);
  rays.col(0) -= rays.col(1) * greville.centre(0) + rays.col(2) * greville.centre(1);
  const double ray_unit = std::ldexp(rays.cwiseAbs().maxCoeff(), -40);
  camera.leftCols<3>() =
      rays.unaryExpr([&](double x) { return roundedToTolerance(x, ray_unit); });
  camera.col(3) = centre.unaryExpr(
      [&](double x) { return roundedToTolerance(x, std::ldexp(centre_size, -36)); });
  return true;
}

std::optional<PerspectiveNet>
perspectiveNet(const Points& points, const GrevilleGrid& greville, double step)
{
  PerspectiveNet net;
  Eigen::Map<Eigen::Matrix<double, 3, 4>> camera(net.camera.data());
  Eigen::Matrix<double, 3, 4> fitted;
  if (!fitCamera(points, greville, fitted))
    return std::nullopt;
  camera = fitted;
  // A change dq of q moves the point at distance r by r dq / q along its ray.
  const Eigen::Matrix3Xd rays = cartesian(points).colwise() - fitted.col(3);
  const double movement =
      (rays.colwise().norm().array() / points.row(3).array()).matrix().norm() /
      std::sqrt(static_cast<double>(points.cols()));
  net.step = codeFromStep(step / movement);
  net.inverse_depths = gridFor(greville);
  if (!quantiseGrid(net.inverse_depths,
                    stepFromCode(net.step),
                    [&](Eigen::Index column) { return points(3, column); }))
    return std::nullopt;
  return net;
}

std::optional<GeneralNet>
generalNet(const Points& points, const GrevilleGrid& greville, double step)
{
  GeneralNet net;
  net.step = codeFromStep(step);
  const Eigen::Matrix3Xd net_points = cartesian(points);
  for (int d = 0; d < 3; ++d) {
    net.coordinates[d] = gridFor(greville);
    if (!quantiseGrid(net.coordinates[d],
                      stepFromCode(net.step),
                      [&](Eigen::Index column) { return net_points(d, column); }))
      return std::nullopt;
  }
  const double smallest = points.row(3).minCoeff();
  net.rational = points.row(3).maxCoeff() - smallest > kExact * smallest;
  if (!net.rational)
    return net;
  // A relative change of a weight moves a point by that part of the net's extent.
  const double share = step / (step + 8.0 * spread(net_points));
  net.weight_step = codeFromStep(share * smallest);
  net.weights = gridFor(greville);
  if (!quantiseGrid(net.weights,
                    stepFromCode(net.weight_step),
                    [&](Eigen::Index column) { return points(3, column); }))
    return std::nullopt;
  return net;
}

} // namespace

ExactNet
exactNet(const NurbsSurface& surface)
{
  const Points& points = surface.homogeneousPoints();
  return {std::vector<double>(points.data(), points.data() + points.size())};
}

CodedNet
quantisedNet(const NurbsSurface& surface,
             const GrevilleGrid& greville,
             const GrevilleGrid& coded_greville,
             double step)
{
  const Points& points = surface.homogeneousPoints();
  if (auto net = heightNet(points, greville, coded_greville, step))
    if (holds(*net, points, coded_greville, step))
      return *std::move(net);
  if (auto net = perspectiveNet(points, greville, step))
    if (holds(*net, points, coded_greville, step))
      return *std::move(net);
  if (auto net = generalNet(points, greville, step))
    if (holds(*net, points, coded_greville, step))
      return *std::move(net);
  return exactNet(surface);
}

} // namespace nurbs
} // namespace pcl
