// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cloud_formats.h"

namespace pcl {
namespace nurbs {

/** Number format of one field of a point record. */
enum class NumberType { signed_int, unsigned_int, floating };

/** One named number (or several of it) of a point record. */
struct RecordField {
  std::string name;
  NumberType type = NumberType::floating;
  std::size_t size = 4; /**< bytes of one value: 1, 2, 4 or 8 */
  std::size_t count = 1;
};

/** How the points of a .pcd or .ply file are laid out, and the values taken from them.
 * Both formats describe their points by a list of fields in their header. */
class RecordLayout {
public:
  /** Find x, y, z and, when there are, intensity and colour among the fields. Fails
   * when a coordinate is missing or a field makes no sense. */
  RecordLayout(const InputFile& file, std::vector<RecordField> fields);

  RecordLayout(const RecordLayout&) = delete;
  RecordLayout&
  operator=(const RecordLayout&) = delete;

  /** Bytes of one binary point. */
  std::size_t
  stride() const
  {
    return stride_;
  }

  /** Values of one ascii point. */
  std::size_t
  numValues() const
  {
    return num_values_;
  }

  /** Points stored one after another. */
  void
  readBinary(std::string_view data,
             std::size_t points,
             bool big_endian,
             RawCloud& out) const;

  /** Points stored field by field. */
  void
  readColumns(std::string_view data, std::size_t points, RawCloud& out) const;

  /** Points as lines of numbers. Returns what follows them; fails when there are too
   * few of them or something is not a number. */
  std::string_view
  readAscii(std::string_view text, std::size_t points, RawCloud& out) const;

private:
  struct Place {
    RecordField field;
    std::size_t byte = 0;  /**< offset in a record */
    std::size_t value = 0; /**< index among the ascii values */
  };

  const Place*
  find(std::initializer_list<const char*> names) const;

  template <typename Value>
  void
  append(const Value& value, RawCloud& out) const;

  std::string file_;
  std::vector<Place> places_;
  std::size_t stride_ = 0;
  std::size_t num_values_ = 0;
  const Place* x_ = nullptr;
  const Place* y_ = nullptr;
  const Place* z_ = nullptr;
  const Place* intensity_ = nullptr;
  const Place* rgb_ = nullptr;
  const Place* red_ = nullptr;
  const Place* green_ = nullptr;
  const Place* blue_ = nullptr;
};

} // namespace nurbs
} // namespace pcl
