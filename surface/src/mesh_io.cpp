// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/mesh_io.h>

#include <pcl/surface/nurbs/atomic_file.h>

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

void
check(const TriangleMesh& mesh)
{
  const std::size_t n = mesh.vertices.size();
  if (mesh.normals.size() != n || mesh.parameters.size() != n || mesh.patch.size() != n)
    throw std::invalid_argument("TriangleMesh: one normal, parameter and patch per "
                                "vertex is needed");
  for (const auto& triangle : mesh.triangles)
    if (*std::max_element(triangle.begin(), triangle.end()) >= n)
      throw std::invalid_argument("TriangleMesh: a triangle names a missing vertex");
}

template <typename... Values>
void
print(AtomicFile& file, const char* format, Values... values)
{
  char line[160];
  const int length = std::snprintf(line, sizeof(line), format, values...);
  file.write(line, static_cast<std::size_t>(length));
}

/** Collects little-endian values and hands them over in large pieces. */
class BinaryWriter {
public:
  explicit BinaryWriter(AtomicFile& file) : file_(file) {}

  template <typename Value>
  void
  put(Value value)
  {
    if constexpr (sizeof(Value) > 1) {
      std::uint32_t bits = 0;
      static_assert(sizeof(Value) == sizeof(bits));
      std::memcpy(&bits, &value, sizeof(bits));
      boost::endian::native_to_little_inplace(bits);
      file_.write(&bits, sizeof(bits));
    }
    else {
      file_.write(&value, 1);
    }
  }

  void
  put(const Eigen::Vector3d& vector)
  {
    for (int d = 0; d < 3; ++d)
      put(static_cast<float>(vector(d)));
  }

private:
  AtomicFile& file_;
};

} // namespace

void
writeObjMesh(const std::string& path, const TriangleMesh& mesh)
{
  check(mesh);
  AtomicFile file(path);
  for (const Eigen::Vector3d& p : mesh.vertices)
    print(file, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
  for (const Eigen::Vector2d& uv : mesh.parameters)
    print(file, "vt %.9g %.9g\n", uv.x(), uv.y());
  for (const Eigen::Vector3d& n : mesh.normals)
    print(file, "vn %.6g %.6g %.6g\n", n.x(), n.y(), n.z());
  const auto patchOf = [&](std::size_t triangle) {
    return mesh.patch[mesh.triangles[triangle][0]];
  };
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return patchOf(a) < patchOf(b);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || patchOf(order[k]) != patchOf(order[k - 1]))
      print(file, "g patch_%u\n", patchOf(order[k]));
    const auto& t = mesh.triangles[order[k]];
    const unsigned a = t[0] + 1;
    const unsigned b = t[1] + 1;
    const unsigned c = t[2] + 1;
    print(file, "f %u/%u/%u %u/%u/%u %u/%u/%u\n", a, a, a, b, b, b, c, c, c);
  }
  file.commit();
}

void
writePlyMesh(const std::string& path, const TriangleMesh& mesh)
{
  check(mesh);
  AtomicFile file(path);
  file.write("ply\nformat binary_little_endian 1.0\n");
  print(file, "element vertex %zu\n", mesh.vertices.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    print(file, "property float %s\n", name);
  file.write("property uint patch\n");
  print(file, "element face %zu\n", mesh.triangles.size());
  file.write("property list uchar int vertex_indices\nend_header\n");
  BinaryWriter writer(file);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    writer.put(mesh.vertices[i]);
    writer.put(mesh.normals[i]);
    writer.put(mesh.patch[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    writer.put(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle)
      writer.put(vertex);
  }
  file.commit();
}

} // namespace nurbs
} // namespace pcl
