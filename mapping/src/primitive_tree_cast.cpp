// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/primitive_tree.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kDistanceMargin = 1e-3F; // metres, beyond rounding of distances

/** Four rays at once: as many floats as a register of every x86-64 holds. */
using Four = Eigen::Array4f;
constexpr Eigen::Index kLanes = 4;

} // namespace

/** Rays from one point on their way through a tree together. Each node is entered with
 * the range of rays that meet its box, which is narrow deep in the tree; all rays in
 * between are tested again there, so that no order of the rays is needed. */
class PrimitiveTree::FanTraversal {
public:
  FanTraversal(const PrimitiveTree& tree,
               const Eigen::Vector3d& origin,
               const std::vector<Eigen::Vector3d>& directions,
               double near,
               std::vector<BeamHit>& hits)
      : tree_(tree),
        directions_(directions),
        hits_(hits),
        ray_{origin, Eigen::Vector3d::UnitX()},
        near_(near),
        origin_(origin.cast<float>()),
        groups_((static_cast<Eigen::Index>(directions.size()) + kLanes - 1) / kLanes),
        inverse_x_(kLanes, groups_),
        inverse_y_(kLanes, groups_),
        inverse_z_(kLanes, groups_),
        far_(kLanes, groups_)
  {
    inverse_x_.setOnes();
    inverse_y_.setOnes();
    inverse_z_.setOnes();
    far_.setConstant(-1.0F); // rays that are only there to fill a group meet nothing
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      inverse_x_(k) = inverse(directions[i].x());
      inverse_y_(k) = inverse(directions[i].y());
      inverse_z_(k) = inverse(directions[i].z());
      far_(k) = static_cast<float>(hits[i].distance) + kDistanceMargin;
    }
  }

  void
  run()
  {
    std::array<Pending, kDeepest> stack;
    std::size_t size = 0;
    stack[size++] = enter(0, 0, groups_);
    while (size > 0) {
      const Pending next = stack[--size];
      if (!(next.entry < farthest(next)))
        continue;
      const Node& node = tree_.nodes_[next.node];
      if (node.count > 0) {
        meetLeaf(node, next);
        continue;
      }
      const Pending left = enter(node.first, next.begin, next.end);
      const Pending right = enter(node.first + 1, next.begin, next.end);
      const bool left_first = left.entry <= right.entry;
      stack[size++] = left_first ? right : left;
      stack[size++] = left_first ? left : right;
    }
  }

private:
  /** A node that waits, with the groups of rays that may meet it, and the distance at
   * which the first of them enters its box. */
  struct Pending {
    std::uint32_t node;
    float entry;
    Eigen::Index begin;
    Eigen::Index end;
  };

  /** Not infinite, so that a ray within the side of a box gives 0 and not NaN. */
  static float
  inverse(double component)
  {
    const auto single = static_cast<float>(component);
    return 1.0F / (std::abs(single) < 1e-30F ? 1e-30F : single);
  }

  /** Where the rays of a group enter a box, infinity for those that do not before their
   * hit. */
  Four
  entries(const Node& node, Eigen::Index group) const
  {
    const Four low_x = (node.low.x() - origin_.x()) * inverse_x_.col(group);
    const Four high_x = (node.high.x() - origin_.x()) * inverse_x_.col(group);
    const Four low_y = (node.low.y() - origin_.y()) * inverse_y_.col(group);
    const Four high_y = (node.high.y() - origin_.y()) * inverse_y_.col(group);
    const Four low_z = (node.low.z() - origin_.z()) * inverse_z_.col(group);
    const Four high_z = (node.high.z() - origin_.z()) * inverse_z_.col(group);
    const Four in_x = low_x.min(high_x);
    const Four in_y = low_y.min(high_y);
    const Four in_z = low_z.min(high_z).max(static_cast<float>(near_));
    const Four in = in_x.max(in_y).max(in_z);
    const Four out_x = low_x.max(high_x);
    const Four out_y = low_y.max(high_y);
    const Four out_z = low_z.max(high_z).min(far_.col(group));
    const Four out = out_x.min(out_y).min(out_z);
    return (in <= out).select(in, Four::Constant(kNever));
  }

  Pending
  enter(std::uint32_t node, Eigen::Index begin, Eigen::Index end) const
  {
    Pending result{node, kNever, end, begin};
    Four first = Four::Constant(kNever);
    for (Eigen::Index group = begin; group < end; ++group) {
      const Four in = entries(tree_.nodes_[node], group);
      if (!(in < kNever).any())
        continue;
      result.begin = std::min(result.begin, group);
      result.end = group + 1;
      first = first.min(in);
    }
    result.entry = first.minCoeff();
    return result;
  }

  float
  farthest(const Pending& range) const
  {
    float result = -1.0F;
    for (Eigen::Index group = range.begin; group < range.end; ++group)
      result = std::max(result, far_.col(group).maxCoeff());
    return result;
  }

  void
  meetLeaf(const Node& leaf, const Pending& range)
  {
    const std::uint32_t id = tree_.order_[leaf.first];
    const Primitive& primitive = tree_.primitives_[id];
    for (Eigen::Index group = range.begin; group < range.end; ++group) {
      const Four in = entries(leaf, group);
      for (Eigen::Index lane = 0; lane < kLanes; ++lane)
        if (in(lane) < kNever)
          meet(primitive, id, kLanes * group + lane);
    }
  }

  void
  meet(const Primitive& primitive, std::uint32_t id, Eigen::Index ray)
  {
    const auto i = static_cast<std::size_t>(ray);
    ray_.direction = directions_[i];
    const double distance = intersect(primitive, ray_, near_, hits_[i].distance);
    if (!(distance < hits_[i].distance))
      return;
    hits_[i] = {distance, id};
    far_(ray) = static_cast<float>(distance) + kDistanceMargin;
  }

  using Groups = Eigen::Array<float, kLanes, Eigen::Dynamic>;

  const PrimitiveTree& tree_;
  const std::vector<Eigen::Vector3d>& directions_;
  std::vector<BeamHit>& hits_;
  Beam ray_;
  double near_;
  Eigen::Array3f origin_;
  Eigen::Index groups_;
  Groups inverse_x_;
  Groups inverse_y_;
  Groups inverse_z_;
  Groups far_; // of the hits so far, and a margin
};

BeamHit
PrimitiveTree::cast(const Beam& ray, double near, double far) const
{
  std::vector<BeamHit> hits{{far, BeamHit::kNothing}};
  castFan(ray.origin, {ray.direction}, near, hits);
  return hits.front();
}

void
PrimitiveTree::castFan(const Eigen::Vector3d& origin,
                       const std::vector<Eigen::Vector3d>& directions,
                       double near,
                       std::vector<BeamHit>& hits) const
{
  if (hits.size() != directions.size())
    throw std::invalid_argument("PrimitiveTree: not one hit per direction");
  if (!nodes_.empty() && !directions.empty())
    FanTraversal(*this, origin, directions, near, hits).run();
}

} // namespace nurbs
} // namespace pcl
