// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "elimination_order.h"

#include <ccolamd.h>
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <new>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

class Cholmod {
public:
  Cholmod()
  {
    cholmod_start(&common_);
    common_.print = 0;
  }

  ~Cholmod() { cholmod_finish(&common_); }

  Cholmod(const Cholmod&) = delete;
  Cholmod&
  operator=(const Cholmod&) = delete;

  cholmod_common*
  operator->()
  {
    return &common_;
  }

  cholmod_common*
  get()
  {
    return &common_;
  }

private:
  cholmod_common common_{};
};

/** Upper triangle of the pattern of the normal equations. */
cholmod_sparse*
patternOf(int count, const VariablePairs& pairs, Cholmod& common)
{
  const auto size = static_cast<std::size_t>(count);
  cholmod_triplet* entries = cholmod_allocate_triplet(
      size, size, size + pairs.size(), 1, CHOLMOD_PATTERN, common.get());
  if (entries == nullptr)
    throw std::bad_alloc();
  auto* const rows = static_cast<int*>(entries->i);
  auto* const columns = static_cast<int*>(entries->j);
  const auto add = [&](int a, int b) {
    rows[entries->nnz] = std::min(a, b);
    columns[entries->nnz++] = std::max(a, b);
  };
  for (int k = 0; k < count; ++k)
    add(k, k);
  for (const auto& [a, b] : pairs)
    add(a, b);
  cholmod_sparse* pattern = cholmod_triplet_to_sparse(entries, 0, common.get());
  cholmod_free_triplet(&entries, common.get());
  if (pattern == nullptr)
    throw std::bad_alloc();
  return pattern;
}

} // namespace

std::vector<int>
eliminationOrder(int count, const VariablePairs& pairs)
{
  if (count == 0)
    return {};
  Cholmod common;
  cholmod_sparse* pattern = patternOf(count, pairs, common);
  common->nmethods = 2;
  common->method[0].ordering = CHOLMOD_AMD;
  common->method[1].ordering = CHOLMOD_METIS;
  common->supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_factor* factor = cholmod_analyze(pattern, common.get());
  cholmod_free_sparse(&pattern, common.get());
  if (factor == nullptr)
    throw std::bad_alloc();
  const auto* const order = static_cast<const int*>(factor->Perm);
  std::vector<int> result(order, order + count);
  cholmod_free_factor(&factor, common.get());
  return result;
}

std::vector<int>
constrainedOrder(const std::vector<std::vector<int>>& rows,
                 const std::vector<int>& last)
{
  const auto count = static_cast<int>(last.size());
  std::vector<int> starts(last.size() + 1, 0); // of columns
  for (const std::vector<int>& row : rows)
    for (const int column : row)
      ++starts[static_cast<std::size_t>(column) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  const int entries = starts.back();
  const std::size_t space =
      ccolamd_recommended(entries, static_cast<int>(rows.size()), count);
  std::vector<int> indices(std::max<std::size_t>(space, 1));
  std::vector<int> ends = starts;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const int column : rows[row])
      indices[static_cast<std::size_t>(ends[static_cast<std::size_t>(column)]++)] =
          static_cast<int>(row);
  std::array<double, CCOLAMD_KNOBS> knobs{};
  std::array<int, CCOLAMD_STATS> statistics{};
  ccolamd_set_defaults(knobs.data());
  knobs[CCOLAMD_DENSE_ROW] = -1; // separators are long rows, and matter
  knobs[CCOLAMD_DENSE_COL] = -1;
  std::vector<int> groups = last;
  if (ccolamd(static_cast<int>(rows.size()),
              count,
              static_cast<int>(indices.size()),
              indices.data(),
              starts.data(),
              knobs.data(),
              statistics.data(),
              groups.data()) == 0)
    throw std::bad_alloc(); // the pattern is valid
  starts.resize(last.size());
  return starts;
}

std::vector<int>
eliminationOrder(const PoseGraphProblem& problem)
{
  std::vector<int> variables(problem.poses.size(), -1);
  std::vector<int> poses;
  for (std::size_t k = 0; k < problem.poses.size(); ++k)
    if (problem.held[k] == 0) {
      variables[k] = static_cast<int>(poses.size());
      poses.push_back(static_cast<int>(k));
    }
  VariablePairs pairs;
  for (const ProblemFactor& factor : problem.factors) {
    const int a =
        factor.first < 0 ? -1 : variables[static_cast<std::size_t>(factor.first)];
    const int b = variables[static_cast<std::size_t>(factor.second)];
    if (a >= 0 && b >= 0)
      pairs.emplace_back(a, b);
  }
  std::vector<int> order = eliminationOrder(static_cast<int>(poses.size()), pairs);
  for (int& k : order)
    k = poses[static_cast<std::size_t>(k)];
  return order;
}

} // namespace nurbs
} // namespace pcl
