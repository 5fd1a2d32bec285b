// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Every format against PCL's own writers, and damaged files of every kind: one clear
// error, never a crash or a large allocation.

#include <pcl/mapping/cloud_reader.h>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;

class CloudFiles : public testing::Test {
protected:
  void
  SetUp() override
  {
    folder = std::filesystem::temp_directory_path() /
             ("cloud_files_" + std::to_string(std::random_device()()));
    std::filesystem::create_directories(folder);
  }

  void
  TearDown() override
  {
    std::filesystem::remove_all(folder);
  }

  std::string
  path(const std::string& name) const
  {
    return (folder / name).string();
  }

  std::string
  write(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  static std::string
  bytesOf(const std::string& file)
  {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /** The file must be refused, in one line that names it. */
  static void
  expectRefused(const std::string& file, const CloudReadOptions& options = {})
  {
    try {
      readCloud(file, options);
      ADD_FAILURE() << file << " was accepted";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(file + ": ", 0), 0U) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_GT(message.size(), file.size() + 8);
    }
  }

  /** As above, or accepted: what damage to a value may do. */
  static void
  expectSafe(const std::string& file)
  {
    try {
      readCloud(file);
    } catch (const InputError&) {
    }
  }

  std::filesystem::path folder;
};

PointCloud<PointXYZI>
sampleCloud()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(-10.0F, 10.0F);
  PointCloud<PointXYZI> cloud(20, 15);
  for (PointXYZI& point : cloud) {
    point.getVector3fMap() =
        Eigen::Vector3f(value(random), value(random), value(random));
    point.intensity = value(random);
  }
  cloud[7].x = cloud[7].y = cloud[7].z = std::nanf("");
  cloud.is_dense = false;
  return cloud;
}

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
  const PointCloud<PointXYZI> truth = sampleCloud();
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

/** 16-bit grey by libpng's low-level interface; its simple one would apply gamma. */
void
writeDepth(const std::string& file,
           const std::vector<std::uint16_t>& pixels,
           unsigned width)
{
  FILE* stream = std::fopen(file.c_str(), "wb");
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream);
  const auto height = static_cast<png_uint_32>(pixels.size()) / width;
  png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_GRAY, 0, 0, 0);
  png_write_info(png, info);
  png_set_swap(png);
  for (png_uint_32 row = 0; row < height; ++row)
    png_write_row(png, reinterpret_cast<png_const_bytep>(pixels.data() + row * width));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(stream);
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
  PLYWriter().write(path("d.ply"), truth, true, false);
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
