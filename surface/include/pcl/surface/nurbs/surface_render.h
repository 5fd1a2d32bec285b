// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>
#include <pcl/surface/nurbs/triangle_mesh.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Red, green, blue. */
using Rgb = std::array<std::uint8_t, 3>;

/** \brief Picture, rows from the top, pixels from the left. */
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;

  const Rgb&
  at(int x, int y) const
  {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/** \brief Perspective camera. Lengths in metres, angles in radians. */
struct PCL_NURBS_SURFACE_EXPORT Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  double vertical_fov = 0.857; /**< full angle; that of a Kinect */

  /** \brief Depth camera's own view: at the origin, looking along +z, y down. */
  static Camera
  sensor(double vertical_fov = 0.857)
  {
    Camera camera;
    camera.vertical_fov = vertical_fov;
    return camera;
  }

  /** \brief The nearest camera that sees all points.
   * \param[in] points what to see
   * \param[in] direction where it looks
   * \param[in] up upwards in the picture, not parallel to \a direction
   * \param[in] aspect width / height of the picture
   * \throws std::invalid_argument if the directions are parallel or zero */
  static Camera
  fitted(const std::vector<Eigen::Vector3d>& points,
         const Eigen::Vector3d& direction,
         const Eigen::Vector3d& up,
         double aspect);
};

/** \brief What the colour of a surface means. */
enum class Colouring {
  Patch,     /**< a colour for each patch */
  Normal,    /**< x, y, z of the normal as red, green, blue */
  Curvature, /**< mean curvature, blue negative, red positive, with a colour bar */
  Scalar     /**< given value per vertex, with a colour bar */
};

/** \brief How a model is drawn. */
struct RenderOptions {
  int width = 800;
  int height = 600;
  Colouring colouring = Colouring::Patch;
  /** Without a camera one is chosen that sees all from obliquely above (z is up). */
  std::optional<Camera> camera;
  /** Range of the colour bar; chosen from the values (2nd to 98th percentile) if not
   * given. */
  std::optional<std::pair<double, double>> range;
  bool borders = true; /**< dark lines along the borders of patches */
  Rgb background = {250, 250, 250};
  /** Chord tolerance of the tessellation of models, 0: 1/4000 of the model's size. */
  double chord_tolerance = 0.0;
};

/** \brief Points drawn over the surfaces, hidden behind those they are clearly behind.
 */
struct PointOverlay {
  const Eigen::Vector3f* points = nullptr; /**< points that are not finite are left out */
  std::size_t size = 0;
  const Rgb* colours = nullptr; /**< one per point, or none: black */
};

/** \brief Draw a mesh: z-buffer, head light and ambient light, both sides lit, 2 x 2
 * samples per pixel.
 * \param[in] mesh as tessellate() makes it
 * \param[in] options camera and colours; Curvature is for models only
 * \param[in] scalars one value per vertex for Colouring::Scalar, else empty; vertices
 *            whose value is not finite are grey
 * \param[in] overlay points to draw over it
 * \throws std::invalid_argument if sizes do not match or the picture has none
 * Cost: linear in triangles and covered pixels, about 50 ms for 800 x 600.
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT Image
renderMesh(const TriangleMesh& mesh,
           const RenderOptions& options,
           const std::vector<double>& scalars = {},
           const PointOverlay& overlay = {});

/** \brief Draw a model by its tessellation; every Colouring but Scalar.
 * \throws std::invalid_argument like renderMesh()
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT Image
renderModel(const SurfaceModel& model,
            const RenderOptions& options,
            const PointOverlay& overlay = {});

/** \brief Write a picture as PNG; the file appears only when it is complete.
 * \throws std::invalid_argument for an empty picture
 * \throws std::runtime_error "cannot write PATH: reason"
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT void
writePng(const std::string& path, const Image& image);

} // namespace nurbs
} // namespace pcl
