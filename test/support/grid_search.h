// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Distance to a surface by brute force: a grid of points, and compass search without
 * derivatives from the nearest ones. */
class GridSearch {
public:
  GridSearch(const NurbsSurface& surface, int cells) : surface_(surface), cells_(cells)
  {
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j) {
        const Eigen::Vector2d uv(at(surface.knotsU(), i), at(surface.knotsV(), j));
        samples_.emplace_back(uv, surface.evaluate(uv.x(), uv.y()));
      }
  }

  double
  distance(const Eigen::Vector3d& query) const
  {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      order.emplace_back((samples_[i].second - query).norm(), i);
    constexpr int kStarts = 8;
    std::partial_sort(order.begin(), order.begin() + kStarts, order.end());
    double best = order.front().first;
    for (int k = 0; k < kStarts; ++k)
      best = std::min(best, refine(query, samples_[order[k].second].first));
    return best;
  }

private:
  double
  at(const KnotVector& knots, int i) const
  {
    return knots.domainMin() + knots.domainLength() * i / cells_;
  }

  double
  refine(const Eigen::Vector3d& query, Eigen::Vector2d uv) const
  {
    double step = 1.0 / cells_;
    double best = (surface_.evaluate(uv.x(), uv.y()) - query).norm();
    while (step > 1e-8) {
      Eigen::Vector2d better = uv;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) {
          const double u = surface_.knotsU().clampToDomain(
              uv.x() + a * step * surface_.knotsU().domainLength());
          const double v = surface_.knotsV().clampToDomain(
              uv.y() + b * step * surface_.knotsV().domainLength());
          const double distance = (surface_.evaluate(u, v) - query).norm();
          if (distance < best) {
            best = distance;
            better = {u, v};
          }
        }
      if (better == uv)
        step *= 0.5;
      uv = better;
    }
    return best;
  }

  const NurbsSurface& surface_;
  int cells_;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector3d>> samples_;
};

} // namespace test
} // namespace nurbs
} // namespace pcl
