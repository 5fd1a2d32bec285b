// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Reconstruction of public data sets: coverage of indoor frames, a cylinder's radius,
// an exact mesh, and every other kind without a crash.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/nurbs_reconstruction.h>
#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/surface/nurbs/differential_geometry.h>

#include "data_files.h"
#include "exact_mesh.h"
#include "reconstruction_checks.h"
#include "test_data.h"

#include <pcl/common/point_tests.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Reconstructor = NurbsReconstruction<PointXYZ>;

/** Reconstruct a file with the tool's defaults.
 * \return share of the finite points within tolerance of a patch */
double
reconstructFile(const std::filesystem::path& file,
                const CloudReadOptions& options,
                Reconstructor& reconstructor)
{
  const InputCloud input = readCloud(file.string(), options);
  if (input.intrinsics)
    reconstructor.setGeometry(
        GridGeometry::pinhole(static_cast<int>(input.cloud->width),
                              static_cast<int>(input.cloud->height),
                              *input.intrinsics));
  ReconstructionOptions reconstruction;
  reconstruction.threads = 2;
  reconstructor.setOptions(reconstruction);
  reconstructor.setInputCloud(input.cloud);
  SurfaceModel model;
  if (!reconstructor.reconstruct(model))
    return 0.0;
  const auto valid =
      std::count_if(input.cloud->begin(),
                    input.cloud->end(),
                    [](const PointXYZ& point) { return isFinite(point); });
  return static_cast<double>(
             summarize(reconstructor.getReconstruction()).covered_points) /
         static_cast<double>(valid);
}

GridPoints
pointsOf(const Reconstructor& reconstructor)
{
  return toGridPoints(*reconstructor.getOrganizedCloud(), reconstructor.getGeometry());
}

struct Source {
  std::string folder;
  std::string extension;
  CloudReadOptions options;
  double least_coverage;
};

CloudReadOptions
depth(double scale, bool rotated = false)
{
  CloudReadOptions options;
  options.depth_scale = scale;
  options.rotated_depth_bits = rotated;
  return options;
}

CloudReadOptions
withoutReflectance()
{
  CloudReadOptions options;
  options.bin_values_per_point = 3;
  return options;
}

class RealReconstruction : public testing::TestWithParam<Source> {};

TEST_P(RealReconstruction, coversTheCloud)
{
  PCL_NURBS_DATA_OR_SKIP(place, GetParam().folder);
  for (const auto& file : filesIn(place, GetParam().extension, 2)) {
    SCOPED_TRACE(file.filename().string());
    Reconstructor reconstructor;
    const double share = reconstructFile(file, GetParam().options, reconstructor);
    std::printf("%s %s: coverage %.3f, %zu patches\n",
                GetParam().folder.c_str(),
                file.filename().c_str(),
                share,
                reconstructor.getReconstruction().model.patches.size());
    EXPECT_GE(share, GetParam().least_coverage);
    if (share > 0.0) {
      EXPECT_GE(checkOwnPoints(
                    pointsOf(reconstructor), reconstructor.getReconstruction(), 101)
                    .inside,
                0.97);
    }
  }
}

std::string
nameOf(const testing::TestParamInfo<Source>& info)
{
  std::string name = info.param.folder;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Indoors,
    RealReconstruction,
    testing::Values(Source{"pcl_organized", ".pcd", {}, 0.9},
                    Source{"osd_labelled", ".pcd", {}, 0.9},
                    Source{"single_frames/TUM_depth.png", ".png", depth(5000), 0.9},
                    Source{
                        "single_frames/SUN_depth.png", ".png", depth(1000, true), 0.9},
                    Source{"tum_fr1_desk/depth", ".png", depth(5000), 0.9},
                    Source{"redwood_livingroom/depth", ".png", {}, 0.9},
                    Source{"icl_nuim_lr_kt0/depth", ".png", depth(5000), 0.9},
                    Source{"seven_scenes_redkitchen", ".png", {}, 0.9}),
    nameOf);

// What is covered there depends on the plants; it must work.
INSTANTIATE_TEST_SUITE_P(
    Elsewhere,
    RealReconstruction,
    testing::Values(Source{"pcl_unorganized", ".pcd", {}, 0.0},
                    Source{"synpeb_room", ".pcd", {}, 0.0},
                    Source{"isprs_urban_als", ".pcd", {}, 0.0},
                    Source{"registration_pairs", ".ply", {}, 0.0},
                    Source{"kitti_odometry/sequences/00", ".bin", {}, 0.3},
                    Source{"kitti_odometry/sequences/01_thin3", ".bin", {}, 0.0},
                    Source{"kitti_raw", ".bin", {}, 0.0},
                    Source{"balm_realworld", ".bin", {}, 0.0},
                    Source{"kitti_07_submaps", ".bin", withoutReflectance(), 0.0}),
    nameOf);

