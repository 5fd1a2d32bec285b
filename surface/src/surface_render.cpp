// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/surface_render.h>

#include <pcl/surface/nurbs/tessellation.h>

#include "rasterizer.h"
#include "render_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr float kBorderBias = 2e-3F; // of the depth: lines win against their surface
constexpr float kPointBias = 1e-2F;  // points scatter on both sides of it

/** Colours of all vertices before lighting. */
std::vector<Eigen::Vector3f>
baseColours(const TriangleMesh& mesh,
            Colouring colouring,
            const std::vector<double>& scalars,
            const ColourScale& scale)
{
  std::vector<Eigen::Vector3f> colours(mesh.vertices.size());
  for (std::size_t i = 0; i < colours.size(); ++i)
    switch (colouring) {
    case Colouring::Patch:
      colours[i] = patchColour(mesh.patch[i]);
      break;
    case Colouring::Normal:
      colours[i] = 127.5F * (mesh.normals[i].cast<float>().array() + 1.0F);
      break;
    case Colouring::Curvature:
    case Colouring::Scalar:
      colours[i] = scale.colour(scalars[i]);
      break;
    }
  return colours;
}

/** Vertices in camera axes, lit by a head light and ambient light from both sides. */
std::vector<ShadedVertex>
shaded(const TriangleMesh& mesh,
       const std::vector<Eigen::Vector3f>& colours,
       const Eigen::Isometry3d& to_camera)
{
  constexpr float kAmbient = 0.35F;
  std::vector<ShadedVertex> result(mesh.vertices.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Eigen::Vector3d position = to_camera * mesh.vertices[i];
    const Eigen::Vector3d normal = to_camera.linear() * mesh.normals[i];
    // The lamp stands a little above and to the left of the eye.
    const Eigen::Vector3d lamp(-0.25, -0.35, 0.0);
    const Eigen::Vector3d towards = (position.norm() * lamp - position).normalized();
    const float light =
        kAmbient +
        (1.0F - kAmbient) * static_cast<float>(std::abs(normal.dot(towards)));
    result[i] = {position.cast<float>(), light * colours[i]};
  }
  return result;
}

/** Edges with one triangle: borders of patches, as patches share no vertices. */
std::vector<std::array<std::uint32_t, 2>>
borderEdges(const TriangleMesh& mesh)
{
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::uint32_t, 2>> single;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1] != edges[i]) &&
        (i + 1 == edges.size() || edges[i + 1] != edges[i]))
      single.push_back(edges[i]);
  return single;
}

void
drawOverlay(const PointOverlay& overlay,
            const Eigen::Isometry3d& to_camera,
            Rasterizer& raster)
{
  const Eigen::Isometry3f transform = to_camera.cast<float>();
  for (std::size_t i = 0; i < overlay.size; ++i) {
    if (!overlay.points[i].allFinite())
      continue;
    Eigen::Vector3f colour(0.0F, 0.0F, 0.0F);
    if (overlay.colours != nullptr)
      for (int c = 0; c < 3; ++c)
        colour(c) = overlay.colours[i][static_cast<std::size_t>(c)];
    raster.drawDot(transform * overlay.points[i], colour, kPointBias);
  }
}

Camera
chosenCamera(const TriangleMesh& mesh,
             const RenderOptions& options,
             const PointOverlay& overlay)
{
  if (options.camera)
    return *options.camera;
  std::vector<Eigen::Vector3d> points = mesh.vertices;
  for (std::size_t i = 0; i < overlay.size && mesh.vertices.empty(); ++i)
    if (overlay.points[i].allFinite())
      points.push_back(overlay.points[i].cast<double>());
  if (points.empty())
    return {};
  return Camera::fitted(points,
                        Eigen::Vector3d(0.55, 0.7, -0.45),
                        Eigen::Vector3d::UnitZ(),
                        static_cast<double>(options.width) / options.height);
}

void
check(const TriangleMesh& mesh,
      const RenderOptions& options,
      const std::vector<double>& scalars)
{
  const std::size_t n = mesh.vertices.size();
  if (mesh.normals.size() != n || mesh.patch.size() != n)
    throw std::invalid_argument("render: one normal and patch per vertex is needed");
  const bool needs_scalars = options.colouring == Colouring::Scalar ||
                             options.colouring == Colouring::Curvature;
  if (needs_scalars && scalars.size() != n)
    throw std::invalid_argument("render: one scalar per vertex is needed");
  if (options.width < 1 || options.height < 1)
    throw std::invalid_argument("render: the picture has no pixels");
}

