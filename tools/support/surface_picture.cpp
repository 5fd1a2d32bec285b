// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_picture.h"

#include "run_tool.h"

#include <pcl/mapping/reconstruction_statistics.h>
#include <pcl/surface/nurbs/surface_render.h>
#include <pcl/surface/nurbs/tessellation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace pcl_nurbs_tools {
namespace {

using pcl::GridProjection;
using pcl::nurbs::Camera;
using pcl::nurbs::Colouring;

const std::map<std::string, Colouring>&
shades()
{
  static const std::map<std::string, Colouring> result{
      {"patch", Colouring::Patch},
      {"normal", Colouring::Normal},
      {"curvature", Colouring::Curvature},
      {"deviation", Colouring::Scalar}};
  return result;
}

/** Eye and target as "x,y,z,x,y,z"; empty if it is anything else. */
std::vector<double>
parseView(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    std::istringstream number(part);
    double value = 0.0;
    if (!(number >> value) || !number.eof() || !std::isfinite(value))
      return {};
    numbers.push_back(value);
  }
  return numbers.size() == 6 ? numbers : std::vector<double>();
}

std::vector<Eigen::Vector3d>
labelledPoints(const pcl::nurbs::GridPoints& points,
               const pcl::nurbs::Reconstruction& reconstruction)
{
  std::vector<Eigen::Vector3d> result;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (reconstruction.labels[cell] != 0)
      result.emplace_back(points.point(cell).cast<double>());
  return result;
}

/** The view of a depth image's camera, turned to the middle of the image, which need
 * not be on the optical axis, and wide enough for its corners. */
Camera
imageCamera(const pcl::GridGeometry& grid, double aspect)
{
  Camera camera;
  camera.target = grid.direction(0.5 * (grid.width - 1), 0.5 * (grid.height - 1));
  camera.up = -grid.frame.row(1).transpose();
  const Eigen::Vector3d right = camera.target.cross(camera.up).normalized();
  const Eigen::Vector3d up = right.cross(camera.target);
  double tangent = 0.0;
  for (const double column : {-0.5, grid.width - 0.5})
    for (const double row : {-0.5, grid.height - 0.5}) {
      const Eigen::Vector3d ray = grid.direction(column, row);
      const double along = ray.dot(camera.target);
      tangent = std::max({tangent,
                          std::abs(ray.dot(up)) / along,
                          std::abs(ray.dot(right)) / along / aspect});
    }
  camera.vertical_fov = 2.0 * std::atan(tangent);
  return camera;
}

/** The view of the sensor itself for cameras, else from obliquely above. */
Camera
chooseCamera(const pcl::nurbs::GridPoints& points,
             const pcl::nurbs::Reconstruction& reconstruction,
             const PictureOptions& options)
{
  const Eigen::Matrix3d axes = points.geometry.frame; // rows right, down, forward
  const double aspect = static_cast<double>(options.width) / options.height;
  const std::vector<double> numbers = parseView(options.view);
  if (!numbers.empty()) {
    Camera camera;
    camera.eye = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
    camera.target = Eigen::Vector3d(numbers[3], numbers[4], numbers[5]);
    camera.up = -axes.row(1).transpose();
    return camera;
  }
  const bool camera_cloud = points.geometry.projection == GridProjection::perspective;
  if (options.view == "sensor" || (options.view == "auto" && camera_cloud)) {
    if (camera_cloud)
      return imageCamera(points.geometry, aspect);
    Camera camera;
    camera.target = axes.row(2).transpose();
    camera.up = -axes.row(1).transpose();
    return camera;
  }
  const bool map = points.geometry.projection == GridProjection::plane;
  // Seen from above, a map's forward axis points at the viewer.
  const double sign = map ? 1.0 : -1.0;
  const Eigen::Vector3d up = sign * axes.row(map ? 2 : 1);
  const Eigen::Vector3d forward = -sign * axes.row(map ? 1 : 2);
  const Eigen::Vector3d right = axes.row(0);
  return Camera::fitted(labelledPoints(points, reconstruction),
                        forward - 0.45 * right - 0.7 * up,
                        up,
                        aspect);
}

