// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/json_io.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A value and where it stands, so that errors can say so. */
class JsonNode {
public:
  JsonNode(const nlohmann::json& value, std::string path)
      : value_(value), path_(std::move(path))
  {
  }

  [[noreturn]] void
  fail(const std::string& reason) const
  {
    throw JsonIoError((path_.empty() ? "/" : path_) + ": " + reason);
  }

  bool
  has(const char* key) const
  {
    return value_.is_object() && value_.contains(key);
  }

  JsonNode
  at(const char* key) const
  {
    if (!value_.is_object())
      fail("is not an object");
    const auto found = value_.find(key);
    if (found == value_.end())
      fail(std::string("has no \"") + key + "\"");
    return {*found, path_ + "/" + key};
  }

  JsonNode
  at(std::size_t i) const
  {
    return {value_.at(i), path_ + "/" + std::to_string(i)};
  }

  std::size_t
  size() const
  {
    if (!value_.is_array())
      fail("is not an array");
    return value_.size();
  }

  const nlohmann::json&
  value() const
  {
    return value_;
  }

  double
  number() const
  {
    if (!value_.is_number())
      fail("is not a number");
    return value_.get<double>();
  }

  template <class Integer>
  Integer
  integer(std::uint64_t largest = std::numeric_limits<Integer>::max()) const
  {
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > largest)
      fail("is not an integer from 0 to " + std::to_string(largest));
    return static_cast<Integer>(value_.get<std::uint64_t>());
  }

  std::string
  text() const
  {
    if (!value_.is_string())
      fail("is not a text");
    return value_.get<std::string>();
  }

private:
  const nlohmann::json& value_;
  std::string path_;
};

/** \brief All numbers in an array, nested or not. */
inline void
appendNumbers(const JsonNode& node, std::vector<double>& numbers)
{
  if (!node.value().is_array()) {
    numbers.push_back(node.number());
    return;
  }
  for (std::size_t i = 0; i < node.size(); ++i)
    appendNumbers(node.at(i), numbers);
}

inline std::vector<double>
numbers(const JsonNode& node)
{
  if (!node.value().is_array())
    node.fail("is not an array");
  std::vector<double> result;
  appendNumbers(node, result);
  return result;
}

} // namespace nurbs
} // namespace pcl
