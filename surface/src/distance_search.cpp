// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "distance_search.h"

#include "rational_derivatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kMaxOrder = 2 * kMaxDegree + 1; // coefficients of a squared piece

/** Halvings of a leaf piece before its rest is left: 20 in each direction, parameters
 * to one millionth of the piece. */
constexpr int kMaxSplits = 40;

/** binomial(n, i) for the degrees of pieces and of their squares. */
struct Binomials {
  Binomials()
  {
    for (int n = 0; n < kMaxOrder; ++n)
      for (int i = 0; i <= n; ++i)
        values[n][i] = binomial(n, i);
  }

  std::array<std::array<double, kMaxOrder>, kMaxOrder> values;
};

const Binomials&
binomials()
{
  static const Binomials table;
  return table;
}

/** |A - w p|^2 - bound w^2 of a piece in Bernstein form of twice its degrees. */
class SquaredDistance {
public:
  SquaredDistance(const BezierPatch& patch, const Eigen::Vector3d& p, double bound);

  double
  operator()(int i, int j) const
  {
    return values_[static_cast<std::size_t>(i * (n_ + 1) + j)];
  }

  /** Grid position of the smallest coefficient, in [0, 1] x [0, 1]. */
  Eigen::Vector2d
  lowest() const;

  bool
  isNonNegative() const
  {
    return *std::min_element(values_.begin(), values_.begin() + size()) >= -rounding_;
  }

  /** Whether the coefficients prove the Hessian positive semidefinite everywhere. */
  bool
  isConvex() const;

  /** Direction in which halving brings the coefficients closer to the function. */
  Direction
  moreCurved() const;

private:
  int
  size() const
  {
    return (m_ + 1) * (n_ + 1);
  }

  /** Bounds of the derivatives uu, uv, vv: the largest absolute values, or the smallest
   * uu and vv beside the largest |uv|. */
  Eigen::Array3d
  secondDifferences(bool largest) const;

  int m_;
  int n_;
  double rounding_;
  std::array<double, static_cast<std::size_t>(kMaxOrder) * kMaxOrder> values_;
};

SquaredDistance::SquaredDistance(const BezierPatch& patch,
                                 const Eigen::Vector3d& p,
                                 double bound)
    : m_(2 * patch.degree_u), n_(2 * patch.degree_v)
{
  const auto& choose = binomials().values;
  std::array<Eigen::Vector4d, BezierPatch::kMaxPoints> scaled;
  double largest = 0.0;
  const int row = patch.degree_v + 1;
  for (int i = 0; i <= patch.degree_u; ++i)
    for (int j = 0; j < row; ++j) {
      Eigen::Vector4d a = patch(i, j);
      a.head<3>() -= a(3) * p;
      largest = std::max(largest, a.head<3>().squaredNorm() + bound * a(3) * a(3));
      scaled[i * row + j] = choose[patch.degree_u][i] * choose[patch.degree_v][j] * a;
    }
  rounding_ = 4e-15 * largest;
  std::fill_n(values_.begin(), size(), 0.0);
  const Eigen::Vector4d metric(1.0, 1.0, 1.0, -bound);
  const int count = patch.size();
  for (int a = 0; a < count; ++a) {
    const Eigen::Vector4d left = scaled[a].cwiseProduct(metric);
    double* target = &values_[(a / row) * (n_ + 1) + a % row];
    target[(a / row) * (n_ + 1) + a % row] += left.dot(scaled[a]);
    for (int b = a + 1; b < count; ++b) // twice, for (a, b) and (b, a)
      target[(b / row) * (n_ + 1) + b % row] += 2.0 * left.dot(scaled[b]);
  }
  for (int i = 0; i <= m_; ++i)
    for (int j = 0; j <= n_; ++j)
      values_[i * (n_ + 1) + j] /= choose[m_][i] * choose[n_][j];
}

Eigen::Vector2d
SquaredDistance::lowest() const
{
  const auto index = static_cast<int>(
      std::min_element(values_.begin(), values_.begin() + size()) - values_.begin());
  return {static_cast<double>(index / (n_ + 1)) / m_,
          n_ == 0 ? 0.0 : static_cast<double>(index % (n_ + 1)) / n_};
}

