// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/cloud_reader.h>

#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

/** The bytes of a file and its name for messages. */
struct InputFile {
  std::string name;
  std::string bytes;

  [[noreturn]] void
  fail(const std::string& reason) const
  {
    throw InputError(name, reason);
  }
};

/** Read a whole file. \throws InputError if it is missing, empty, no regular file, or
 * larger than so many bytes */
InputFile
loadInputFile(const std::string& path, std::size_t max_size);

/** The beginning of a word of a file in quotes, for messages: bytes that are no
 * printable characters become '?'. */
std::string
quotedWord(std::string_view word);

} // namespace nurbs
} // namespace pcl