/** The camera's view of the knot, and the mesh it was rendered from. */
TEST(RealReconstruction, knotLiesOnItsExactMesh)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "synthetic_knot");
  CloudReadOptions options;
  options.intrinsics =
      PinholeIntrinsics{415.69219381653068, 415.69219381653068, 319.5, 239.5};
  Reconstructor reconstructor;
  const double share =
      reconstructFile(folder / "depth_syn.png", options, reconstructor);
  EXPECT_GE(share, 0.85);
  std::ifstream stream(folder / "depth_syn_camera.json");
  const auto values = nlohmann::json::parse(stream)["extrinsic"]
                          .get<std::vector<std::vector<double>>>();
  Eigen::Matrix4d extrinsic;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      extrinsic(row, column) =
          values.at(static_cast<std::size_t>(column)).at(static_cast<std::size_t>(row));
  const ExactMesh mesh(folder / "knot.ply", 0.01, Eigen::Affine3d(extrinsic));
  std::vector<double> distances;
  const Reconstruction& result = reconstructor.getReconstruction();
  const GridPoints points = pointsOf(reconstructor);
  for (std::size_t cell = 0; cell < points.size(); cell += 37) {
    if (result.labels[cell] == 0)
      continue;
    const NurbsSurface& surface =
        result.model.patches[result.labels[cell] - 1].geometry.surface();
    const auto column = static_cast<double>(cell % 640);
    const auto row = static_cast<double>(cell / 640);
    distances.push_back(mesh.distance(surface.evaluate(
        surface.knotsU().clampToDomain(column), surface.knotsV().clampToDomain(row))));
  }
  std::sort(distances.begin(), distances.end());
  std::printf("knot: coverage %.3f, median %.5f m, 95 %% %.5f m\n",
              share,
              distances[distances.size() / 2],
              distances[distances.size() * 95 / 100]);
  EXPECT_LE(distances[distances.size() / 2], 0.0015);
  EXPECT_LE(distances[distances.size() * 95 / 100], 0.004);
}

/** Radii of the post, row by row, from the curvature in the middle of the patch and
 * from its outline: the outermost rays touch the cylinder. */
TEST(RealReconstruction, bollardIsACylinder)
{
  PCL_NURBS_DATA_OR_SKIP(file, "redwood_bollard/01220_depth.png");
  Reconstructor reconstructor;
  EXPECT_GE(reconstructFile(file, {}, reconstructor), 0.9);
  const Reconstruction& result = reconstructor.getReconstruction();
  const GridPoints points = pointsOf(reconstructor);
  const std::uint32_t post = result.labels[262 * 640 + 312];
  ASSERT_NE(post, 0U);
  const NurbsSurface& surface = result.model.patches[post - 1].geometry.surface();
  std::vector<double> curved;
  std::vector<double> outlined;
  for (int row = 130; row < 380; ++row) {
    int first = 640;
    int last = 0;
    for (int column = 0; column < 640; ++column)
      if (result.labels[static_cast<std::size_t>(row * 640 + column)] == post) {
        first = std::min(first, column);
        last = std::max(last, column);
      }
    ASSERT_LT(first, last) << row;
    const double middle = 0.5 * (first + last);
    const SurfaceCurvature bend = curvature(surface, middle, row);
    curved.push_back(1.0 / std::max(std::abs(bend.maximum), std::abs(bend.minimum)));
    const double nearest = surface.evaluate(middle, row).z();
    const double slope = 0.5 * (last - first + 1) / 525.0;
    const double sine = slope / std::hypot(1.0, slope);
    outlined.push_back(nearest * sine / (1.0 - sine));
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  const auto half = static_cast<std::ptrdiff_t>(curved.size() / 2);
  const double upper = median({curved.begin(), curved.begin() + half});
  const double lower = median({curved.begin() + half, curved.end()});
  const double outline = median(outlined);
  std::printf("bollard: radius %.4f m above, %.4f m below, outline %.4f m\n",
              upper,
              lower,
              outline);
  EXPECT_NEAR(upper / lower, 1.0, 0.2);
  EXPECT_NEAR(median(curved) / outline, 1.0, 0.2);
}

} // namespace
