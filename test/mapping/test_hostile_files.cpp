// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Damaged files of every kind: one clear error, never a crash or a large allocation.

#include "cloud_files.h"

#include <pcl/io/pcd_io.h>

#include <utility>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

TEST_F(CloudFiles, nonsenseOptionsAreRefused)
{
  CloudReadOptions options;
  options.bin_values_per_point = 5;
  EXPECT_THROW(readCloud("x.bin", options), std::invalid_argument);
  options = {};
  options.depth_scale = 0.0;
  EXPECT_THROW(readCloud("x.png", options), std::invalid_argument);
  options = {};
  options.intrinsics = PinholeIntrinsics{0.0, 1.0, 0.0, 0.0};
  EXPECT_THROW(readCloud("x.png", options), std::invalid_argument);
}

TEST_F(CloudFiles, filesThatAreNoneAreNamed)
{
  expectRefused(path("missing.pcd"));
  expectRefused(folder.string());
  expectRefused(write("empty.pcd", ""));
  expectRefused(write("text.xyz", "1 2 3\n"));
  expectRefused(write("noise.pcd", std::string(300000, '\x01')));
  expectRefused(write("noise.ply", std::string(3000, '\xff')));
  expectRefused(write("noise.png", std::string(3000, '\xff')));
  expectRefused(write("other.bin", "ply\nformat ascii 1.0\n"));
  expectRefused(write("other.ply", "# .PCD v0.7\n"));
  CloudReadOptions options;
  options.max_file_size = 10;
  expectRefused(write("large.bin", std::string(64, '\0')), options);
}

TEST_F(CloudFiles, wrongPcdHeadersAreRefused)
{
  const std::string good =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  EXPECT_EQ(readCloud(write("good.pcd", good)).cloud->size(), 2U);
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"WIDTH 2", "WIDTH 3"},
      {"WIDTH 2", "WIDTH 4294967295"},
      {"WIDTH 2", "WIDTH 99999999999999999999"},
      {"WIDTH 2", "WIDTH -2"},
      {"WIDTH 2", "WIDTH"},
      {"HEIGHT 1", "HEIGHT 0"},
      {"POINTS 2", "POINTS 7"},
      {"FIELDS x y z", "FIELDS x y w"},
      {"FIELDS x y z", "FIELDS x y"},
      {"SIZE 4 4 4", "SIZE 4 4 3"},
      {"SIZE 4 4 4", "SIZE 4 4 0"},
      {"TYPE F F F", "TYPE F F Q"},
      {"COUNT 1 1 1", "COUNT 1 1 0"},
      {"COUNT 1 1 1", "COUNT 1 1 4000000000"},
      {"DATA ascii", "DATA binary"},
      {"DATA ascii", "DATA binary_compressed"},
      {"DATA ascii", "DATA morse"},
      {"1 2 3", "1 2 x"},
      {"4 5 6", "4 5"}};
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    std::string bad = good;
    bad.replace(bad.find(from), from.size(), to);
    expectRefused(write("bad.pcd", bad));
  }
}

TEST_F(CloudFiles, wrongPlyHeadersAreRefused)
{
  const std::string good =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n";
  EXPECT_EQ(readCloud(write("good.ply", good)).cloud->size(), 2U);
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"vertex 2", "vertex 3"},
      {"vertex 2", "vertex 4294967295"},
      {"vertex 2", "vertex 0"},
      {"vertex 2", "vertex two"},
      {"element vertex", "element face"},
      {"property float z", "property float w"},
      {"property float z", "property list uchar int z"},
      {"property float z", "property"},
      {"format ascii", "format binary_little_endian"},
      {"format ascii", "format baudot"},
      {"end_header", "end_heder"}};
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    std::string bad = good;
    bad.replace(bad.find(from), from.size(), to);
    expectRefused(write("bad.ply", bad));
  }
}

TEST_F(CloudFiles, truncationAndDamageNeverCrash)
{
  const PointCloud<PointXYZI> truth = sampleCloud();
  PCDWriter writer;
  writer.writeASCII(path("a.pcd"), truth, 8);
  writer.writeBinary(path("b.pcd"), truth);
  writer.writeBinaryCompressed(path("c.pcd"), truth);
  write("d.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 200\nproperty float x\n"
        "property float y\nproperty double z\nend_header\n" +
            std::string(200 * 16, '\x11'));
  writeDepth(path("e.png"), std::vector<std::uint16_t>(4800, 1234), 80);
  std::mt19937 random(3);
  for (const std::string name : {"a.pcd", "b.pcd", "c.pcd", "d.ply", "e.png"}) {
    SCOPED_TRACE(name);
    const std::string whole = bytesOf(path(name));
    const std::size_t step = std::max<std::size_t>(1, whole.size() / 150);
    // The last few bytes may be the end of a number or of a checksum.
    for (std::size_t size = 0; size + 24 < whole.size(); size += step)
      expectRefused(write("cut_" + name, whole.substr(0, size)));
    for (int n = 0; n < 300; ++n) {
      std::string damaged = whole;
      for (int k = 0; k < 3; ++k)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      expectSafe(write("bad_" + name, damaged));
    }
  }
}

} // namespace
