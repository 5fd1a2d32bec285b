// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "gzip_text.h"

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include <array>
#include <istream>

namespace pcl {
namespace nurbs {

namespace bio = boost::iostreams;

bool
isGzip(std::string_view bytes)
{
  return bytes.substr(0, 2) == "\x1f\x8b";
}

std::string
inflateGzip(const InputFile& file, std::size_t max_bytes)
{
  bio::filtering_istream stream;
  stream.push(bio::gzip_decompressor());
  stream.push(bio::array_source(file.bytes.data(), file.bytes.size()));
  stream.exceptions(std::ios::badbit); // so that damage is not taken for the end
  std::string text;
  std::array<char, 1U << 16U> buffer{};
  try {
    while (stream.good()) {
      stream.read(buffer.data(), buffer.size());
      text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
      if (text.size() > max_bytes)
        file.fail("holds more than " + std::to_string(max_bytes) + " bytes of text");
    }
  } catch (const std::ios_base::failure&) {
    file.fail("is a damaged or cut gzip file");
  }
  return text;
}

std::string
deflateGzip(std::string_view text)
{
  std::string bytes;
  bio::filtering_ostream stream;
  stream.push(bio::gzip_compressor());
  stream.push(bio::back_inserter(bytes));
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.reset();
  return bytes;
}

} // namespace nurbs
} // namespace pcl
