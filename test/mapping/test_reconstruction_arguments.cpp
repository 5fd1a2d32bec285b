// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What callers of reconstructSurfaces() get wrong, and their callbacks.

#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/mapping/surface_reconstruction.h>

#include "camera_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

TEST(ReconstructionArguments, labelsMayBeAnyNumbers)
{
  const GridPoints points = noisyView(tilted, 0.002);
  const std::uint32_t label = std::numeric_limits<std::uint32_t>::max();
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points, label), constantNoise(0.002));
  ASSERT_EQ(result.model.patches.size(), 1U);
  EXPECT_EQ(result.model.patches.front().label, label);
}

TEST(ReconstructionArguments, nothingLabelledIsNothing)
{
  const GridPoints points = noisyView(tilted, 0.002);
  const Reconstruction result =
      reconstructSurfaces(points, oneSegment(points, 0), constantNoise(0.002));
  EXPECT_TRUE(result.model.patches.empty());
  EXPECT_EQ(summarize(result).measured_points, 0U);
  EXPECT_EQ(summarize(result).rmse, 0.0);
}

TEST(ReconstructionArguments, wrongArgumentsThrow)
{
  const GridPoints points = noisyView(tilted, 0.002);
  const SensorNoise noise = constantNoise(0.002);
  const auto labels = oneSegment(points);
  const auto expectThrow = [&](const auto& change) {
    ReconstructionOptions options;
    options.threads = 2;
    change(options);
    EXPECT_THROW(reconstructSurfaces(points, labels, noise, options),
                 std::invalid_argument);
  };
  using Options = ReconstructionOptions;
  expectThrow([](Options& o) { o.threads = 0; });
  expectThrow([](Options& o) { o.min_patch_points = 3; });
  expectThrow([](Options& o) { o.hold_out_every = 1; });
  expectThrow([](Options& o) { o.hold_out_every = -1; });
  expectThrow([](Options& o) { o.tolerance_sigmas = 0.0; });
  expectThrow([](Options& o) { o.tolerance = std::nan(""); });
  // Found by the fitter, on a worker thread.
  expectThrow([](Options& o) { o.knots.max_degree = 12; });
  expectThrow([](Options& o) { o.fit.loss_scale = -1.0; });
  EXPECT_THROW(reconstructSurfaces(points, {1, 2, 3}, noise), std::invalid_argument);
}

TEST(ReconstructionArguments, exceptionsOfCallbacksComeThrough)
{
  const GridPoints points = noisyView(tilted, 0.002);
  ReconstructionOptions options;
  options.threads = 2;
  options.progress = [](double) { throw std::runtime_error("enough"); };
  EXPECT_THROW(
      reconstructSurfaces(points, oneSegment(points), constantNoise(0.002), options),
      std::runtime_error);
}

TEST(ReconstructionArguments, progressEndsAtOneAndStopStops)
{
  const GridPoints points = noisyView(tilted, 0.002);
  std::vector<std::uint32_t> labels = oneSegment(points);
  std::fill(labels.begin() + kWidth * kHeight / 2, labels.end(), 2U);
  ReconstructionOptions options;
  std::vector<double> shares;
  options.progress = [&](double share) { shares.push_back(share); };
  reconstructSurfaces(points, labels, constantNoise(0.002), options);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_DOUBLE_EQ(shares[0], 0.5);
  EXPECT_DOUBLE_EQ(shares[1], 1.0);
  options.stop = [&] { return shares.size() > 2; };
  const Reconstruction half =
      reconstructSurfaces(points, labels, constantNoise(0.002), options);
  EXPECT_EQ(half.model.patches.size(), 1U);
}

} // namespace
