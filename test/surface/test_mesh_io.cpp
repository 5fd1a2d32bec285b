// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/mesh_io.h>
#include <pcl/surface/nurbs/tessellation.h>

#include "closed_surfaces.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;

class MeshIo : public testing::Test {
protected:
  MeshIo()
  {
    SurfaceModel model;
    model.patches.resize(2);
    model.patches[0].geometry = TrimmedSurface(test::sphere(1.0));
    model.patches[1].geometry = TrimmedSurface(test::cylinder(0.5, 2.0));
    TessellationOptions options;
    options.chord_tolerance = 0.01;
    mesh = tessellate(model, options);
  }

  ~MeshIo() override { std::filesystem::remove(path); }

  std::string
  content() const
  {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TriangleMesh mesh;
  std::string path = testing::TempDir() + "mesh_io_test";
};

TEST_F(MeshIo, objReadsBack)
{
  writeObjMesh(path, mesh);
  std::istringstream stream(content());
  std::string line;
  std::size_t vertices = 0, normals = 0, parameters = 0, faces = 0;
  std::vector<std::string> groups;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string kind;
    Eigen::Vector3d value;
    words >> kind;
    if (kind == "v") {
      words >> value.x() >> value.y() >> value.z();
      EXPECT_LT((value - mesh.vertices[vertices++]).norm(), 1e-8);
    }
    else if (kind == "vn") {
      words >> value.x() >> value.y() >> value.z();
      EXPECT_LT((value - mesh.normals[normals++]).norm(), 1e-5);
    }
    else if (kind == "vt") {
      words >> value.x() >> value.y();
      EXPECT_LT((value.head<2>() - mesh.parameters[parameters++]).norm(), 1e-8);
    }
    else if (kind == "g") {
      words >> kind;
      groups.push_back(kind);
    }
    else if (kind == "f") {
      for (const std::uint32_t vertex : mesh.triangles[faces]) {
        words >> kind;
        const std::string n = std::to_string(vertex + 1);
        EXPECT_EQ(kind, n + "/" + n + "/" + n);
      }
      ++faces;
    }
    else {
      ADD_FAILURE() << line;
    }
  }
  EXPECT_EQ(vertices, mesh.vertices.size());
  EXPECT_EQ(normals, mesh.vertices.size());
  EXPECT_EQ(parameters, mesh.vertices.size());
  EXPECT_EQ(faces, mesh.triangles.size());
  EXPECT_EQ(groups, (std::vector<std::string>{"patch_0", "patch_1"}));
}

TEST_F(MeshIo, objGroupsInterleavedPatches)
{
  std::swap(mesh.triangles.front(), mesh.triangles.back());
  writeObjMesh(path, mesh);
  const std::string text = content();
  EXPECT_EQ(text.find("g patch_0"), text.rfind("g patch_0"));
  EXPECT_EQ(text.find("g patch_1"), text.rfind("g patch_1"));
}

TEST_F(MeshIo, plyHasTheDeclaredLayout)
{
  writePlyMesh(path, mesh);
  const std::string bytes = content();
  const std::string end = "end_header\n";
  const std::size_t start = bytes.find(end) + end.size();
  const std::string header = bytes.substr(0, start);
  EXPECT_NE(header.find("format binary_little_endian 1.0\n"), std::string::npos);
  EXPECT_NE(header.find("element vertex " + std::to_string(mesh.vertices.size())),
            std::string::npos);
  EXPECT_NE(header.find("element face " + std::to_string(mesh.triangles.size())),
            std::string::npos);
  ASSERT_EQ(bytes.size() - start,
            28 * mesh.vertices.size() + 13 * mesh.triangles.size());
  const char* at = bytes.data() + start;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i, at += 28) {
    float values[6];
    std::uint32_t patch = 0;
    std::memcpy(values, at, sizeof(values));
    std::memcpy(&patch, at + 24, sizeof(patch));
    EXPECT_EQ(patch, mesh.patch[i]);
    for (int d = 0; d < 3; ++d) {
      EXPECT_FLOAT_EQ(values[d], static_cast<float>(mesh.vertices[i](d)));
      EXPECT_FLOAT_EQ(values[3 + d], static_cast<float>(mesh.normals[i](d)));
    }
  }
  for (const auto& triangle : mesh.triangles) {
    EXPECT_EQ(*at++, 3);
    EXPECT_EQ(std::memcmp(at, triangle.data(), 12), 0);
    at += 12;
  }
}

TEST_F(MeshIo, emptyMeshIsAValidFile)
{
  writeObjMesh(path, TriangleMesh());
  EXPECT_EQ(content(), "");
  writePlyMesh(path, TriangleMesh());
  EXPECT_NE(content().find("element vertex 0\n"), std::string::npos);
}

TEST_F(MeshIo, rejectsBrokenMeshesAndPaths)
{
  TriangleMesh broken = mesh;
  broken.normals.pop_back();
  EXPECT_THROW(writeObjMesh(path, broken), std::invalid_argument);
  EXPECT_THROW(writePlyMesh(path, broken), std::invalid_argument);
  broken = mesh;
  broken.triangles[3][1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_THROW(writeObjMesh(path, broken), std::invalid_argument);
  EXPECT_THROW(writePlyMesh(path, broken), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THROW(writeObjMesh("/no/such/folder/mesh.obj", mesh), std::runtime_error);
  EXPECT_THROW(writePlyMesh("/dev/full", mesh), std::runtime_error);
}

} // namespace
