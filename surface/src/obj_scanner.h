// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/obj_io.h>

#include <Eigen/Core>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Homogeneous from Cartesian point and weight; without weights all are 1. */
template <class Vector>
Vector
homogeneous(Vector point, bool is_rational)
{
  const Eigen::Index last = point.size() - 1;
  if (!is_rational)
    point(last) = 1.0;
  point.head(last) *= point(last);
  return point;
}

/** \brief Statements of an OBJ text as lists of words, with comments taken out and
 * continued lines joined; and the words as numbers. */
class ObjScanner {
public:
  using Words = std::vector<std::string_view>;

  /** \brief The text must outlive the scanner. */
  explicit ObjScanner(std::string_view text) : text_(text) {}

  /** \brief The words of the next statement, valid until the next call; may be none.
   * \return false at the end of the text */
  bool
  next(Words& words)
  {
    if (text_.empty())
      return false;
    statement_.clear();
    bool continues = true;
    while (continues && !text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      line = line.substr(0, line.find('#'));
      const std::size_t last = line.find_last_not_of(kBlanks);
      continues = last != std::string_view::npos && line[last] == '\\';
      statement_ += line.substr(0, continues ? last : line.size());
      statement_ += ' ';
    }
    words = split(statement_);
    return true;
  }

  /** \brief Raise an error that names the line. */
  [[noreturn]] void
  fail(const std::string& reason) const
  {
    throw ObjIoError("line " + std::to_string(line_) + ": " + reason);
  }

  /** \brief A finite number. */
  double
  number(std::string_view word) const
  {
    double value = 0.0;
    if (!word.empty() && word.front() == '+')
      word.remove_prefix(1);
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size() ||
        !std::isfinite(value))
      fail("\"" + std::string(word) + "\" is not a finite number");
    return value;
  }

  /** \brief A whole number. */
  int
  integer(std::string_view word) const
  {
    int value = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size())
      fail("\"" + std::string(word) + "\" is not an integer");
    return value;
  }

  /** \brief Position in a list of \a count: 1 is the first, -1 the last. */
  std::size_t
  index(std::string_view word, std::size_t count) const
  {
    // Texture and normal numbers may follow a slash; free-form surfaces have no use
    // for them.
    const std::int64_t given = integer(word.substr(0, word.find('/')));
    const auto size = static_cast<std::int64_t>(count);
    const std::int64_t position = given < 0 ? size + given : given - 1;
    if (position < 0 || position >= size)
      fail("number " + std::to_string(given) + " is not among the " +
           std::to_string(count) + " given before");
    return static_cast<std::size_t>(position);
  }

  /** \brief Coordinates and weight; the weight is 1 if it is left out. */
  template <int Dim>
  Eigen::Matrix<double, Dim + 1, 1>
  point(const Words& words) const
  {
    if (words.size() < Dim + 1)
      fail("a point needs " + std::to_string(Dim) + " coordinates");
    Eigen::Matrix<double, Dim + 1, 1> result;
    for (int d = 0; d < Dim; ++d)
      result(d) = number(words[1 + d]);
    // More numbers are colours: x y z r g b.
    const bool weighted = words.size() == Dim + 2;
    result(Dim) = weighted ? number(words[1 + Dim]) : 1.0;
    return result;
  }

private:
  static constexpr std::string_view kBlanks = " \t\r\v\f";

  static Words
  split(std::string_view line)
  {
    Words words;
    for (std::size_t at = line.find_first_not_of(kBlanks);
         at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(kBlanks, end);
    }
    return words;
  }

  std::string_view text_;
  std::string statement_;
  std::size_t line_ = 0;
};

} // namespace nurbs
} // namespace pcl
