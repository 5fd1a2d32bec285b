// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "point_records.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

template <typename T>
T
load(const std::array<char, 8>& bytes)
{
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

template <typename Small, typename Medium, typename Large, typename Huge>
double
loadInteger(const std::array<char, 8>& bytes, std::size_t size)
{
  switch (size) {
  case 1:
    return static_cast<double>(load<Small>(bytes));
  case 2:
    return static_cast<double>(load<Medium>(bytes));
  case 4:
    return static_cast<double>(load<Large>(bytes));
  default:
    return static_cast<double>(load<Huge>(bytes));
  }
}

/** A number of any type, as double; bytes may come in reverse order. */
double
decode(const char* data, const RecordField& field, bool big_endian)
{
  std::array<char, 8> bytes{};
  std::memcpy(bytes.data(), data, field.size);
  if (big_endian)
    std::reverse(bytes.begin(),
                 bytes.begin() + static_cast<std::ptrdiff_t>(field.size));
  switch (field.type) {
  case NumberType::floating:
    return field.size == 4 ? static_cast<double>(load<float>(bytes))
                           : load<double>(bytes);
  case NumberType::signed_int:
    return loadInteger<std::int8_t, std::int16_t, std::int32_t, std::int64_t>(
        bytes, field.size);
  default:
    return loadInteger<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>(
        bytes, field.size);
  }
}

/** Colours are often stored as a float whose bits are the colour. */
std::uint32_t
packedColor(double value, const RecordField& field)
{
  std::uint32_t bits = 0;
  if (field.type == NumberType::floating) {
    const auto number = static_cast<float>(value);
    std::memcpy(&bits, &number, sizeof(bits));
  }
  else {
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  }
  return bits & 0xFFFFFFU;
}

bool
isSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view
takeWord(std::string_view& text)
{
  const auto* const first = std::find_if_not(text.begin(), text.end(), isSpace);
  const auto* const last = std::find_if(first, text.end(), isSpace);
  const std::string_view word(first, static_cast<std::size_t>(last - first));
  text.remove_prefix(static_cast<std::size_t>(last - text.begin()));
  return word;
}

} // namespace

RecordLayout::RecordLayout(const InputFile& file, std::vector<RecordField> fields)
    : file_(file.name)
{
  for (RecordField& field : fields) {
    const bool sized =
        field.type == NumberType::floating
            ? field.size == 4 || field.size == 8
            : field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8;
    if (!sized || field.count < 1 || field.count > 65536)
      file.fail("field \"" + field.name + "\" has a size that does not exist");
    const std::size_t count = field.count;
    const std::size_t bytes = field.size * count;
    places_.push_back({std::move(field), stride_, num_values_});
    stride_ += bytes;
    num_values_ += count;
  }
  x_ = find({"x"});
  y_ = find({"y"});
  z_ = find({"z"});
  if (x_ == nullptr || y_ == nullptr || z_ == nullptr)
    file.fail("the points have no fields x, y and z");
  intensity_ = find({"intensity", "scalar_intensity", "reflectance"});
  rgb_ = find({"rgb", "rgba"});
  red_ = find({"red"});
  green_ = find({"green"});
  blue_ = find({"blue"});
}

const RecordLayout::Place*
RecordLayout::find(std::initializer_list<const char*> names) const
{
  for (const char* name : names)
    for (const Place& place : places_)
      if (place.field.name == name && place.field.count == 1)
        return &place;
  return nullptr;
}

template <typename Value>
void
RecordLayout::append(const Value& value, RawCloud& out) const
{
  out.points.emplace_back(value(*x_), value(*y_), value(*z_));
  if (intensity_ != nullptr)
    out.intensity.push_back(static_cast<float>(value(*intensity_)));
  if (rgb_ != nullptr && rgb_->field.size == 4) {
    out.rgb.push_back(packedColor(value(*rgb_), rgb_->field));
  }
  else if (red_ != nullptr && green_ != nullptr && blue_ != nullptr) {
    const auto channel = [&](const Place& place) {
      return static_cast<std::uint32_t>(std::clamp(value(place), 0.0, 255.0));
    };
    out.rgb.push_back(channel(*red_) << 16U | channel(*green_) << 8U | channel(*blue_));
  }
}

void
RecordLayout::readBinary(std::string_view data,
                         std::size_t points,
                         bool big_endian,
                         RawCloud& out) const
{
  out.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const char* record = data.data() + i * stride_;
    append(
        [&](const Place& place) {
          return decode(record + place.byte, place.field, big_endian);
        },
        out);
  }
}

void
RecordLayout::readColumns(std::string_view data,
                          std::size_t points,
                          RawCloud& out) const
{
  out.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i)
    append(
        [&](const Place& place) {
          const char* column = data.data() + place.byte * points;
          return decode(column + i * place.field.size, place.field, false);
        },
        out);
}

std::string_view
RecordLayout::readAscii(std::string_view text, std::size_t points, RawCloud& out) const
{
  out.points.reserve(points);
  std::vector<double> values(num_values_);
  for (std::size_t i = 0; i < points; ++i) {
    for (double& value : values) {
      const std::string_view word = takeWord(text);
      if (word.empty())
        throw InputError(file_,
                         "ends after " + std::to_string(i) + " of " +
                             std::to_string(points) + " points");
      const char* const first = word.data() + (word.front() == '+' ? 1 : 0);
      const char* const last = word.data() + word.size();
      const auto [end, error] = std::from_chars(first, last, value);
      if (error == std::errc::result_out_of_range)
        value = std::numeric_limits<double>::quiet_NaN();
      else if (error != std::errc() || end != last)
        throw InputError(file_,
                         "point " + std::to_string(i) + " holds " + quotedWord(word) +
                             ", not a number");
    }
    append([&](const Place& place) { return values[place.value]; }, out);
  }
  return text;
}

} // namespace nurbs
} // namespace pcl
