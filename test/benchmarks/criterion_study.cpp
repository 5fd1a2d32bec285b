// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Which model criterion generalises on a real depth image? Windows of the image are
// fitted in inverse depth without every fourth 8 x 8-pixel block, and measured on those
// blocks: whole blocks, because the noise of neighbouring pixels is correlated and would
// leak. Usage: criterion_study CLOUD.pcd [fx fy cx cy]

#include <pcl/surface/nurbs/surface_fitter.h>

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace pcl::nurbs;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr int kWindow = 96;
constexpr int kBlock = 8;

struct Split {
  FitPoints fitted;
  FitPoints held;
};

bool
isHeld(int row, int column)
{
  return (row / kBlock) % 2 == 1 && (column / kBlock) % 2 == 1;
}

/** Neighbours are on one surface if their depths differ by little more than noise. */
bool
isSmooth(const Cloud& cloud, int column, int row)
{
  constexpr float kJump = 0.02F; // of the depth, per pixel
  const float z = cloud(column, row).z;
  const float right = cloud(column + 1, row).z;
  const float below = cloud(column, row + 1).z;
  return std::max(std::abs(right - z), std::abs(below - z)) < kJump * z;
}

/** A window's points; empty unless it is full and has no depth edge. */
Split
windowPoints(const Cloud& cloud, int left, int top)
{
  std::vector<Eigen::Vector3d> lists[2];
  int bad = 0;
  for (int row = top; row < top + kWindow; ++row)
    for (int column = left; column < left + kWindow; ++column) {
      if (!isSmooth(cloud, column, row)) {
        ++bad;
        continue;
      }
      lists[isHeld(row, column) ? 1 : 0].push_back(
          cloud(column, row).getVector3fMap().cast<double>());
    }
  Split split;
  if (bad > kWindow * kWindow / 50)
    return split;
  for (int k : {0, 1}) {
    FitPoints& points = k == 0 ? split.fitted : split.held;
    points.positions.resize(3, static_cast<Eigen::Index>(lists[k].size()));
    for (std::size_t n = 0; n < lists[k].size(); ++n)
      points.positions.col(static_cast<Eigen::Index>(n)) = lists[k][n];
    // A triangulating sensor: constant noise of disparity, so z^2 of depth.
    points.sigma = 0.0015 * points.positions.row(2).transpose().array().square();
  }
  return split;
}

struct Sums {
  double squares = 0.0;
  double points = 0.0;
  double coefficients = 0.0;
};

void
study(const std::vector<Split>& windows,
      const HeightFieldFrame& frame,
      ModelCriterion criterion,
      const char* name)
{
  for (double points_per_sample : {1.0, 16.0, 50.0, 100.0}) {
    KnotSearchOptions search;
    search.criterion = criterion;
    search.points_per_sample = points_per_sample;
    Sums sums;
    for (const Split& window : windows) {
      FitReport report;
      const auto knots = chooseHeightFieldKnots(frame, window.fitted, search, report);
      SurfaceFitOptions options;
      options.distance = FitDistance::Parametric;
      const SurfaceFit fit =
          fitHeightField(frame, knots.first, knots.second, window.fitted, options);
      Eigen::Matrix2Xd uv(2, window.held.positions.cols());
      for (Eigen::Index k = 0; k < uv.cols(); ++k)
        uv.col(k) = frame.toLocal(window.held.positions.col(k)).head<2>();
      const Eigen::VectorXd distance =
          orthogonalDistances(fit.surface, window.held.positions, uv);
      sums.squares += distance.cwiseQuotient(window.held.sigma).squaredNorm();
      sums.points += static_cast<double>(distance.size());
      sums.coefficients += fit.surface.numControlPoints();
    }
    std::printf("| %s | %g | %.4f | %.1f |\n",
                name,
                points_per_sample,
                std::sqrt(sums.squares / sums.points),
                sums.coefficients / static_cast<double>(windows.size()));
  }
}

} // namespace

int
main(int argc, char** argv)
{
  Cloud cloud;
  if (argc < 2 || pcl::io::loadPCDFile(argv[1], cloud) != 0 || !cloud.isOrganized()) {
    std::fprintf(stderr, "usage: criterion_study CLOUD.pcd [fx fy cx cy]\n");
    return 1;
  }
  double camera[4] = {525.0, 525.0, 319.5, 239.5};
  for (int k = 0; k < 4 && k + 2 < argc; ++k)
    camera[k] = std::stod(argv[k + 2]);
  const HeightFieldFrame frame =
      HeightFieldFrame::perspective(camera[0], camera[1], camera[2], camera[3]);
  std::vector<Split> windows;
  for (int top = 0; top + kWindow < static_cast<int>(cloud.height); top += kWindow / 2)
    for (int left = 0; left + kWindow < static_cast<int>(cloud.width);
         left += kWindow / 2) {
      Split split = windowPoints(cloud, left, top);
      if (split.held.positions.cols() > 0)
        windows.push_back(std::move(split));
    }
  std::printf("%zu windows\n| criterion | points per sample | held-out RMS / sigma | "
              "control points |\n| --- | --- | --- | --- |\n",
              windows.size());
  study(windows, frame, ModelCriterion::AIC, "AIC");
  study(windows, frame, ModelCriterion::AICc, "AICc");
  study(windows, frame, ModelCriterion::BIC, "BIC");
  return 0;
}