Eigen::Array3d
SquaredDistance::secondDifferences(bool largest) const
{
  const auto& f = *this;
  const auto pick = [largest](double a, double b) {
    return largest ? std::max(a, std::abs(b)) : std::min(a, b);
  };
  const double start = largest ? 0.0 : std::numeric_limits<double>::infinity();
  Eigen::Array3d d(start, 0.0, start);
  for (int i = 0; i <= m_; ++i)
    for (int j = 0; j <= n_; ++j) {
      if (i >= 2)
        d(0) = pick(d(0), f(i, j) - 2.0 * f(i - 1, j) + f(i - 2, j));
      if (j >= 2)
        d(2) = pick(d(2), f(i, j) - 2.0 * f(i, j - 1) + f(i, j - 2));
      if (i >= 1 && j >= 1)
        d(1) = std::max(
            d(1), std::abs(f(i, j) - f(i - 1, j) - f(i, j - 1) + f(i - 1, j - 1)));
    }
  return d * Eigen::Array3d(m_ * (m_ - 1), m_ * n_, n_ * (n_ - 1));
}

bool
SquaredDistance::isConvex() const
{
  const Eigen::Array3d d =
      secondDifferences(false) + rounding_ * Eigen::Array3d(m_ * m_, -m_ * n_, n_ * n_);
  if (n_ == 0)
    return d(0) >= 0.0;
  const double mixed = std::max(d(1), 0.0);
  return d(0) >= 0.0 && d(2) >= 0.0 && d(0) * d(2) >= mixed * mixed;
}

Direction
SquaredDistance::moreCurved() const
{
  if (n_ == 0)
    return Direction::U;
  const Eigen::Array3d d = secondDifferences(true);
  return d(0) >= d(2) ? Direction::U : Direction::V;
}

/** Whether a true local minimum has been found inside of the piece. */
bool
holdsMinimum(const BezierPatch& patch, const FootPoint& foot)
{
  const double slack_u = 1e-9 * (patch.u_max - patch.u_min);
  const double slack_v = 1e-9 * (patch.v_max - patch.v_min);
  return foot.converged && foot.u >= patch.u_min - slack_u &&
         foot.u <= patch.u_max + slack_u && foot.v >= patch.v_min - slack_v &&
         foot.v <= patch.v_max + slack_v;
}

} // namespace

DistanceSearch::DistanceSearch(const PatchTree& tree,
                               const Eigen::Vector3d& point,
                               Descend descend)
    : tree_(tree), point_(point), descend_(std::move(descend))
{
}

FootPoint
DistanceSearch::run()
{
  // A good upper bound first: descend from the middle of the piece in the nearest box.
  const PatchTree::Node* node = &tree_.root();
  while (node->leaf < 0) {
    const PatchTree::Node& left = tree_.node(node->left);
    const PatchTree::Node& right = tree_.node(node->right);
    node = left.box.squaredDistance(point_) <= right.box.squaredDistance(point_)
               ? &left
               : &right;
  }
  BezierPatch patch;
  tree_.loadLeaf(node->leaf, patch);
  improve(0.5 * (patch.u_min + patch.u_max), 0.5 * (patch.v_min + patch.v_max));
  visit(tree_.root());
  return best_;
}

double
DistanceSearch::bound() const
{
  const double resolution = 1e-14 * tree_.size(); // a distance that counts as none
  return (1.0 - 2e-10) * best_.squared_distance - resolution * resolution;
}

void
DistanceSearch::improve(double u, double v)
{
  latest_ = descend_(u, v);
  if (latest_.squared_distance < best_.squared_distance)
    best_ = latest_;
}

void
DistanceSearch::visit(const PatchTree::Node& node)
{
  if (node.leaf >= 0) {
    BezierPatch patch;
    tree_.loadLeaf(node.leaf, patch);
    return examine(patch, kMaxSplits);
  }
  const PatchTree::Node* near = &tree_.node(node.left);
  const PatchTree::Node* far = &tree_.node(node.right);
  double near_distance = near->box.squaredDistance(point_);
  double far_distance = far->box.squaredDistance(point_);
  if (far_distance < near_distance) {
    std::swap(near, far);
    std::swap(near_distance, far_distance);
  }
  if (near_distance < bound())
    visit(*near);
  if (far_distance < bound())
    visit(*far);
}

void
DistanceSearch::examine(const BezierPatch& patch, int splits_left)
{
  const double bound_used = bound();
  if (bound_used <= 0.0)
    return;
  const SquaredDistance f(patch, point_, bound_used);
  if (f.isNonNegative())
    return;
  const bool convex = f.isConvex();
  if (convex && holdsMinimum(patch, best_))
    return;
  const Eigen::Vector2d start = f.lowest();
  improve(patch.u_min + start.x() * (patch.u_max - patch.u_min),
          patch.v_min + start.y() * (patch.v_max - patch.v_min));
  if ((convex && holdsMinimum(patch, latest_)) || splits_left == 0)
    return;
  std::array<BezierPatch, 2> halves;
  patch.split(f.moreCurved(), halves[0], halves[1]);
  examine(halves[0], splits_left - 1);
  examine(halves[1], splits_left - 1);
}

} // namespace nurbs
} // namespace pcl
