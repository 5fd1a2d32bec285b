// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The demo scene, whose truth is known exactly, comes out as it is.

#include <pcl/mapping/demo_scene.h>
#include <pcl/mapping/nurbs_reconstruction.h>
#include <pcl/mapping/reconstruction_statistics.h>

#include "reconstruction_checks.h"

#include <cmath>
#include <map>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Reconstructor = NurbsReconstruction<PointXYZ>;

/** The demo scene at full size, reconstructed once. */
class DemoReconstruction : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    scene = new DemoScene;
    reconstructor = new Reconstructor;
    run(*reconstructor, 1);
  }

  static void
  TearDownTestSuite()
  {
    delete reconstructor;
    delete scene;
  }

  static void
  run(Reconstructor& target, int threads)
  {
    ReconstructionOptions options;
    options.threads = threads;
    target.setOptions(options);
    target.setInputCloud(scene->cloud());
    target.setSensorNoise(scene->noise());
    SurfaceModel model;
    ASSERT_TRUE(target.reconstruct(model));
  }

  static GridPoints
  points()
  {
    return toGridPoints(*reconstructor->getOrganizedCloud(),
                        reconstructor->getGeometry());
  }

  static DemoScene* scene;
  static Reconstructor* reconstructor;
};

DemoScene* DemoReconstruction::scene = nullptr;
Reconstructor* DemoReconstruction::reconstructor = nullptr;

TEST_F(DemoReconstruction, coversTheSceneWithFewPatches)
{
  const Reconstruction& result = reconstructor->getReconstruction();
  const ReconstructionStatistics statistics = summarize(result);
  EXPECT_GE(static_cast<double>(statistics.covered_points),
            0.95 * static_cast<double>(result.labels.size()));
  EXPECT_LE(result.model.patches.size(), 12U);
}

TEST_F(DemoReconstruction, threadsDoNotChangeABit)
{
  for (const int threads : {2, 4}) {
    SCOPED_TRACE(threads);
    Reconstructor other;
    run(other, threads);
    expectIdentical(reconstructor->getReconstruction(), other.getReconstruction());
  }
}

TEST_F(DemoReconstruction, patchesHoldTheirOwnPoints)
{
  const OwnPoints own =
      checkOwnPoints(points(), reconstructor->getReconstruction(), 23);
  EXPECT_GE(own.inside, 0.985);
  EXPECT_GE(own.agreeing, 0.995);
}

/** The surface is nearer to the truth than the points are: its distance from the true
 * surface, where the points are, is below the noise of a point. */
TEST_F(DemoReconstruction, everyFaceIsNearerToTheTruthThanItsPoints)
{
  const GridPoints grid = points();
  const Reconstruction& result = reconstructor->getReconstruction();
  struct Sum {
    double error = 0.0;
    double noise = 0.0;
    double count = 0.0;
  };
  std::map<std::uint32_t, Sum> faces;
  for (std::size_t cell = 0; cell < grid.size(); cell += 5) {
    if (result.labels[cell] == 0)
      continue;
    const NurbsSurface& surface =
        result.model.patches[result.labels[cell] - 1].geometry.surface();
    const std::size_t width = scene->cloud()->width;
    const Eigen::Vector3d foot =
        surface.evaluate(surface.knotsU().clampToDomain(double(cell % width)),
                         surface.knotsV().clampToDomain(double(cell / width)));
    Sum& sum = faces[scene->labels()[cell]];
    sum.error += std::pow(scene->distance(scene->labels()[cell], foot), 2);
    sum.noise += std::pow(scene->noise().sigma(grid.depth[cell]), 2);
    sum.count += 1.0;
  }
  for (const auto& [face, sum] : faces) {
    if (sum.count < 200.0)
      continue;
    EXPECT_LT(std::sqrt(sum.error / sum.count), std::sqrt(sum.noise / sum.count))
        << scene->surfaceName(face);
  }
}

/** Points all over the trimmed patches lie near to some true surface: none bulges over
 * empty space. */
TEST_F(DemoReconstruction, noPatchBulgesOverEmptySpace)
{
  constexpr int kSteps = 60;
  for (const SurfacePatch& patch : reconstructor->getReconstruction().model.patches) {
    const NurbsSurface& surface = patch.geometry.surface();
    const auto at = [](const KnotVector& knots, int k) {
      return knots.domainMin() + (k + 0.5) / kSteps * knots.domainLength();
    };
    int inside = 0;
    int far = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double u = at(surface.knotsU(), i);
        const double v = at(surface.knotsV(), j);
        if (!patch.geometry.contains(u, v))
          continue;
        ++inside;
        const Eigen::Vector3d point = surface.evaluate(u, v);
        far += scene->distance(point) > 3.0 * scene->noise().sigma(point.z()) ? 1 : 0;
      }
    EXPECT_GT(inside, 0);
    EXPECT_LE(far, inside / 50) << "patch of segment " << patch.label;
  }
}

} // namespace
