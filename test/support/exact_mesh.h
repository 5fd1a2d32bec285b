// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Distance of a point from a triangle: from its plane where the foot is inside, else
 * from the nearest edge. */
inline double
triangleDistance(const Eigen::Vector3d& point,
                 const std::array<Eigen::Vector3d, 3>& corners)
{
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  double nearest = std::numeric_limits<double>::max();
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& from = corners[k];
    const Eigen::Vector3d edge = corners[(k + 1) % 3] - from;
    const Eigen::Vector3d offset = point - from;
    inside = inside && normal.dot(edge.cross(offset)) >= 0.0;
    const double along = std::clamp(offset.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (offset - along * edge).norm());
  }
  return inside ? std::abs(normal.dot(point - corners[0])) : nearest;
}

/** A triangle mesh from a binary PLY file with float vertices and nothing else in them;
 * distances by brute force. */
class ExactMesh {
public:
  ExactMesh(const std::filesystem::path& file,
            double scale,
            const Eigen::Affine3d& to_camera)
  {
    std::ifstream stream(file, std::ios::binary);
    std::size_t vertices = 0;
    std::size_t faces = 0;
    for (std::string line; std::getline(stream, line) && line != "end_header";) {
      const std::string number = line.substr(line.rfind(' ') + 1);
      if (line.rfind("element vertex", 0) == 0)
        vertices = std::stoul(number);
      if (line.rfind("element face", 0) == 0)
        faces = std::stoul(number);
    }
    std::vector<Eigen::Vector3d> points;
    for (std::size_t k = 0; k < vertices; ++k) {
      Eigen::Vector3f point;
      stream.read(reinterpret_cast<char*>(point.data()), 12);
      points.push_back(to_camera * (scale * point.cast<double>()));
    }
    for (std::size_t k = 0; k < faces; ++k) {
      std::uint8_t corners = 0;
      std::array<std::int32_t, 3> index{};
      stream.read(reinterpret_cast<char*>(&corners), 1);
      stream.read(reinterpret_cast<char*>(index.data()), sizeof(index));
      if (!stream || corners != 3)
        throw std::runtime_error("no triangle mesh: " + file.string());
      triangles_.push_back({points.at(static_cast<std::size_t>(index[0])),
                            points.at(static_cast<std::size_t>(index[1])),
                            points.at(static_cast<std::size_t>(index[2]))});
    }
  }

  double
  distance(const Eigen::Vector3d& point) const
  {
    double nearest = std::numeric_limits<double>::max();
    for (const std::array<Eigen::Vector3d, 3>& triangle : triangles_)
      nearest = std::min(nearest, triangleDistance(point, triangle));
    return nearest;
  }

private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
};

} // namespace test
} // namespace nurbs
} // namespace pcl
