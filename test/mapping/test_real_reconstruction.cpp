// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Reconstruction of public data sets: coverage of indoor frames, a cylinder's radius,
// an exact mesh, and every other kind without a crash.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/nurbs_reconstruction.h>
#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/surface/nurbs/closest_point.h>

#include "data_files.h"
#include "exact_mesh.h"
#include "reconstruction_checks.h"
#include "test_data.h"

#include <pcl/common/point_tests.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>

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
  double least_inside = 0.96; // points of a patch that its trims hold
};

void
PrintTo(const Source& source, std::ostream* stream)
{
  *stream << source.folder;
}

CloudReadOptions
rotatedDepthScale(double scale)
{
  CloudReadOptions options = depthScale(scale);
  options.rotated_depth_bits = true;
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
                GetParam().least_inside);
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
    testing::Values(
        Source{"pcl_organized", ".pcd", {}, 0.9},
        Source{"osd_labelled", ".pcd", {}, 0.9},
        Source{"single_frames/TUM_depth.png", ".png", depthScale(5000), 0.9},
        Source{"single_frames/SUN_depth.png", ".png", rotatedDepthScale(1000), 0.9},
        Source{"tum_fr1_desk/depth", ".png", depthScale(5000), 0.9},
        Source{"redwood_livingroom/depth", ".png", {}, 0.9},
        Source{"icl_nuim_lr_kt0/depth", ".png", depthScale(5000), 0.9},
        Source{"seven_scenes_redkitchen", ".png", {}, 0.9}),
    nameOf);

// What is covered there depends on the plants; it must work. Points of submaps come
// from several places, so that neighbours in their raster do not follow each other.
INSTANTIATE_TEST_SUITE_P(
    Elsewhere,
    RealReconstruction,
    testing::Values(Source{"pcl_unorganized", ".pcd", {}, 0.0, 0.75},
                    Source{"synpeb_room", ".pcd", {}, 0.0, 0.9},
                    Source{"isprs_urban_als", ".pcd", {}, 0.0, 0.9},
                    Source{"registration_pairs", ".ply", {}, 0.0, 0.9},
                    Source{"kitti_odometry/sequences/00", ".bin", {}, 0.3, 0.9},
                    Source{"kitti_odometry/sequences/01_thin3", ".bin", {}, 0.0, 0.9},
                    Source{"kitti_raw", ".bin", {}, 0.0, 0.9},
                    Source{"balm_realworld", ".bin", {}, 0.0, 0.9},
                    Source{"kitti_07_submaps", ".bin", withoutReflectance(), 0.0, 0.7}),
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
  const auto columns = nlohmann::json::parse(stream).at("extrinsic");
  Eigen::Matrix4d extrinsic;
  for (Eigen::Index column = 0; column < 4; ++column)
    for (Eigen::Index row = 0; row < 4; ++row)
      extrinsic(row, column) =
          columns.at(0).at(static_cast<std::size_t>(4 * column + row));
  const ExactMesh mesh(folder / "knot.ply", 0.01, Eigen::Affine3d(extrinsic));
  std::vector<double> distances;
  std::map<std::uint32_t, ClosestPointFinder> finders;
  const Reconstruction& result = reconstructor.getReconstruction();
  const GridPoints points = pointsOf(reconstructor);
  for (std::size_t cell = 0; cell < points.size(); cell += 37) {
    if (result.labels[cell] == 0)
      continue;
    const std::uint32_t patch = result.labels[cell] - 1;
    const auto finder =
        finders.try_emplace(patch, result.model.patches[patch].geometry.surface())
            .first;
    distances.push_back(
        mesh.distance(finder->second.find(points.point(cell).cast<double>()).point));
  }
  std::sort(distances.begin(), distances.end());
  std::printf("knot: coverage %.3f, median %.5f m, 95 %% %.5f m\n",
              share,
              distances[distances.size() / 2],
              distances[distances.size() * 95 / 100]);
  EXPECT_LE(distances[distances.size() / 2], 0.0015);
  EXPECT_LE(distances[distances.size() * 95 / 100], 0.004);
}

/** Radius of the circle through points (x, z), by linear least squares (Kasa). */
double
circleRadius(const std::vector<Eigen::Vector2d>& points)
{
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd right(rows.rows());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const Eigen::Vector2d& point = points[static_cast<std::size_t>(k)];
    rows.row(k) << 2.0 * point.x(), 2.0 * point.y(), 1.0;
    right(k) = point.squaredNorm();
  }
  const Eigen::Vector3d solution = rows.colPivHouseholderQr().solve(right);
  return std::sqrt(solution.z() + solution.head<2>().squaredNorm());
}

double
medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** The post has the same radius at every height, by the circles that its surface makes
 * with the rows of the image and by its outline, where the outermost rays touch it. */
TEST(RealReconstruction, bollardIsACylinder)
{
  PCL_NURBS_DATA_OR_SKIP(file, "redwood_bollard/01220_depth.png");
  Reconstructor reconstructor;
  EXPECT_GE(reconstructFile(file, {}, reconstructor), 0.9);
  const Reconstruction& result = reconstructor.getReconstruction();
  const std::uint32_t post = result.labels[262 * 640 + 312];
  ASSERT_NE(post, 0U);
  const NurbsSurface& surface = result.model.patches[post - 1].geometry.surface();
  std::vector<double> circles;
  std::vector<double> outlines;
  for (int row = 130; row < 380; ++row) {
    std::vector<Eigen::Vector2d> slice;
    std::vector<int> columns;
    for (int column = 0; column < 640; ++column)
      if (result.labels[static_cast<std::size_t>(row * 640 + column)] == post) {
        const Eigen::Vector3d point = surface.evaluate(column, row);
        slice.emplace_back(point.x(), point.z());
        columns.push_back(column);
      }
    ASSERT_GT(slice.size(), 20U) << row;
    circles.push_back(circleRadius(slice));
    const double slope = 0.5 * (columns.back() - columns.front() + 1) / 525.0;
    const double sine = slope / std::hypot(1.0, slope);
    outlines.push_back(slice[slice.size() / 2].y() * sine / (1.0 - sine));
  }
  const auto half = static_cast<std::ptrdiff_t>(circles.size() / 2);
  const double upper = medianOf({circles.begin(), circles.begin() + half});
  const double lower = medianOf({circles.begin() + half, circles.end()});
  const double outline = medianOf(outlines);
  std::printf("bollard: radius %.4f m above, %.4f m below, outline %.4f m\n",
              upper,
              lower,
              outline);
  EXPECT_NEAR(upper / lower, 1.0, 0.15);
  EXPECT_NEAR(medianOf(circles) / outline, 1.0, 0.15);
}

} // namespace
