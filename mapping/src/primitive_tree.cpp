// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/primitive_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::uint32_t kLeafSize = 3;
constexpr int kBins = 16;
constexpr std::size_t kDeepest = 128;

double
halfArea(const Eigen::AlignedBox3d& box)
{
  if (box.isEmpty())
    return 0.0;
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

/** Where rays and boxes are compared in single precision, in a coordinate more. */
constexpr float kEverywhere = 1e30F;
constexpr float kDistanceMargin = 1e-3F; // metres, beyond rounding of distances

/** By how much a box is grown, so that rounding of its corners, of rays' origins and of
 * distances does not lose anything. */
double
roundingMargin(const Eigen::AlignedBox3d& box)
{
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return 1e-4 + 1e-6 * farthest;
}

Eigen::Array4f
inSinglePrecision(const Eigen::Vector3d& place, double fourth)
{
  return Eigen::Array4d(place.x(), place.y(), place.z(), fourth).cast<float>();
}

} // namespace

class PrimitiveTree::Builder {
public:
  explicit Builder(PrimitiveTree& tree) : tree_(tree)
  {
    boxes_.reserve(tree.primitives_.size());
    for (const Primitive& primitive : tree.primitives_)
      boxes_.push_back(boundsOf(primitive));
  }

  void
  build()
  {
    const auto count = static_cast<std::uint32_t>(boxes_.size());
    tree_.order_.resize(count);
    std::iota(tree_.order_.begin(), tree_.order_.end(), 0U);
    if (count > 0) {
      tree_.nodes_.emplace_back();
      split(0, 0, count, 0);
    }
  }

private:
  void
  split(std::size_t node, std::uint32_t first, std::uint32_t last, std::size_t depth)
  {
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d centers;
    for (std::uint32_t i = first; i < last; ++i) {
      box.extend(boxes_[tree_.order_[i]]);
      centers.extend(boxes_[tree_.order_[i]].center());
    }
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(roundingMargin(box));
    tree_.nodes_[node].low = inSinglePrecision(box.min() - margin, -kEverywhere);
    tree_.nodes_[node].high = inSinglePrecision(box.max() + margin, kEverywhere);
    tree_.nodes_[node].first = first;
    tree_.nodes_[node].count = last - first;
    // Half of the depth is left to halving, which ends within 32 levels.
    if (last - first <= kLeafSize)
      return;
    const std::uint32_t middle =
        depth < kDeepest / 2 ? bestPlace(first, last, centers) : (first + last) / 2;
    const std::size_t children = tree_.nodes_.size();
    tree_.nodes_[node].first = static_cast<std::uint32_t>(children);
    tree_.nodes_[node].count = 0;
    tree_.nodes_.resize(children + 2);
    split(children, first, middle, depth + 1);
    split(children + 1, middle, last, depth + 1);
  }

  /** Order the range along the widest axis so that the two parts cost least. */
  std::uint32_t
  bestPlace(std::uint32_t first, std::uint32_t last, const Eigen::AlignedBox3d& centers)
  {
    Eigen::Index axis = 0;
    const double width = centers.sizes().maxCoeff(&axis);
    if (!(width > 0.0))
      return (first + last) / 2;
    const auto binOf = [&](std::uint32_t i) {
      const double share = (boxes_[i].center()(axis) - centers.min()(axis)) / width;
      return std::min(kBins - 1, static_cast<int>(share * kBins));
    };
    const int border = cheapestBorder(first, last, binOf);
    const auto begin = tree_.order_.begin();
    const auto middle =
        std::stable_partition(begin + first, begin + last, [&](std::uint32_t i) {
          return binOf(i) < border;
        });
    return static_cast<std::uint32_t>(middle - begin);
  }

  template <typename BinOf>
  int
  cheapestBorder(std::uint32_t first, std::uint32_t last, const BinOf& binOf) const
  {
    std::array<Eigen::AlignedBox3d, kBins> boxes;
    std::array<int, kBins> counts{};
    for (std::uint32_t i = first; i < last; ++i) {
      const auto bin = static_cast<std::size_t>(binOf(tree_.order_[i]));
      boxes[bin].extend(boxes_[tree_.order_[i]]);
      ++counts[bin];
    }
    std::array<double, kBins> cost{};
    const auto sweep = [&](int from, int to, int step, int to_border) {
      Eigen::AlignedBox3d box;
      int count = 0;
      for (int bin = from; bin != to; bin += step) {
        box.extend(boxes[static_cast<std::size_t>(bin)]);
        count += counts[static_cast<std::size_t>(bin)];
        cost[static_cast<std::size_t>(bin + to_border)] += halfArea(box) * count;
      }
    };
    sweep(0, kBins - 1, 1, 1);
    sweep(kBins - 1, 0, -1, 0);
    // The first and the last bin hold a primitive each, so no border leaves a side
    // empty.
    return static_cast<int>(std::min_element(cost.begin() + 1, cost.end()) -
                            cost.begin());
  }

  PrimitiveTree& tree_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

PrimitiveTree::PrimitiveTree(std::vector<Primitive> primitives)
    : primitives_(std::move(primitives))
{
  Builder(*this).build();
}

BeamHit
PrimitiveTree::cast(const Beam& ray, double near, double far) const
{
  BeamHit hit{far, BeamHit::kNothing};
  if (nodes_.empty())
    return hit;
  const Eigen::Array4f origin = inSinglePrecision(ray.origin, 0.0);
  // Not infinite, so that a ray within the side of a box gives 0 and not NaN.
  const Eigen::Array4f along = inSinglePrecision(ray.direction, 1.0);
  const Eigen::Array4f inverse = (along.abs() < 1e-30F).select(1e-30F, along).inverse();
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const auto single_near = static_cast<float>(near);
  auto single_far = static_cast<float>(far) + kDistanceMargin;
  // Distance at which the ray enters a box, infinity if it does not before the hit.
  const auto entry = [&](const Node& node) {
    const Eigen::Array4f one = (node.low - origin) * inverse;
    const Eigen::Array4f other = (node.high - origin) * inverse;
    const float in = std::max(one.min(other).maxCoeff(), single_near);
    const float out = std::min(one.max(other).minCoeff(), single_far);
    return in <= out ? in : kNever;
  };
  struct Pending {
    std::uint32_t node;
    float entry;
  };
  std::array<Pending, kDeepest> stack;
  std::size_t size = 0;
  stack[size++] = {0, entry(nodes_[0])};
  while (size > 0) {
    const Pending next = stack[--size];
    if (!(next.entry < single_far))
      continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double distance =
          intersect(primitives_[order_[i]], ray, near, hit.distance);
      if (distance < hit.distance)
        hit = {distance, order_[i]};
    }
    single_far = static_cast<float>(hit.distance) + kDistanceMargin;
    if (node.count > 0)
      continue;
    const Pending left{node.first, entry(nodes_[node.first])};
    const Pending right{node.first + 1, entry(nodes_[node.first + 1])};
    const bool left_first = left.entry <= right.entry;
    stack[size++] = left_first ? right : left;
    stack[size++] = left_first ? left : right;
  }
  return hit;
}

} // namespace nurbs
} // namespace pcl
