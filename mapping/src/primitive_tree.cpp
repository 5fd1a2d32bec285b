// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/primitive_tree.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kBins = 16;

double
halfArea(const Eigen::AlignedBox3d& box)
{
  if (box.isEmpty())
    return 0.0;
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

/** By how much a box is grown, so that rounding of its corners, of rays' origins and of
 * distances does not lose anything. */
double
roundingMargin(const Eigen::AlignedBox3d& box)
{
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return 1e-4 + 1e-6 * farthest;
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
    tree_.nodes_[node].low = (box.min() - margin).cast<float>();
    tree_.nodes_[node].high = (box.max() + margin).cast<float>();
    tree_.nodes_[node].first = first;
    tree_.nodes_[node].count = last - first;
    // Half of the depth is left to halving, which ends within 32 levels.
    if (last - first == 1)
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

} // namespace nurbs
} // namespace pcl
