// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_joining.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Points a local fit wants. */
constexpr double kWindowPoints = 400.0;
/** Largest step (standard deviations) between the local fits of one surface. */
constexpr double kStepSigmas = 3.0;
/** Share of the common border that must be smooth. */
constexpr double kSmoothShare = 0.6;

/** Fits to the nodes around a node, of its own facet only. */
class WindowFits {
public:
  WindowFits(const JoiningInput& input, const std::vector<NodeLink>& links)
      : input_(input),
        first_(input.nodes.count() + 1, 0),
        fits_(input.nodes.count()),
        seen_(input.nodes.count(), 0)
  {
    const auto within = [&](const NodeLink& link) {
      return input.facets.of_node[link.a] == input.facets.of_node[link.b];
    };
    for (const NodeLink& link : links)
      if (within(link)) {
        ++first_[link.a + 1];
        ++first_[link.b + 1];
      }
    for (std::size_t k = 1; k < first_.size(); ++k)
      first_[k] += first_[k - 1];
    neighbours_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const NodeLink& link : links)
      if (within(link)) {
        neighbours_[next[link.a]++] = link.b;
        neighbours_[next[link.b]++] = link.a;
      }
  }

  const ViewPolynomial&
  at(std::uint32_t node)
  {
    if (!fits_[node])
      fits_[node] = compute(node);
    return *fits_[node];
  }

private:
  ViewPolynomial
  compute(std::uint32_t node)
  {
    ++turn_;
    std::vector<std::uint32_t> front(1, node);
    seen_[node] = turn_;
    ViewSums sums;
    for (std::size_t k = 0; k < front.size() && sums.count() < kWindowPoints; ++k) {
      const std::uint32_t here = front[k];
      sums += input_.nodes.sums(here);
      for (std::uint32_t at = first_[here]; at < first_[here + 1]; ++at)
        if (seen_[neighbours_[at]] != turn_) {
          seen_[neighbours_[at]] = turn_;
          front.push_back(neighbours_[at]);
        }
    }
    return input_.criterion.best(sums, input_.chart.termChoices()[1]).surface;
  }

  const JoiningInput& input_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::optional<ViewPolynomial>> fits_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t turn_ = 0;
};

/** Whether two local surfaces agree at a direction in position and normal. */
bool
meetSmoothly(const JoiningInput& input,
             const ViewPolynomial& a,
             const ViewPolynomial& b,
             const Eigen::Vector3d& where)
{
  const std::array<double, kMostViewTerms> basis = input.chart.basis(where);
  const double value_a = a(basis);
  const double value_b = b(basis);
  const double depth = input.chart.depthOf(0.5 * (value_a + value_b));
  const double sigma =
      input.chart.sigma(depth) * std::sqrt(input.criterion.varianceScale());
  if (!(std::abs(value_a - value_b) <= kStepSigmas * sigma))
    return false;
  const double cosine =
      input.chart.normal(a, where).dot(input.chart.normal(b, where));
  return cosine >= std::cos(input.options.crease_angle);
}

struct Border {
  double all = 0.0;
  double smooth = 0.0;
};

} // namespace

void
joinSmooth(const JoiningInput& input,
           const std::vector<NodeLink>& links,
           DisjointSets& surfaces)
{
  WindowFits windows(input, links);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Border> borders;
  for (const NodeLink& link : links) {
    const std::uint32_t a = input.facets.of_node[link.a];
    const std::uint32_t b = input.facets.of_node[link.b];
    if (a == b || link.border == 0.0F)
      continue;
    const Eigen::Vector3d where = 0.5 * (input.nodes.sums(link.a).meanDirection() +
                                         input.nodes.sums(link.b).meanDirection());
    Border& border = borders[std::minmax(a, b)];
    border.all += link.border;
    if (meetSmoothly(input, windows.at(link.a), windows.at(link.b), where))
      border.smooth += link.border;
  }
  for (const auto& [pair, border] : borders)
    if (border.smooth >= kSmoothShare * border.all)
      surfaces.join(pair.first, pair.second);
}

} // namespace nurbs
} // namespace pcl
