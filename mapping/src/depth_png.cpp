// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cloud_formats.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <memory>

namespace pcl {
namespace nurbs {
namespace {

/** A 16-bit grey image. */
struct DepthImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> pixels;
};

/** Feeds libpng from memory and remembers what it complains about. */
struct Source {
  std::string_view left;
  std::string problem;
};

void
readBytes(png_structp png, png_bytep out, std::size_t count)
{
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->left.size() < count)
    png_error(png, "ends within its image data");
  std::memcpy(out, source->left.data(), count);
  source->left.remove_prefix(count);
}

[[noreturn]] void
onError(png_structp png, png_const_charp message)
{
  static_cast<Source*>(png_get_error_ptr(png))->problem = message;
  png_longjmp(png, 1);
}

void
onWarning(png_structp, png_const_charp)
{
}

/** Runs between setjmp and longjmp: nothing with a destructor lives here. */
bool
decode(png_structp png, png_infop info, const InputFile& file, DepthImage& image)
{
  // A depth pixel takes two bytes; deflate packs at most 1032 to one.
  const std::size_t most_pixels = file.bytes.size() * 516;
  if (setjmp(png_jmpbuf(png)) != 0)
    return false;
  png_read_info(png, info);
  image.width = png_get_image_width(png, info);
  image.height = png_get_image_height(png, info);
  if (png_get_bit_depth(png, info) != 16 ||
      png_get_color_type(png, info) != PNG_COLOR_TYPE_GRAY)
    png_error(png, "is not a 16-bit grey image");
  if (png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
    png_error(png, "is interlaced");
  if (static_cast<std::size_t>(image.width) * image.height > most_pixels)
    png_error(png, "is too short for its size in pixels");
  png_set_swap(png);
  png_read_update_info(png, info);
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  for (std::uint32_t row = 0; row < image.height; ++row)
    png_read_row(png,
                 reinterpret_cast<png_bytep>(
                     image.pixels.data() + static_cast<std::size_t>(row) * image.width),
                 nullptr);
  return true;
}

DepthImage
readImage(const InputFile& file)
{
  constexpr std::size_t kSignature = 8;
  if (file.bytes.size() < kSignature ||
      png_sig_cmp(
          reinterpret_cast<png_const_bytep>(file.bytes.data()), 0, kSignature) != 0)
    file.fail("is not a PNG image");
  Source source{file.bytes, {}};
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr)
    throw std::bad_alloc();
  png_set_read_fn(png, &source, readBytes);
  DepthImage image;
  const bool good = decode(png, info, file, image);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good)
    file.fail(source.problem);
  return image;
}

/** Metres, or NaN where the sensor saw nothing. */
float
depthOf(std::uint16_t stored, const CloudReadOptions& options)
{
  if (stored == 0 || stored == 65535)
    return std::numeric_limits<float>::quiet_NaN();
  const auto bits = options.rotated_depth_bits
                        ? static_cast<std::uint16_t>(stored >> 3U | stored << 13U)
                        : stored;
  return static_cast<float>(bits / options.depth_scale);
}

} // namespace

RawCloud
readDepthPng(const InputFile& file,
             const CloudReadOptions& options,
             PinholeIntrinsics& intrinsics)
{
  const DepthImage image = readImage(file);
  const double focal = 525.0 * image.width / 640.0;
  intrinsics = options.intrinsics.value_or(PinholeIntrinsics{
      focal, focal, 0.5 * (image.width - 1.0), 0.5 * (image.height - 1.0)});
  RawCloud cloud;
  cloud.width = image.width;
  cloud.height = image.height;
  cloud.points.reserve(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double depth = depthOf(image.pixels[i], options);
    const auto column = static_cast<double>(i % image.width);
    const auto row = static_cast<double>(i / image.width);
    cloud.points.emplace_back((column - intrinsics.cx) / intrinsics.fx * depth,
                              (row - intrinsics.cy) / intrinsics.fy * depth,
                              depth);
  }
  return cloud;
}

} // namespace nurbs
} // namespace pcl
