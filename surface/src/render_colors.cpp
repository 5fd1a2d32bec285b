// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "render_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <tuple>

namespace pcl {
namespace nurbs {
namespace {

using Stops = std::array<std::array<float, 3>, 5>;

constexpr Stops kSequential = {
    {{45, 50, 130}, {30, 130, 160}, {95, 185, 105}, {245, 215, 70}, {200, 50, 40}}};
constexpr Stops kDiverging = {
    {{35, 65, 165}, {130, 175, 225}, {240, 240, 240}, {235, 150, 115}, {170, 25, 35}}};

// Glyphs of 3 x 5 pixels, rows from the top, the left pixel is the highest bit.
constexpr char kCharacters[] = "0123456789.-e+";
constexpr std::array<std::array<unsigned, 5>, 14> kGlyphs = {{{7, 5, 5, 5, 7},
                                                              {2, 6, 2, 2, 7},
                                                              {7, 1, 7, 4, 7},
                                                              {7, 1, 7, 1, 7},
                                                              {5, 5, 7, 1, 1},
                                                              {7, 4, 7, 1, 7},
                                                              {7, 4, 7, 5, 7},
                                                              {7, 1, 1, 1, 1},
                                                              {7, 5, 7, 5, 7},
                                                              {7, 5, 7, 1, 7},
                                                              {0, 0, 0, 0, 2},
                                                              {0, 0, 7, 0, 0},
                                                              {0, 7, 7, 4, 7},
                                                              {0, 2, 7, 2, 0}}};
constexpr int kGlyphWidth = 4; // with the gap
constexpr int kGlyphHeight = 5;

Rgb
toRgb(const Eigen::Vector3f& colour)
{
  return {static_cast<std::uint8_t>(colour.x()),
          static_cast<std::uint8_t>(colour.y()),
          static_cast<std::uint8_t>(colour.z())};
}

void
fillBox(Image& image, int x0, int y0, int x1, int y1, const Rgb& colour)
{
  for (int y = std::max(y0, 0); y < std::min(y1, image.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, image.width); ++x)
      image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(x)] = colour;
}

/** Text whose right end is at \a right, on a light box. */
void
drawNumber(Image& image, double value, int right, int top, int zoom)
{
  char text[16];
  std::snprintf(text, sizeof(text), "%.3g", value);
  const std::string number = text;
  const int left = right - static_cast<int>(number.size()) * kGlyphWidth * zoom;
  fillBox(image,
          left - zoom,
          top - zoom,
          right,
          top + (kGlyphHeight + 1) * zoom,
          {250, 250, 250});
  for (std::size_t k = 0; k < number.size(); ++k) {
    const std::size_t glyph = std::string(kCharacters).find(number[k]);
    if (glyph == std::string::npos)
      continue; // nan, inf: the bar has finite ends
    for (int row = 0; row < kGlyphHeight; ++row)
      for (int column = 0; column < 3; ++column)
        if ((kGlyphs[glyph][static_cast<std::size_t>(row)] >> (2 - column) & 1U) != 0) {
          const int x = left + (static_cast<int>(k) * kGlyphWidth + column) * zoom;
          const int y = top + row * zoom;
          fillBox(image, x, y, x + zoom, y + zoom, {20, 20, 20});
        }
  }
}

std::pair<double, double>
percentileRange(const std::vector<double>& values)
{
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) {
    return std::isfinite(v);
  });
  if (finite.empty())
    return {0.0, 1.0};
  std::sort(finite.begin(), finite.end());
  const std::size_t cut = finite.size() / 50;
  return {finite[cut], finite[finite.size() - 1 - cut]};
}

} // namespace

Eigen::Vector3f
patchColour(std::size_t index)
{
  // Steps by the golden ratio never come close to an earlier hue for long.
  const float hue = static_cast<float>(std::fmod(0.58 + 0.6180339887 * index, 1.0));
  const float saturation = index % 3 == 1 ? 0.38F : 0.55F;
  const float value = index % 2 == 0 ? 238.0F : 212.0F;
  const auto channel = [&](float offset) {
    const float k = std::fmod(offset + 6.0F * hue, 6.0F);
    const float wave = std::clamp(std::min(k, 4.0F - k), 0.0F, 1.0F);
    return value * (1.0F - saturation * wave);
  };
  return {channel(5.0F), channel(3.0F), channel(1.0F)};
}

ColourScale::ColourScale(const std::vector<double>& values,
                         const std::optional<std::pair<double, double>>& range)
{
  std::tie(low_, high_) = range ? *range : percentileRange(values);
  if (low_ < 0.0 && high_ > 0.0) {
    high_ = std::max(high_, -low_);
    low_ = -high_;
  }
  if (!(high_ > low_))
    high_ = low_ + std::max(1e-12, 1e-9 * std::abs(low_));
}

Eigen::Vector3f
ColourScale::colour(double value) const
{
  if (!std::isfinite(value))
    return {150.0F, 150.0F, 150.0F};
  const Stops& stops = low_ < 0.0 && high_ > 0.0 ? kDiverging : kSequential;
  const double last = static_cast<double>(stops.size() - 1);
  const double position = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0) * last;
  const auto k = static_cast<std::size_t>(std::min(position, last - 1.0));
  const float t = static_cast<float>(position - static_cast<double>(k));
  const Eigen::Map<const Eigen::Vector3f> from(stops[k].data());
  const Eigen::Map<const Eigen::Vector3f> to(stops[k + 1].data());
  return from + t * (to - from);
}

void
ColourScale::drawBar(Image& image) const
{
  const int zoom = std::max(1, image.height / 300);
  const int right = image.width - 6 * zoom;
  const int left = right - 8 * zoom;
  const int top = image.height / 10;
  const int bottom = image.height - top;
  fillBox(image, left - 1, top - 1, right + 1, bottom + 1, {20, 20, 20});
  for (int y = top; y < bottom; ++y) {
    const double t = (bottom - 0.5 - y) / (bottom - top);
    fillBox(image, left, y, right, y + 1, toRgb(colour(low_ + t * (high_ - low_))));
  }
  for (const double t : {0.0, 0.5, 1.0})
    drawNumber(image,
               low_ + t * (high_ - low_),
               left - 2 * zoom,
               bottom - static_cast<int>(t * (bottom - top)) - 2 * zoom,
               zoom);
}

} // namespace nurbs
} // namespace pcl
