// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "input_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pcl {
namespace nurbs {

InputFile
loadInputFile(const std::string& path, std::size_t max_size)
{
  InputFile file{path, {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    file.fail("does not exist");
  if (!std::filesystem::is_regular_file(status))
    file.fail("is not a file");
  const auto size = std::filesystem::file_size(path, error);
  if (error)
    file.fail(error.message());
  if (size == 0)
    file.fail("is empty");
  if (size > max_size)
    file.fail("is larger than " + std::to_string(max_size) + " bytes");
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    file.fail(std::strerror(errno));
  file.bytes.resize(size);
  if (!stream.read(file.bytes.data(), static_cast<std::streamsize>(size)))
    file.fail("cannot be read");
  return file;
}

std::string
quotedWord(std::string_view word)
{
  constexpr std::size_t kMost = 20;
  std::string text(word.substr(0, kMost));
  for (char& letter : text)
    if (letter < ' ' || letter > '~')
      letter = '?';
  return '"' + text + '"';
}

} // namespace nurbs
} // namespace pcl