/** Mean curvature, from the fundamental forms. */
double
meanCurvature(const NurbsSurface& surface, const Eigen::Vector2d& uv)
{
  const SurfaceJet2 s = surface.evaluateJet2(uv.x(), uv.y());
  const Eigen::Vector3d cross = s.du.cross(s.dv);
  const double area = cross.norm();
  // At a pole one derivative is rounding noise whose direction means nothing.
  if (!(area > 1e-9 * (s.du.squaredNorm() + s.dv.squaredNorm())))
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d normal = cross / area;
  const double numerator = s.du.dot(s.du) * s.dvv.dot(normal) -
                           2.0 * s.du.dot(s.dv) * s.duv.dot(normal) +
                           s.dv.dot(s.dv) * s.duu.dot(normal);
  return 0.5 * numerator / (area * area);
}

double
sizeOf(const SurfaceModel& model)
{
  Eigen::AlignedBox3d box;
  for (const SurfacePatch& patch : model.patches) {
    const NurbsSurface& surface = patch.geometry.surface();
    for (Eigen::Index i = 0; i < surface.numControlPoints(); ++i)
      box.extend(Eigen::Vector3d(surface.homogeneousPoints().col(i).hnormalized()));
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

} // namespace

Camera
Camera::fitted(const std::vector<Eigen::Vector3d>& points,
               const Eigen::Vector3d& direction,
               const Eigen::Vector3d& up,
               double aspect)
{
  constexpr double kMargin = 1.05;
  Camera camera;
  camera.up = up;
  camera.eye.setZero();
  camera.target = direction;
  const Eigen::Isometry3d turn = cameraTransform(camera);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
    box.extend(Eigen::Vector3d(turn * point));
  if (box.isEmpty())
    return camera;
  const double tan_y = std::tan(0.5 * camera.vertical_fov) / kMargin;
  const double tan_x = tan_y * aspect;
  const Eigen::Vector3d middle = box.center();
  double distance = 1e-3;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d arm = turn * point - middle;
    distance = std::max({distance,
                         std::abs(arm.x()) / tan_x - arm.z(),
                         std::abs(arm.y()) / tan_y - arm.z()});
  }
  camera.target = turn.inverse() * middle;
  camera.eye = camera.target - distance * direction.normalized();
  return camera;
}

Image
renderMesh(const TriangleMesh& mesh,
           const RenderOptions& options,
           const std::vector<double>& scalars,
           const PointOverlay& overlay)
{
  check(mesh, options, scalars);
  const Camera camera = chosenCamera(mesh, options, overlay);
  const Eigen::Isometry3d to_camera = cameraTransform(camera);
  Rasterizer raster(
      options.width, options.height, camera.vertical_fov, options.background);
  const ColourScale scale(scalars, options.range);
  const std::vector<ShadedVertex> vertices =
      shaded(mesh, baseColours(mesh, options.colouring, scalars, scale), to_camera);
  for (const auto& t : mesh.triangles)
    raster.drawTriangle(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  if (options.borders)
    for (const auto& edge : borderEdges(mesh))
      raster.drawLine(vertices[edge[0]].position,
                      vertices[edge[1]].position,
                      Eigen::Vector3f(35.0F, 35.0F, 40.0F),
                      kBorderBias);
  drawOverlay(overlay, to_camera, raster);
  Image image = raster.resolve();
  if (!scalars.empty())
    scale.drawBar(image);
  return image;
}

Image
renderModel(const SurfaceModel& model,
            const RenderOptions& options,
            const PointOverlay& overlay)
{
  constexpr double kToleranceOfSize = 1.0 / 4000.0;
  TessellationOptions fineness;
  if (options.chord_tolerance != 0.0)
    fineness.chord_tolerance = options.chord_tolerance;
  else if (const double size = sizeOf(model); size > 0.0)
    fineness.chord_tolerance = kToleranceOfSize * size;
  const TriangleMesh mesh = tessellate(model, fineness);
  std::vector<double> curvature;
  if (options.colouring == Colouring::Curvature)
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      curvature.push_back(meanCurvature(model.patches[mesh.patch[i]].geometry.surface(),
                                        mesh.parameters[i]));
  return renderMesh(mesh, options, curvature, overlay);
}

} // namespace nurbs
} // namespace pcl
