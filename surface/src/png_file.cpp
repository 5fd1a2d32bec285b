// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/surface_render.h>

#include <pcl/surface/nurbs/atomic_file.h>

#include <png.h>

#include <memory>
#include <stdexcept>

namespace pcl {
namespace nurbs {

void
writePng(const std::string& path, const Image& image)
{
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.pixels.size() != pixels)
    throw std::invalid_argument("writePng: the picture has no pixels");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const std::unique_ptr<png_image, decltype(&png_image_free)> guard(&png,
                                                                    &png_image_free);
  // In memory first: the file then goes the one way that checks every write.
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(
          &png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error("cannot write " + path + ": " + png.message);
  writeFileAtomically(path, {bytes.data(), size});
}

} // namespace nurbs
} // namespace pcl
