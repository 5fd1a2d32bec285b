// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Candidates come out from the best to the worst, however their keys are spread.

#include "candidate_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using pcl::nurbs::Candidate;
using pcl::nurbs::CandidateOrder;

void
expectSorted(const std::vector<double>& keys)
{
  CandidateOrder order;
  std::vector<Candidate> sorted;
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    order.add({keys[i], i * 7919 % 1000, i});
    sorted.emplace_back(keys[i], i * 7919 % 1000, i);
  }
  order.sort();
  std::sort(sorted.begin(), sorted.end());
  while (!sorted.empty()) {
    ASSERT_FALSE(order.empty());
    const Candidate best = order.take();
    EXPECT_EQ(best.key, sorted.back().key);
    EXPECT_EQ(best.tie, sorted.back().tie);
    sorted.pop_back();
  }
  EXPECT_TRUE(order.empty());
}

TEST(CandidateOrder, keysOfAnySpreadAreSorted)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> even(3.0, 4.0);
  for (const std::size_t size : {0U, 1U, 2U, 15U, 16U, 17U, 128U, 5000U}) {
    std::vector<double> keys(size);
    for (double& key : keys)
      key = even(random);
    expectSorted(keys);
    for (double& key : keys) // all but a few in one bin
      key = std::pow(key - 3.0, 40.0);
    expectSorted(keys);
    for (double& key : keys) // few values
      key = std::floor(4.0 * even(random));
    expectSorted(keys);
    std::fill(keys.begin(), keys.end(), -1.5);
    expectSorted(keys);
    if (!keys.empty()) {
      keys.back() = std::nextafter(-1.5, 0.0);
      expectSorted(keys);
      keys.back() = -1e300;
      expectSorted(keys);
    }
  }
}

TEST(CandidateOrder, widthsTooSmallToDivideByAreNoTrouble)
{
  std::vector<double> keys(100, 0.0);
  keys[50] = std::numeric_limits<double>::denorm_min();
  keys[70] = std::numeric_limits<double>::min();
  expectSorted(keys);
}

TEST(CandidateOrder, whatIsPutBackComesOutInItsPlace)
{
  CandidateOrder order;
  for (std::uint32_t i = 0; i < 40; ++i)
    order.add({static_cast<double>(i), i, i});
  order.sort();
  EXPECT_EQ(order.take().key, 39.0);
  order.putBack({20.5, 100, 100});
  EXPECT_FALSE(order.isBest({37.0, 101, 101}));
  EXPECT_TRUE(order.isBest({38.5, 101, 101}));
  double before = 39.0;
  bool seen = false;
  while (!order.empty()) {
    const Candidate next = order.take();
    EXPECT_LT(next.key, before);
    before = next.key;
    seen |= next.key == 20.5;
  }
  EXPECT_TRUE(seen);
}

} // namespace
