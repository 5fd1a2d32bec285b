// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Rays against surfaces: the kernel's own intersection of the exact NURBS is the
// oracle.

#include "random_primitives.h"

#include <pcl/mapping/simulator/primitive_tree.h>
#include <pcl/surface/nurbs/closest_point.h>
#include <pcl/surface/nurbs/ray_intersection.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr double kFar = 100.0;

/** Whether the NURBS of a plane patch is larger than the patch. */
bool
isCutOut(const Primitive& primitive)
{
  const auto* plane = std::get_if<PlanePatch>(&primitive);
  return plane != nullptr && (plane->outline != PlanePatch::Outline::Rectangle ||
                              plane->openings.columns > 0);
}

TEST(Primitives, hitsLieOnTheExactNurbs)
{
  CounterRandom random(1);
  int hits = 0;
  for (int round = 0; round < 12; ++round)
    for (const Primitive& primitive : randomPrimitives(random, 1.0)) {
      const ClosestPointFinder surface(toNurbs(primitive));
      for (int k = 0; k < 40; ++k) {
        const Beam ray = randomBeam(random, 1.0);
        const double distance = intersect(primitive, ray, 0.0, kFar);
        if (distance > kFar)
          continue;
        ++hits;
        ASSERT_LT(surface.find(ray.at(distance)).distance, 1e-9)
            << "kind " << primitive.index();
      }
    }
  EXPECT_GT(hits, 500);
}

TEST(Primitives, firstHitIsTheKernels)
{
  CounterRandom random(2);
  int hits = 0;
  for (int round = 0; round < 10; ++round)
    for (const Primitive& primitive : randomPrimitives(random, 1.0)) {
      const RayIntersector oracle(toNurbs(primitive));
      for (int k = 0; k < 30; ++k) {
        const Beam ray = randomBeam(random, 1.0);
        const double distance = intersect(primitive, ray, 0.0, kFar);
        const auto truth = oracle.intersect(Ray{ray.origin, ray.direction});
        if (isCutOut(primitive)) { // the oracle sees the whole rectangle
          EXPECT_TRUE(distance > kFar || !truth.empty());
          continue;
        }
        ASSERT_EQ(distance < kFar, !truth.empty()) << "kind " << primitive.index();
        if (truth.empty())
          continue;
        ++hits;
        ASSERT_NEAR(distance, truth.front().t, 1e-8) << "kind " << primitive.index();
      }
    }
  EXPECT_GT(hits, 300);
}

TEST(Primitives, closedFormsOfTheirShapes)
{
  const Beam down{{0.3, 0.2, 5.0}, {0.0, 0.0, -1.0}};
  SpherePatch sphere;
  EXPECT_NEAR(
      intersect(sphere, down, 0.0, kFar), 5.0 - std::sqrt(1.0 - 0.09 - 0.04), 1e-14);
  sphere.latitude = {-M_PI_2, 0.0}; // only the lower half: through the open top
  EXPECT_NEAR(
      intersect(sphere, down, 0.0, kFar), 5.0 + std::sqrt(1.0 - 0.09 - 0.04), 1e-14);
  const Beam side{{-7.0, 0.5, 0.25}, {1.0, 0.0, 0.0}};
  EXPECT_NEAR(intersect(FrustumPatch(), side, 0.0, kFar), 7.0 - std::sqrt(0.75), 1e-14);
  TorusPatch torus;
  const Beam over{{1.0, 0.0, 3.0}, {0.0, 0.0, -1.0}};
  EXPECT_NEAR(intersect(torus, over, 0.0, kFar), 2.75, 1e-12);
  EXPECT_GT(intersect(torus, {{0.0, 0.0, 3.0}, {0.0, 0.0, -1.0}}, 0.0, kFar), kFar);
  // A road: crown 0.2 in the middle of 10 m.
  RuledPatch road{{Eigen::Vector3d(0, 5, 0), {0, 0, 0.4}, {0, -5, 0}},
                  {Eigen::Vector3d(3, 5, 0), {3, 0, 0.4}, {3, -5, 0}}};
  EXPECT_NEAR(intersect(road, {{1.0, 2.5, 2.0}, {0, 0, -1}}, 0.0, kFar), 1.85, 1e-12);
}

TEST(Primitives, openingsLetRaysThroughAndArchesAreRound)
{
  PlanePatch wall;
  wall.size_x = 4.0;
  wall.size_y = 3.0;
  wall.openings = {2, 1, {0.5, 0.5}, {1.0, 1.0}, {2.0, 3.0}, true};
  const auto isMet = [&](double x, double y) {
    return intersect(wall, {{x, y, 2.0}, {0, 0, -1}}, 0.0, kFar) < kFar;
  };
  EXPECT_FALSE(isMet(1.0, 1.0));
  EXPECT_FALSE(isMet(3.0, 1.0));
  EXPECT_TRUE(isMet(2.0, 1.0));
  EXPECT_FALSE(isMet(1.0, 1.99)); // below the top of the arch
  EXPECT_TRUE(isMet(1.0, 2.01));
  EXPECT_TRUE(isMet(0.6, 1.95)); // in the corner above the arch
  EXPECT_FALSE(isMet(-0.1, 1.0));
}

TEST(Primitives, limitsOfTheDistanceHold)
{
  const Beam ray{{0.0, 0.0, 3.0}, {0.0, 0.0, -1.0}};
  const SpherePatch sphere;
  EXPECT_NEAR(intersect(sphere, ray, 2.5, kFar), 4.0, 1e-14);
  EXPECT_GT(intersect(sphere, ray, 0.0, 1.9), kFar);
}