/** Triangles of one surface with an edge limit, which is raised where the surface
 * cannot keep it because it runs far away outside of its trims. */
pcl::nurbs::TriangleMesh
fineMesh(const pcl::nurbs::TrimmedSurface& surface,
         pcl::nurbs::TessellationOptions options,
         double longest)
{
  while (true) {
    try {
      return pcl::nurbs::tessellate(surface, options);
    } catch (const std::domain_error&) {
      if (options.max_edge_length > longest)
        throw;
      options.max_edge_length *= 2.0;
    }
  }
}

/** Append the triangles of a patch. */
void
append(const pcl::nurbs::TriangleMesh& part,
       std::uint32_t patch,
       pcl::nurbs::TriangleMesh& mesh)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto add = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(part.vertices, mesh.vertices);
  add(part.normals, mesh.normals);
  add(part.parameters, mesh.parameters);
  mesh.patch.resize(mesh.vertices.size(), patch);
  for (const auto& [a, b, c] : part.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/** Draw with each vertex coloured by the distance of the point next to it. */
pcl::nurbs::Image
drawDeviation(const pcl::nurbs::GridPoints& points,
              const pcl::nurbs::Reconstruction& reconstruction,
              const pcl::nurbs::RenderOptions& render,
              const pcl::nurbs::PointOverlay& overlay)
{
  constexpr double kEdgesAcross = 200.0;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : labelledPoints(points, reconstruction))
    box.extend(point);
  const double size = box.diagonal().norm();
  pcl::nurbs::TessellationOptions tessellation;
  tessellation.chord_tolerance = size / 4000.0;
  tessellation.max_edge_length = size / kEdgesAcross;
  pcl::nurbs::TriangleMesh mesh;
  for (std::size_t k = 0; k < reconstruction.model.patches.size(); ++k)
    append(fineMesh(reconstruction.model.patches[k].geometry, tessellation, size),
           static_cast<std::uint32_t>(k),
           mesh);
  return pcl::nurbs::renderMesh(
      mesh,
      render,
      pcl::nurbs::nearestDistances(
          points, reconstruction, mesh.vertices, tessellation.max_edge_length),
      overlay);
}

} // namespace

void
PictureOptions::validate() const
{
  constexpr int kLargest = 16384;
  if (shades().count(shade) == 0)
    throw ToolError(kUsage, "--shade must be patch, normal, curvature or deviation");
  if (view != "auto" && view != "sensor" && view != "oblique" &&
      parseView(view).empty())
    throw ToolError(
        kUsage,
        "--view must be auto, sensor, oblique or eye and target as x,y,z,x,y,z");
  if (width < 16 || height < 16 || width > kLargest || height > kLargest)
    throw ToolError(kUsage, "--size must be 16x16 to 16384x16384");
}

void
writePicture(const std::string& path,
             const pcl::nurbs::GridPoints& points,
             const pcl::nurbs::Reconstruction& reconstruction,
             const PictureOptions& options)
{
  pcl::nurbs::RenderOptions render;
  render.width = options.width;
  render.height = options.height;
  render.colouring = shades().at(options.shade);
  render.camera = chooseCamera(points, reconstruction, options);
  std::vector<Eigen::Vector3f> dots;
  if (options.points)
    for (std::size_t cell = 0; cell < points.size(); ++cell)
      dots.push_back(points.point(cell));
  pcl::nurbs::PointOverlay overlay;
  overlay.points = dots.data();
  overlay.size = dots.size();
  const pcl::nurbs::Image image =
      render.colouring == Colouring::Scalar
          ? drawDeviation(points, reconstruction, render, overlay)
          : pcl::nurbs::renderModel(reconstruction.model, render, overlay);
  try {
    pcl::nurbs::writePng(path, image);
  } catch (const std::runtime_error& error) {
    throw ToolError(kCannotWrite, error.what());
  }
}

} // namespace pcl_nurbs_tools
