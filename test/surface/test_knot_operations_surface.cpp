// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Laws of the operations on the knots of surfaces, over degrees, knot vectors and
// weights.

#include <pcl/surface/nurbs/knot_operations.h>

#include "geometry_distance.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;

// Control points are of size up to 6.
constexpr double kSameSurface = 1e-13;

class SurfaceLaws : public testing::TestWithParam<std::tuple<int, int, bool, int>> {
protected:
  RandomNurbs random{31};
  NurbsSurface surface =
      random.surface(std::get<0>(GetParam()),
                     std::get<1>(GetParam()),
                     std::get<2>(GetParam()),
                     static_cast<test::KnotKind>(std::get<3>(GetParam())));
};

TEST_P(SurfaceLaws, insertionAndRemovalRestore)
{
  for (Direction direction : {Direction::U, Direction::V}) {
    const double u = random.inDomain(surface.knots(direction));
    const NurbsSurface refined = insertKnot(surface, direction, u);
    EXPECT_LT(maxDistance(refined, surface), kSameSurface);
    EXPECT_EQ(refined.knots(direction).multiplicity(u), 1);
    const auto restored = removeKnot(refined, direction, u, 1, 1e-10);
    EXPECT_EQ(restored.steps, 1);
    EXPECT_EQ(restored.geometry.knots(direction), surface.knots(direction));
    EXPECT_LT(maxDistance(restored.geometry, surface), 6e-13);
    EXPECT_EQ(restored.geometry.isRational(), surface.isRational());
  }
}

TEST_P(SurfaceLaws, partsAgree)
{
  const double u = random.inDomain(surface.knotsU());
  const double v = random.inDomain(surface.knotsV());
  const double v_min = surface.knotsV().domainMin();
  EXPECT_LT(maxDistance(subSurface(surface, u, surface.knotsU().domainMax(), v_min, v),
                        surface),
            kSameSurface);
  const auto [left, right] = split(surface, Direction::V, v);
  EXPECT_LT(maxDistance(left, surface), kSameSurface);
  EXPECT_LT(maxDistance(right, surface), kSameSurface);
  EXPECT_TRUE(clampKnots(surface, Direction::V).knotsV().isClamped());
  EXPECT_LT(maxDistance(clampKnots(surface, Direction::V), surface), kSameSurface);
}

TEST_P(SurfaceLaws, bezierPatchesAgree)
{
  const std::vector<NurbsSurface> patches = decomposeBezier(surface);
  const std::vector<double> u = surface.knotsU().breaks();
  const std::vector<double> v = surface.knotsV().breaks();
  ASSERT_EQ(patches.size(), (u.size() - 1) * (v.size() - 1));
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::size_t i = k / (v.size() - 1);
    const std::size_t j = k % (v.size() - 1);
    EXPECT_EQ(patches[k].knotsU(),
              KnotVector::bezier(surface.knotsU().degree(), u[i], u[i + 1]));
    EXPECT_EQ(patches[k].knotsV(),
              KnotVector::bezier(surface.knotsV().degree(), v[j], v[j + 1]));
    EXPECT_LT(maxDistance(patches[k], surface), kSameSurface);
  }
}

TEST_P(SurfaceLaws, removalErrorIsABound)
{
  const auto coarse = removeRedundantKnots(surface, 0.3);
  EXPECT_LE(coarse.max_error, 0.3);
  EXPECT_LE(maxDistance(coarse.geometry, surface), coarse.max_error + kSameSurface);
  EXPECT_EQ(coarse.steps,
            surface.knotsU().size() + surface.knotsV().size() -
                coarse.geometry.knotsU().size() - coarse.geometry.knotsV().size());
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         SurfaceLaws,
                         testing::Combine(testing::Values(1, 2, 3, 6),
                                          testing::Values(1, 3, 9),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

} // namespace