TEST(Primitives, normalsAreThoseOfTheNurbsAndMotionsMoveHits)
{
  CounterRandom random(3);
  int compared = 0;
  for (int round = 0; round < 20; ++round)
    for (const Primitive& primitive : randomPrimitives(random, 1.0)) {
      const ClosestPointFinder surface(toNurbs(primitive));
      const Eigen::Isometry3d motion = randomFrame(random, 50.0);
      for (int k = 0; k < 10; ++k) {
        const Beam ray = randomBeam(random, 1.0);
        const double distance = intersect(primitive, ray, 0.0, kFar);
        const Beam moved_ray{motion * ray.origin, motion.linear() * ray.direction};
        const double again = intersect(moved(primitive, motion), moved_ray, 0.0, kFar);
        if (distance > kFar)
          continue;
        ASSERT_NEAR(distance, again, 1e-9);
        const Eigen::Vector3d point = ray.at(distance);
        // A point off the surface by the normal has its foot at the point.
        const Eigen::Vector3d off = point + 1e-4 * normalAt(primitive, point);
        ASSERT_LT((surface.find(off).point - point).norm(), 1e-6)
            << "kind " << primitive.index();
        ASSERT_TRUE(boundsOf(primitive).exteriorDistance(point) < 1e-9);
        ++compared;
      }
    }
  EXPECT_GT(compared, 200);
}

TEST(PrimitiveTree, equalsBruteForce)
{
  CounterRandom random(4);
  std::vector<Primitive> all;
  for (int k = 0; k < 150; ++k)
    for (const Primitive& primitive : randomPrimitives(random, 30.0))
      all.push_back(moved(
          primitive, Eigen::Isometry3d(Eigen::Translation3d(2000.0, -900.0, 5.0))));
  const PrimitiveTree tree(all);
  int hits = 0;
  for (int k = 0; k < 3000; ++k) {
    Beam ray = randomBeam(random, 30.0);
    ray.origin += Eigen::Vector3d(2000.0, -900.0, 5.0);
    const double near = k % 3 == 0 ? 20.0 : 0.0;
    double best = 150.0;
    for (const Primitive& primitive : all)
      best = std::min(best, intersect(primitive, ray, near, best));
    const BeamHit hit = tree.cast(ray, near, 150.0);
    ASSERT_EQ(hit.distance, best);
    ASSERT_EQ(hit.surface == BeamHit::kNothing, best == 150.0);
    hits += best < 150.0 ? 1 : 0;
  }
  EXPECT_GT(hits, 1000);
}

TEST(PrimitiveTree, aFanIsItsRaysOneByOne)
{
  CounterRandom random(5);
  std::vector<Primitive> all;
  for (int k = 0; k < 400; ++k)
    for (const Primitive& primitive : randomPrimitives(random, 10.0))
      all.push_back(primitive);
  const PrimitiveTree tree(all);
  int hits = 0;
  for (int round = 0; round < 200; ++round) {
    const Eigen::Vector3d origin = randomBeam(random, 10.0).origin;
    std::vector<Eigen::Vector3d> directions;
    std::vector<BeamHit> fan;
    for (int k = 0; k < 1 + round % 70; ++k) { // with and without a full last group
      const double angle = 0.02 * k + round;
      directions.emplace_back(round % 5 == 0 ? randomBeam(random, 1.0).direction
                                             : Eigen::Vector3d(std::cos(angle),
                                                               0.8 * std::sin(angle),
                                                               0.6 * std::sin(angle)));
      fan.push_back({random.uniform(0.0, 60.0), BeamHit::kNothing});
    }
    const std::vector<BeamHit> limits = fan;
    tree.castFan(origin, directions, 0.5, fan);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const BeamHit one = tree.cast({origin, directions[k]}, 0.5, limits[k].distance);
      ASSERT_EQ(fan[k].distance, one.distance);
      ASSERT_EQ(fan[k].surface, one.surface);
      hits += one.surface != BeamHit::kNothing ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 400);
  std::vector<BeamHit> none;
  EXPECT_THROW(
      tree.castFan(Eigen::Vector3d::Zero(), {Eigen::Vector3d::UnitX()}, 0, none),
      std::invalid_argument);
}

TEST(PrimitiveTree, emptyAndEqualPrimitives)
{
  const Beam ray{{0.0, 0.0, 3.0}, {0.0, 0.0, -1.0}};
  EXPECT_EQ(PrimitiveTree({}).cast(ray, 0.0, kFar).surface, BeamHit::kNothing);
  const PrimitiveTree same(std::vector<Primitive>(1000, SpherePatch()));
  EXPECT_NEAR(same.cast(ray, 0.0, kFar).distance, 2.0, 1e-14);
}

TEST(CounterRandom, momentsAndIndependenceOfOrder)
{
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 200000;
  for (int k = 0; k < kCount; ++k) {
    CounterRandom random(7, 3, static_cast<std::uint64_t>(k));
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 4.0 * std::sqrt(2.0 / kCount));
  EXPECT_EQ(CounterRandom(7, 3, 5).bits(), CounterRandom(7, 3, 5).bits());
  EXPECT_NE(CounterRandom(7, 3, 5).bits(), CounterRandom(7, 5, 3).bits());
  EXPECT_NE(CounterRandom(7).bits(), CounterRandom(8).bits());
}

} // namespace
