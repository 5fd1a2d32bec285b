// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cloud_formats.h"

#include <charconv>
#include <sstream>

namespace pcl {
namespace nurbs {

/** Lines of the text header of a file. */
class HeaderLines {
public:
  HeaderLines(const InputFile& file, std::size_t max_lines)
      : file_(file), lines_left_(max_lines)
  {
  }

  /** Words of the next line; fails when the header goes on for ever or the file ends.
   */
  std::vector<std::string>
  next()
  {
    constexpr std::size_t kMostBytes = 1U << 16U;
    const std::size_t end = file_.bytes.find('\n', position_);
    if (end == std::string::npos || end - position_ > kMostBytes || lines_left_ == 0)
      file_.fail("the header has no end");
    --lines_left_;
    std::istringstream line(file_.bytes.substr(position_, end - position_));
    position_ = end + 1;
    std::vector<std::string> words;
    for (std::string word; line >> word;)
      words.push_back(word);
    return words;
  }

  /** What follows the header. */
  std::string_view
  rest() const
  {
    return std::string_view(file_.bytes).substr(position_);
  }

  /** A count written in the header; fails when it is not a number below 2^32. */
  std::size_t
  count(const std::string& name, const std::string& word) const
  {
    std::uint32_t value = 0;
    const char* const last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, value);
    if (error != std::errc() || end != last)
      file_.fail(name + ' ' + quotedWord(word) + " is not a count");
    return value;
  }

private:
  const InputFile& file_;
  std::size_t position_ = 0;
  std::size_t lines_left_;
};

} // namespace nurbs
} // namespace pcl
