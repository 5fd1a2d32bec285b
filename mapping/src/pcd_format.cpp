// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "header_lines.h"
#include "point_records.h"

#include <pcl/io/lzf.h>

#include <cstring>
#include <map>

namespace pcl {
namespace nurbs {
namespace {

using Words = std::vector<std::string>;

/** Header entries by their upper-case name, without the name. */
using Entries = std::map<std::string, Words>;

Entries
readHeader(const InputFile& file, HeaderLines& lines)
{
  Entries entries;
  while (entries.count("DATA") == 0) {
    Words words = lines.next();
    if (words.empty() || words.front().front() == '#')
      continue;
    const std::string name = words.front();
    words.erase(words.begin());
    entries[name] = std::move(words);
  }
  for (const char* name : {"FIELDS", "SIZE", "TYPE", "WIDTH", "HEIGHT", "DATA"})
    if (entries[name].empty())
      file.fail(std::string("the header has no ") + name);
  return entries;
}

NumberType
numberType(const InputFile& file, const std::string& letter)
{
  if (letter == "F")
    return NumberType::floating;
  if (letter == "I")
    return NumberType::signed_int;
  if (letter == "U")
    return NumberType::unsigned_int;
  file.fail("field type " + quotedWord(letter) + " is none of F, I and U");
}

std::vector<RecordField>
readFields(const InputFile& file, const HeaderLines& lines, Entries& entries)
{
  const Words& names = entries["FIELDS"];
  const Words& sizes = entries["SIZE"];
  const Words& types = entries["TYPE"];
  const Words& counts = entries["COUNT"];
  if (sizes.size() != names.size() || types.size() != names.size() ||
      (!counts.empty() && counts.size() != names.size()))
    file.fail("FIELDS, SIZE, TYPE and COUNT have different lengths");
  std::vector<RecordField> fields;
  for (std::size_t i = 0; i < names.size(); ++i)
    fields.push_back({names[i],
                      numberType(file, types[i]),
                      lines.count("SIZE", sizes[i]),
                      counts.empty() ? 1 : lines.count("COUNT", counts[i])});
  return fields;
}

/** Inflate a compressed body, whose sizes must agree with the header first. */
std::string
inflate(const InputFile& file, std::string_view body, std::size_t expected)
{
  std::uint32_t packed = 0;
  std::uint32_t unpacked = 0;
  if (body.size() < 8)
    file.fail("ends before its compressed data");
  std::memcpy(&packed, body.data(), 4);
  std::memcpy(&unpacked, body.data() + 4, 4);
  body.remove_prefix(8);
  if (unpacked != expected)
    file.fail("compressed data are of " + std::to_string(unpacked) +
              " bytes where the header says " + std::to_string(expected));
  if (packed > body.size())
    file.fail("ends within its compressed data");
  // LZF packs at most 264 bytes into 3.
  if (static_cast<std::uint64_t>(packed) * 88 < unpacked)
    file.fail("compressed data are too short for the points");
  std::string data(unpacked, '\0');
  if (pcl::lzfDecompress(body.data(), packed, data.data(), unpacked) != unpacked)
    file.fail("compressed data are damaged");
  return data;
}

} // namespace

RawCloud
readPcd(const InputFile& file)
{
  HeaderLines lines(file, 100);
  Entries entries = readHeader(file, lines);
  const RecordLayout layout(file, readFields(file, lines, entries));
  RawCloud cloud;
  const std::size_t width = lines.count("WIDTH", entries["WIDTH"].front());
  const std::size_t height = lines.count("HEIGHT", entries["HEIGHT"].front());
  const std::size_t points = width * height;
  if (!entries["POINTS"].empty() &&
      lines.count("POINTS", entries["POINTS"].front()) != points)
    file.fail("POINTS is not WIDTH times HEIGHT");
  if (points == 0)
    file.fail("has no points");
  cloud.width = static_cast<std::uint32_t>(width);
  cloud.height = static_cast<std::uint32_t>(height);
  const std::string_view body = lines.rest();
  const std::string format = entries["DATA"].front();
  // A point takes at least a character and a space for each of its values in text, and
  // a packed one at least 1/88 of its size.
  const std::size_t least = format == "ascii"    ? 2 * layout.numValues()
                            : format == "binary" ? layout.stride()
                                                 : (layout.stride() + 87) / 88;
  if (points > (body.size() + 1) / least)
    file.fail("holds fewer than the " + std::to_string(points) +
              " points its header promises");
  if (format == "ascii")
    layout.readAscii(body, points, cloud);
  else if (format == "binary")
    layout.readBinary(body, points, false, cloud);
  else if (format == "binary_compressed")
    layout.readColumns(inflate(file, body, points * layout.stride()), points, cloud);
  else
    file.fail("DATA " + quotedWord(format) + " is unknown");
  return cloud;
}

} // namespace nurbs
} // namespace pcl
