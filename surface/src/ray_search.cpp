// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "ray_search.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Halvings of a leaf piece, 21 in each direction: what is undecided then is smaller
 * than the square root of the distance that counts as touching. */
constexpr int kMaxSplits = 42;

/** More pieces than this at one level mean that the ray runs within the surface. */
constexpr std::size_t kMaxUndecided = 128;

/** All below as shares of the size of the surface. */
constexpr double kTouching = 1e-12;
constexpr double kSamePoint = 1e-9;
constexpr double kSameContact = 1e-6;

/** Sine of the angle between ray and tangent plane below which a hit is tangential. */
constexpr double kTangential = 1e-6;

/** The same where two common points could not be told apart. */
constexpr double kContact = 1e-3;

/** Whether the map of the first two components is one-to-one: the cross products of all
 * differences in u with all differences in v, whose hulls hold the derivatives, have
 * one sign. */
bool
isInjective(const BezierPatch& patch)
{
  std::array<Eigen::Vector2d, BezierPatch::kMaxPoints> along_v;
  int count = 0;
  for (int i = 0; i <= patch.degree_u; ++i)
    for (int j = 1; j <= patch.degree_v; ++j)
      along_v[count++] = (patch(i, j) - patch(i, j - 1)).head<2>();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 1; i <= patch.degree_u; ++i)
    for (int j = 0; j <= patch.degree_v; ++j) {
      const Eigen::Vector2d along_u = (patch(i, j) - patch(i - 1, j)).head<2>();
      for (int k = 0; k < count; ++k) {
        const double cross =
            along_u.x() * along_v[k].y() - along_u.y() * along_v[k].x();
        low = std::min(low, cross);
        high = std::max(high, cross);
      }
      if (low <= 0.0 && high >= 0.0)
        return false;
    }
  return true;
}

} // namespace

RaySearch::RaySearch(const NurbsSurface& surface,
                     const PatchTree& tree,
                     const Ray& ray,
                     bool nearest_only)
    : surface_(surface),
      tree_(tree),
      length_(ray.direction.stableNorm()),
      direction_(ray.direction / length_),
      base_t_((tree.root().box.center - ray.origin).dot(direction_)),
      // Ray coordinates start next to the surface: far origins would cost digits.
      base_(ray.origin + base_t_ * direction_),
      t_min_(ray.t_min * length_),
      t_max_(ray.t_max * length_),
      nearest_only_(nearest_only)
{
  across_.row(0) = direction_.unitOrthogonal();
  across_.row(1) = direction_.cross(across_.row(0).transpose());
}

std::vector<RayHit>
RaySearch::run()
{
  visit(tree_.root());
  mergeEqual();
  return std::move(hits_);
}

void
RaySearch::visit(const PatchTree::Node& node)
{
  if (node.leaf >= 0)
    return solveLeaf(node.leaf);
  struct Entry {
    const PatchTree::Node* node;
    double t;
  };
  std::array<Entry, 2> entries{};
  std::size_t count = 0;
  const double slack = kTouching * tree_.size();
  for (const int child : {node.left, node.right}) {
    double low = t_min_ - slack - base_t_;
    double high = t_max_ + slack - base_t_;
    OrientedBox box = tree_.node(child).box;
    box.half.array() += slack;
    if (box.clip(base_, direction_, low, high))
      entries[count++] = {&tree_.node(child), low + base_t_};
  }
  if (count == 2 && entries[1].t < entries[0].t)
    std::swap(entries[0], entries[1]);
  for (std::size_t i = 0; i < count; ++i)
    if (entries[i].t <= t_max_ + slack)
      visit(*entries[i].node);
}

Eigen::Vector4d
RaySearch::toRayFrame(const Eigen::Vector4d& homogeneous) const
{
  const double w = homogeneous(3);
  const Eigen::Vector3d offset = homogeneous.head<3>() - w * base_;
  Eigen::Vector4d result;
  result.head<2>() = across_ * offset;
  result(2) = offset.dot(direction_) + w * base_t_;
  result(3) = w;
  return result;
}

void
RaySearch::solveLeaf(int leaf)
{
  std::vector<BezierPatch> undecided(1);
  tree_.loadLeaf(leaf, undecided.front());
  for (int k = 0; k < undecided.front().size(); ++k)
    undecided.front().points[k] = toRayFrame(undecided.front().points[k]);
  std::vector<BezierPatch> next;
  for (int level = 0; !undecided.empty(); ++level) {
    const bool last = level == kMaxSplits || undecided.size() > kMaxUndecided;
    next.clear();
    next.reserve(2 * undecided.size());
    for (const BezierPatch& patch : undecided) {
      const Content content = contentOf(patch);
      if (content == Content::Nothing ||
          (content == Content::OneAtMost && solve(patch)))
        continue;
      if (last) {
        settle(patch);
        continue;
      }
      next.resize(next.size() + 2);
      patch.split(patch.longerDirection(), next[next.size() - 2], next.back());
    }
    std::swap(undecided, next);
  }
}

