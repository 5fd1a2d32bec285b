// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The bounds of EdgeBatch are never below the exact gains and hardly above.

#include "edge_batch.h"

#include <pcl/segmentation/random_walk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace {

using pcl::nurbs::EdgeBatch;

/** Exact gain of an edge of a batch, from the same doubles as the batch had. */
double
exactGain(double loop_a, double loop_b, double weight)
{
  const auto loop = [](double w) {
    return pcl::nurbs::SelfLoop{w, pcl::nurbs::xLogX(w)};
  };
  return pcl::nurbs::scaledEdgeGain(loop(loop_a), loop(loop_b), weight);
}

/** Fill a batch by \a draw (three doubles: loops and weight) and compare all. */
template <typename Draw>
void
expectBounds(const Draw& draw)
{
  EdgeBatch batch{};
  std::array<double, EdgeBatch::kMost> exact{};
  for (batch.count = 0; batch.count < EdgeBatch::kMost; ++batch.count) {
    const std::size_t k = batch.count;
    const auto [loop_a, loop_b, weight] = draw();
    batch.loop_a[k] = static_cast<float>(loop_a);
    batch.loop_b[k] = static_cast<float>(loop_b);
    batch.weight[k] = static_cast<float>(weight);
    exact[k] = exactGain(loop_a, loop_b, weight);
  }
  batch.boundGains();
  for (std::size_t k = 0; k < EdgeBatch::kMost; ++k) {
    const double bound = static_cast<double>(batch.gain[k]);
    EXPECT_GE(bound, exact[k]) << batch.loop_a[k] << ' ' << batch.weight[k];
    EXPECT_LE(bound, exact[k] + 2.0 * EdgeBatch::kError);
  }
}

using Edge = std::array<double, 3>;

TEST(EdgeBatch, boundsGainsOfAnyLoops)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 5000; ++round)
    expectBounds([&] {
      const double weight = uniform(random);
      return Edge{weight + (1.0 - weight) * uniform(random),
                  weight + (1.0 - weight) * uniform(random),
                  weight};
    });
}

TEST(EdgeBatch, boundsGainsOfAllMagnitudes)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> digits(-40.0, 0.0);
  for (int round = 0; round < 5000; ++round)
    expectBounds([&] {
      const double weight = std::pow(10.0, digits(random));
      return Edge{std::max(weight, std::pow(10.0, digits(random))),
                  std::max(weight, std::pow(10.0, digits(random))),
                  weight};
    });
}

TEST(EdgeBatch, boundsGainsOfLoopsThatAreUsedUp)
{
  // Nothing or next to nothing remains of a loop: the logarithm of the rest is
  // steepest.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::uniform_real_distribution<double> digits(-17.0, -3.0);
  for (int round = 0; round < 5000; ++round)
    expectBounds([&] {
      const double weight = uniform(random);
      return Edge{std::min(1.0, weight * (1.0 + std::pow(10.0, digits(random)))),
                  weight,
                  weight};
    });
}

TEST(EdgeBatch, takesNothingForNothing)
{
  expectBounds([] { return Edge{1.0, 0.5, 0.0}; });
  expectBounds([] { return Edge{0.0, 0.0, 0.0}; });
}

} // namespace
