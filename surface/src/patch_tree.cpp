// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

/** Pieces are halved at most this often: deeper subdivision is left to the queries,
 * which need it only where they look. */
constexpr int kMaxSplits = 4;

/** Thickness of a box over its length below which a piece counts as flat. */
constexpr double kFlat = 0.1;

template <typename Iterator, typename Visit>
void
forEachPoint(Iterator first, Iterator last, Visit visit)
{
  for (; first != last; ++first)
    for (int i = 0; i <= first->degree_u; ++i)
      for (int j = 0; j <= first->degree_v; ++j)
        visit(first->cartesian(i, j));
}

/** Box around all control points, its axes those of their scatter. */
template <typename Iterator>
OrientedBox
boxAround(Iterator first, Iterator last)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double count = 0.0;
  forEachPoint(first, last, [&](const Eigen::Vector3d& point) {
    mean += point;
    count += 1.0;
  });
  mean /= count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  forEachPoint(first, last, [&](const Eigen::Vector3d& point) {
    scatter += (point - mean) * (point - mean).transpose();
  });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  OrientedBox box;
  box.axes = eigen.eigenvectors().transpose();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity);
  Eigen::Vector3d high = -low;
  forEachPoint(first, last, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d local = box.axes * (point - mean);
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  });
  box.center = mean + box.axes.transpose() * (0.5 * (low + high));
  // A margin above rounding keeps the bound a bound.
  const double margin = 1e-14 * (box.center.cwiseAbs().sum() + (high - low).sum());
  box.half = (0.5 * (high - low)).array() + margin;
  return box;
}

} // namespace

bool
OrientedBox::clip(const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction,
                  double& t_min,
                  double& t_max) const
{
  const Eigen::Vector3d from = axes * (origin - center);
  const Eigen::Vector3d along = axes * direction;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(along(k)) <= 1e-14 * direction.norm()) {
      if (std::abs(from(k)) > half(k))
        return false;
      continue;
    }
    const double a = (-half(k) - from(k)) / along(k);
    const double b = (half(k) - from(k)) / along(k);
    t_min = std::max(t_min, std::min(a, b));
    t_max = std::min(t_max, std::max(a, b));
  }
  return t_min <= t_max;
}

PatchTree::PatchTree(std::vector<BezierPatch> pieces)
    : degree_u_(pieces.front().degree_u), degree_v_(pieces.front().degree_v)
{
  build(pieces.begin(), pieces.end());
}

int
PatchTree::build(Pieces::iterator first, Pieces::iterator last)
{
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({boxAround(first, last)});
  if (std::next(first) == last) {
    buildPiece(index, *first, kMaxSplits);
    return index;
  }
  // The eigenvalues increase, so the last axis is the one of the widest scatter.
  const Eigen::Vector3d axis = nodes_[index].box.axes.row(2);
  const auto position = [&](const BezierPatch& patch) {
    return axis.dot(patch.cartesian(0, 0) +
                    patch.cartesian(patch.degree_u, patch.degree_v));
  };
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](const auto& a, const auto& b) {
    return position(a) < position(b);
  });
  const int left = build(first, middle);
  const int right = build(middle, last);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

void
PatchTree::buildPiece(int node, const BezierPatch& piece, int splits_left)
{
  const Eigen::Vector3d half = nodes_[node].box.half;
  const double width = degree_v_ > 0 ? half.minCoeff() : half.head<2>().maxCoeff();
  if (splits_left == 0 || width <= kFlat * half.maxCoeff()) {
    nodes_[node].leaf = static_cast<int>(leaves_.size());
    leaves_.push_back({piece.u_min, piece.u_max, piece.v_min, piece.v_max});
    points_.insert(
        points_.end(), piece.points.begin(), piece.points.begin() + piece.size());
    return;
  }
  std::array<BezierPatch, 2> halves;
  piece.split(piece.longerDirection(), halves[0], halves[1]);
  const int left = static_cast<int>(nodes_.size());
  nodes_.push_back({boxAround(&halves[0], &halves[0] + 1)});
  nodes_.push_back({boxAround(&halves[1], &halves[1] + 1)});
  nodes_[node].left = left;
  nodes_[node].right = left + 1;
  buildPiece(left, halves[0], splits_left - 1);
  buildPiece(left + 1, halves[1], splits_left - 1);
}

void
PatchTree::loadLeaf(int leaf, BezierPatch& patch) const
{
  const Leaf& frame = leaves_[static_cast<std::size_t>(leaf)];
  patch.degree_u = degree_u_;
  patch.degree_v = degree_v_;
  patch.u_min = frame.u_min;
  patch.u_max = frame.u_max;
  patch.v_min = frame.v_min;
  patch.v_max = frame.v_max;
  const std::ptrdiff_t size = patch.size();
  std::copy_n(points_.begin() + leaf * size, size, patch.points.begin());
}

} // namespace nurbs
} // namespace pcl
