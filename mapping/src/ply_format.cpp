// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "header_lines.h"
#include "point_records.h"

#include <map>

namespace pcl {
namespace nurbs {
namespace {

using Words = std::vector<std::string>;

struct Header {
  std::string format;
  std::vector<RecordField> fields;
  std::size_t vertices = 0;
};

RecordField
readProperty(const InputFile& file, const Words& words)
{
  static const std::map<std::string, std::pair<NumberType, std::size_t>> types = {
      {"char", {NumberType::signed_int, 1}},
      {"int8", {NumberType::signed_int, 1}},
      {"uchar", {NumberType::unsigned_int, 1}},
      {"uint8", {NumberType::unsigned_int, 1}},
      {"short", {NumberType::signed_int, 2}},
      {"int16", {NumberType::signed_int, 2}},
      {"ushort", {NumberType::unsigned_int, 2}},
      {"uint16", {NumberType::unsigned_int, 2}},
      {"int", {NumberType::signed_int, 4}},
      {"int32", {NumberType::signed_int, 4}},
      {"uint", {NumberType::unsigned_int, 4}},
      {"uint32", {NumberType::unsigned_int, 4}},
      {"float", {NumberType::floating, 4}},
      {"float32", {NumberType::floating, 4}},
      {"double", {NumberType::floating, 8}},
      {"float64", {NumberType::floating, 8}}};
  if (words.size() < 3)
    file.fail("a property has no type or name");
  const auto type = types.find(words[1]);
  if (type == types.end())
    file.fail("vertex property of type " + quotedWord(words[1]) + " is not supported");
  return {words[2], type->second.first, type->second.second, 1};
}

/** The header up to its end. Elements after the vertices are of no interest; none may
 * come before them, because their size could not be told. */
Header
readHeader(const InputFile& file, HeaderLines& lines)
{
  if (lines.next() != Words{"ply"})
    file.fail("does not begin with \"ply\"");
  Header header;
  std::string element;
  for (Words words = lines.next(); words.empty() || words[0] != "end_header";
       words = lines.next()) {
    if (words.empty())
      continue;
    if (words[0] == "format" && words.size() > 1) {
      header.format = words[1];
    }
    else if (words[0] == "element" && words.size() > 2) {
      if (element.empty() && words[1] != "vertex")
        file.fail("its first element is not \"vertex\"");
      element = words[1];
      if (element == "vertex")
        header.vertices = lines.count("vertex count", words[2]);
    }
    else if (words[0] == "property" && element == "vertex") {
      header.fields.push_back(readProperty(file, words));
    }
  }
  return header;
}

} // namespace

RawCloud
readPly(const InputFile& file)
{
  HeaderLines lines(file, 1000);
  Header header = readHeader(file, lines);
  const RecordLayout layout(file, std::move(header.fields));
  const std::size_t points = header.vertices;
  if (points == 0)
    file.fail("has no points");
  const std::string_view body = lines.rest();
  const bool ascii = header.format == "ascii";
  const bool big_endian = header.format == "binary_big_endian";
  if (!ascii && !big_endian && header.format != "binary_little_endian")
    file.fail("format " + quotedWord(header.format) + " is unknown");
  const std::size_t least = ascii ? 2 * layout.numValues() : layout.stride();
  if (points > (body.size() + 1) / least)
    file.fail("holds fewer than the " + std::to_string(points) +
              " points its header promises");
  RawCloud cloud;
  cloud.width = static_cast<std::uint32_t>(points);
  if (ascii)
    layout.readAscii(body, points, cloud);
  else
    layout.readBinary(body, points, big_endian, cloud);
  return cloud;
}

} // namespace nurbs
} // namespace pcl
