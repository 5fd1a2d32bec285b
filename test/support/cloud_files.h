// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/cloud_reader.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <random>

namespace pcl {
namespace nurbs {
namespace test {

/** A folder of files that lasts as long as a test. */
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

/** A small organized cloud with a hole. */
inline PointCloud<PointXYZI>
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

/** 16-bit grey by libpng's low-level interface; its simple one would apply gamma. */
inline void
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

} // namespace test
} // namespace nurbs
} // namespace pcl
