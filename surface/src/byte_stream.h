// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/endian/conversion.hpp>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Appends little-endian numbers and texts to bytes. */
class ByteWriter {
public:
  template <class Integer>
  void
  integer(Integer value)
  {
    const Integer little = boost::endian::native_to_little(value);
    raw(&little, sizeof little);
  }

  void
  real(float value)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    integer(bits);
  }

  /** \brief Length in 32 bits, then the characters. */
  void
  text(const std::string& value)
  {
    integer(static_cast<std::uint32_t>(value.size()));
    raw(value.data(), value.size());
  }

  void
  raw(const void* data, std::size_t size)
  {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
  }

  std::vector<std::uint8_t> bytes;
};

/** \brief Reads what a ByteWriter wrote; throws std::out_of_range past the end. */
class ByteReader {
public:
  /** \brief The bytes must outlive the reader. */
  ByteReader(const std::uint8_t* bytes, std::size_t size)
      : next_(bytes), end_(bytes + size)
  {
  }

  template <class Integer>
  Integer
  integer()
  {
    Integer value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return boost::endian::little_to_native(value);
  }

  float
  real()
  {
    const auto bits = integer<std::uint32_t>();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  std::string
  text()
  {
    const auto size = integer<std::uint32_t>();
    return {reinterpret_cast<const char*>(take(size)), size};
  }

  std::size_t
  left() const
  {
    return static_cast<std::size_t>(end_ - next_);
  }

private:
  const std::uint8_t*
  take(std::size_t size)
  {
    if (size > left())
      throw std::out_of_range("ends too early");
    const std::uint8_t* first = next_;
    next_ += size;
    return first;
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

} // namespace nurbs
} // namespace pcl
