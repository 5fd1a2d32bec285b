// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cloud_formats.h"

#include <array>
#include <cmath>
#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

/** Readings farther than any sensor's are a sign that the bytes are not coordinates. */
constexpr float kFarthest = 1e7F;

bool
isPlausible(float value)
{
  return !(std::abs(value) > kFarthest);
}

} // namespace

RawCloud
readBin(const InputFile& file, int values_per_point)
{
  const auto values = static_cast<std::size_t>(values_per_point);
  const std::size_t stride = 4 * values;
  if (file.bytes.size() % stride != 0)
    file.fail("its size of " + std::to_string(file.bytes.size()) +
              " bytes is not a multiple of " + std::to_string(stride));
  const std::size_t points = file.bytes.size() / stride;
  if (points > 0xFFFFFFFFU)
    file.fail("has too many points");
  RawCloud cloud;
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.points.reserve(points);
  std::size_t implausible = 0;
  for (std::size_t i = 0; i < points; ++i) {
    std::array<float, 4> record{};
    std::memcpy(record.data(), file.bytes.data() + i * stride, stride);
    if (!isPlausible(record[0]) || !isPlausible(record[1]) || !isPlausible(record[2]))
      ++implausible;
    cloud.points.emplace_back(record[0], record[1], record[2]);
    if (values == 4)
      cloud.intensity.push_back(record[3]);
  }
  if (implausible * 100 > points)
    file.fail("does not hold coordinates in " + std::to_string(stride) +
              "-byte points");
  return cloud;
}

} // namespace nurbs
} // namespace pcl