RaySearch::Content
RaySearch::contentOf(const BezierPatch& patch) const
{
  Eigen::Array3d low =
      Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (int i = 0; i <= patch.degree_u; ++i)
    for (int j = 0; j <= patch.degree_v; ++j) {
      const Eigen::Array3d point = patch.cartesian(i, j);
      low = low.min(point);
      high = high.max(point);
    }
  const double slack = kTouching * tree_.size();
  if (low(0) > slack || low(1) > slack || high(0) < -slack || high(1) < -slack ||
      low(2) > t_max_ + slack || high(2) < t_min_ - slack)
    return Content::Nothing;
  return isInjective(patch) ? Content::OneAtMost : Content::Unknown;
}

double
RaySearch::approach(const BezierPatch& patch, Eigen::Vector2d& uv) const
{
  const Eigen::Array2d low(patch.u_min, patch.v_min);
  const Eigen::Array2d high(patch.u_max, patch.v_max);
  const Eigen::Array2d slack = 1e-9 * (high - low);
  uv = 0.5 * (low + high);
  double distance = std::numeric_limits<double>::infinity();
  constexpr int kMaxIterations = 50;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const SurfaceJet1 jet = surface_.evaluateJet1(uv.x(), uv.y());
    const Eigen::Vector2d offset = across_ * (jet.position - base_);
    distance = offset.norm();
    Eigen::Matrix2d jacobian;
    jacobian << across_ * jet.du, across_ * jet.dv;
    const double determinant = jacobian.determinant();
    const double scale = jacobian.squaredNorm();
    Eigen::Vector2d step;
    if (std::abs(determinant) > 1e-9 * scale)
      step = -(jacobian.inverse() * offset);
    else // singular: damped Gauss-Newton
      step = -(jacobian.transpose() * jacobian +
               (1e-9 * scale + 1e-300) * Eigen::Matrix2d::Identity())
                  .inverse() *
             (jacobian.transpose() * offset);
    const Eigen::Vector2d target =
        (uv + step).array().max(low - slack).min(high + slack);
    const bool settled = (target - uv).norm() <= 1e-15 * (high - low).matrix().norm();
    if (settled || distance <= 1e-16 * tree_.size())
      return distance;
    uv = target;
  }
  return distance;
}

/** Newton's method for the only common point a piece can have.
 * \return false if there is none or it was not reached */
bool
RaySearch::solve(const BezierPatch& patch)
{
  Eigen::Vector2d uv;
  if (approach(patch, uv) > kTouching * tree_.size())
    return false;
  report(uv, false);
  return true;
}

/** Decide a piece too small to be split by the distance that is left. At a pole too the
 * components are not one-to-one, so only the normal tells whether the ray touches. */
void
RaySearch::settle(const BezierPatch& patch)
{
  Eigen::Vector2d uv;
  if (approach(patch, uv) <= kTouching * tree_.size())
    report(uv, true);
}

void
RaySearch::report(const Eigen::Vector2d& uv, bool contact)
{
  RayHit hit;
  hit.u = surface_.knotsU().clampToDomain(uv.x());
  hit.v = surface_.knotsV().clampToDomain(uv.y());
  const SurfaceJet1 jet = surface_.evaluateJet1(hit.u, hit.v);
  hit.point = jet.position;
  const Eigen::Vector3d normal = surface_.normal(hit.u, hit.v);
  const double sine = std::abs(normal.dot(direction_));
  hit.tangential = sine <= (contact ? kContact : kTangential);
  const double t = base_t_ + (hit.point - base_).dot(direction_);
  const double slack = kTouching * tree_.size();
  if (t < t_min_ - slack || t > t_max_ + slack)
    return;
  if (nearest_only_)
    t_max_ = std::min(t_max_, t);
  hit.t = t / length_;
  hits_.push_back(hit);
}

void
RaySearch::mergeEqual()
{
  std::sort(hits_.begin(), hits_.end(), [](const RayHit& a, const RayHit& b) {
    return a.t < b.t;
  });
  // Around a contact every piece within reach reports one: keep the most tangential of
  // such a chain, the middle of the contact.
  std::vector<RayHit> merged;
  const auto sine = [this](const RayHit& hit) {
    return std::abs(surface_.normal(hit.u, hit.v).dot(direction_));
  };
  Eigen::Vector3d previous = Eigen::Vector3d::Zero();
  for (const RayHit& hit : hits_) {
    const bool contact =
        !merged.empty() && (hit.tangential || merged.back().tangential);
    const double same = (contact ? kSameContact : kSamePoint) * tree_.size();
    if (merged.empty() || (hit.point - previous).norm() > same)
      merged.push_back(hit);
    else if (contact && sine(hit) < sine(merged.back()))
      merged.back() = hit;
    previous = hit.point;
  }
  hits_ = std::move(merged);
}

} // namespace nurbs
} // namespace pcl
