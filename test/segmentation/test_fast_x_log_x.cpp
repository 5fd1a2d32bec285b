// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The error that FastXLogX states holds over all magnitudes and mantissas.

#include "fast_x_log_x.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using pcl::nurbs::FastXLogX;

void
expectClose(const FastXLogX& fast, double x)
{
  const double exact = x * std::log(x);
  EXPECT_LE(std::abs(fast(x) - exact), FastXLogX::kError * x) << x;
}

TEST(FastXLogX, keepsItsErrorAtEveryMantissa)
{
  const FastXLogX fast;
  for (int i = 0; i < 20000; ++i)
    for (const int exponent : {-149, -30, -1, 0, 1, 12, 131})
      expectClose(fast, std::ldexp(1.0 + i / 20000.0, exponent));
}

TEST(FastXLogX, keepsItsErrorAtTheEndsOfTableEntries)
{
  const FastXLogX fast;
  for (int entry = 0; entry <= 128; ++entry) {
    const double end = 1.0 + entry / 128.0;
    expectClose(fast, std::nextafter(end, 0.0));
    expectClose(fast, end);
  }
  EXPECT_NEAR(fast(1.0), 0.0, FastXLogX::kError);
}

TEST(FastXLogX, vanishesAtZero)
{
  const FastXLogX fast;
  EXPECT_EQ(fast(0.0), 0.0);
  EXPECT_EQ(fast(-1e-20), 0.0); // rounding may leave less than nothing
  EXPECT_EQ(fast(std::numeric_limits<double>::denorm_min()), 0.0);
}

} // namespace
