// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/cloud_reader.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

/** The words of a line, read one after the other. */
class LineWords {
public:
  explicit LineWords(std::string_view line) : line_(line) {}

  /** Empty at the end. */
  std::string_view
  next()
  {
    const std::size_t begin = line_.find_first_not_of(kBlanks, position_);
    if (begin == std::string_view::npos) {
      position_ = line_.size();
      return {};
    }
    position_ = std::min(line_.find_first_of(kBlanks, begin), line_.size());
    return line_.substr(begin, position_ - begin);
  }

private:
  static constexpr const char* kBlanks = " \t\r\v\f";

  std::string_view line_;
  std::size_t position_ = 0;
};

/** Number in a word, all of it. */
template <typename Number>
bool
parseNumber(std::string_view word, Number& number)
{
  const char* const first =
      word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, number);
  return error == std::errc() && end == last && first != last;
}

} // namespace nurbs
} // namespace pcl
