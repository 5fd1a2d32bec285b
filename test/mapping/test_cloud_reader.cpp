// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Every format against what PCL's own writers and libpng wrote.

#include "cloud_files.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <gtest/gtest.h>

#include <cstring>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

void
expectEqual(const InputCloud& read, const PointCloud<PointXYZI>& truth, float tolerance)
{
  ASSERT_EQ(read.cloud->size(), truth.size());
  ASSERT_EQ(read.intensity.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_EQ(std::isnan((*read.cloud)[i].x), std::isnan(truth[i].x));
    if (!std::isnan(truth[i].x)) {
      ASSERT_LE(((*read.cloud)[i].getVector3fMap() - truth[i].getVector3fMap()).norm(),
                tolerance);
    }
    ASSERT_NEAR(read.intensity[i], truth[i].intensity, tolerance);
  }
}

TEST_F(CloudFiles, pcdOfEveryEncodingEqualsWhatPclWrote)
{
  const PointCloud<PointXYZI> truth = sampleCloud();
  PCDWriter writer;
  writer.writeASCII(path("a.pcd"), truth, 8);
  writer.writeBinary(path("b.pcd"), truth);
  writer.writeBinaryCompressed(path("c.pcd"), truth);
  for (const char* name : {"a.pcd", "b.pcd", "c.pcd"}) {
    SCOPED_TRACE(name);
    const InputCloud read = readCloud(path(name));
    EXPECT_EQ(read.cloud->width, 20U);
    EXPECT_EQ(read.cloud->height, 15U);
    EXPECT_FALSE(read.cloud->is_dense);
    EXPECT_EQ(read.kind, CloudKind::pcd);
    expectEqual(read, truth, name[0] == 'a' ? 1e-5F : 0.0F);
  }
}

TEST_F(CloudFiles, plyOfBothEncodingsEqualsWhatPclWrote)
{
  PointCloud<PointXYZI> truth = sampleCloud();
  truth[7].x = truth[7].y = truth[7].z = 0.0F; // the writer leaves out holes
  PLYWriter writer;
  writer.write(path("a.ply"), truth, false, false);
  writer.write(path("b.ply"), truth, true, false);
  for (const char* name : {"a.ply", "b.ply"}) {
    SCOPED_TRACE(name);
    expectEqual(readCloud(path(name)), truth, name[0] == 'a' ? 1e-3F : 0.0F);
  }
}

TEST_F(CloudFiles, plyBytesInReverseOrderAndColours)
{
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex 1\n"
                      "property double x\nproperty double y\nproperty double z\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "end_header\n";
  for (const double value : {1.5, -2.25, 1e-3}) {
    std::string number(8, '\0');
    std::memcpy(number.data(), &value, 8);
    bytes.append(number.rbegin(), number.rend());
  }
  bytes += "\x01\x02\x03";
  const InputCloud read = readCloud(write("x.ply", bytes));
  EXPECT_EQ((*read.cloud)[0].x, 1.5F);
  EXPECT_EQ((*read.cloud)[0].y, -2.25F);
  EXPECT_EQ((*read.cloud)[0].z, 1e-3F);
  EXPECT_EQ(read.rgb.at(0), 0x010203U);
}

TEST_F(CloudFiles, pcdColoursAreUnpacked)
{
  PointCloud<PointXYZRGB> truth(3, 1);
  for (PointXYZRGB& point : truth) {
    point.x = point.y = point.z = 1.0F;
    point.r = 200;
    point.g = 100;
    point.b = 7;
  }
  io::savePCDFileBinary(path("c.pcd"), truth);
  EXPECT_EQ(readCloud(path("c.pcd")).rgb.at(2), 200U << 16U | 100U << 8U | 7U);
}

TEST_F(CloudFiles, kittiBinWithAndWithoutReflectance)
{
  const std::vector<float> values = {1, 2, 3, 0.5, 4, 5, 6, 0.25, 7, 8, 9, 1};
  std::string bytes(values.size() * 4, '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  const std::string file = write("s.bin", bytes);
  const InputCloud four = readCloud(file);
  ASSERT_EQ(four.cloud->size(), 3U);
  EXPECT_EQ((*four.cloud)[1].y, 5.0F);
  EXPECT_EQ(four.intensity[1], 0.25F);
  CloudReadOptions options;
  options.bin_values_per_point = 3;
  const InputCloud three = readCloud(file, options);
  ASSERT_EQ(three.cloud->size(), 4U);
  EXPECT_EQ((*three.cloud)[1].x, 0.5F);
  write("t.bin", bytes.substr(0, 47));
  expectRefused(path("t.bin"));
  write("u.bin", std::string(4096, '\x7e'));
  expectRefused(path("u.bin"));
}

void
writePng(const std::string& file,
         const std::vector<std::uint16_t>& pixels,
         unsigned width,
         png_uint_32 format)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = static_cast<png_uint_32>(pixels.size()) / width;
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr),
            0);
}

TEST_F(CloudFiles, depthImageBecomesPointsOfTheCamera)
{
  writeDepth(path("d.png"), {0, 1000, 65535, 2500, 500, 8000}, 3);
  CloudReadOptions options;
  options.intrinsics = PinholeIntrinsics{100.0, 50.0, 1.0, 0.5};
  const InputCloud read = readCloud(path("d.png"), options);
  ASSERT_EQ(read.cloud->width, 3U);
  ASSERT_EQ(read.cloud->height, 2U);
  EXPECT_TRUE(std::isnan((*read.cloud)[0].z));
  EXPECT_TRUE(std::isnan((*read.cloud)[2].x));
  EXPECT_FLOAT_EQ((*read.cloud)[3].z, 2.5F);
  EXPECT_FLOAT_EQ((*read.cloud)[3].x, -1.0F / 100.0F * 2.5F);
  EXPECT_FLOAT_EQ((*read.cloud)[3].y, 0.5F / 50.0F * 2.5F);
  options.rotated_depth_bits = true;
  EXPECT_FLOAT_EQ((*readCloud(path("d.png"), options).cloud)[5].z, 1.0F);
}

TEST_F(CloudFiles, otherImagesAreRefused)
{
  writePng(path("c.png"), std::vector<std::uint16_t>(64, 0), 4, PNG_FORMAT_RGB);
  expectRefused(path("c.png"));
}

TEST_F(CloudFiles, largeCoordinatesComeWithAnOffset)
{
  const InputCloud read = readCloud(write(
      "u.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nend_header\n512345.25 5403210.5 301.125\n512355.5 5403200 "
      "300\n"));
  const Eigen::Vector3d point =
      (*read.cloud)[0].getVector3fMap().cast<double>() + read.offset;
  EXPECT_LT((point - Eigen::Vector3d(512345.25, 5403210.5, 301.125)).norm(), 1e-4);
  EXPECT_GT(read.offset.norm(), 1e6);
}

} // namespace
