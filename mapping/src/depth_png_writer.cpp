// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "depth_png_writer.h"

#include <pcl/surface/nurbs/atomic_file.h>

#include <png.h>

#include <csetjmp>
#include <new>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

void
append(png_structp png, png_bytep data, std::size_t count)
{
  auto* out = static_cast<std::string*>(png_get_io_ptr(png));
  out->append(reinterpret_cast<const char*>(data), count);
}

void
doNothing(png_structp)
{
}

/** Runs between setjmp and longjmp: nothing with a destructor lives here. */
bool
encode(png_structp png,
       png_infop info,
       const std::vector<std::uint16_t>& pixels,
       std::uint32_t width)
{
  constexpr int kFast = 3; // zlib's level
  if (setjmp(png_jmpbuf(png)) != 0)
    return false;
  const auto height = static_cast<png_uint_32>(pixels.size() / width);
  png_set_compression_level(png, kFast);
  png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_GRAY, 0, 0, 0);
  png_write_info(png, info);
  png_set_swap(png);
  for (png_uint_32 row = 0; row < height; ++row)
    png_write_row(png,
                  reinterpret_cast<png_const_bytep>(
                      pixels.data() + static_cast<std::size_t>(row) * width));
  png_write_end(png, info);
  return true;
}

} // namespace

void
writeDepthPng(const std::string& path,
              const std::vector<std::uint16_t>& pixels,
              std::uint32_t width)
{
  std::string bytes;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr)
    throw std::bad_alloc();
  png_set_write_fn(png, &bytes, append, doNothing);
  const bool good = encode(png, info, pixels, width);
  png_destroy_write_struct(&png, &info);
  if (!good)
    throw std::runtime_error("cannot write " + path + ": libpng failed");
  writeFileAtomically(path, bytes);
}

} // namespace nurbs
} // namespace pcl
