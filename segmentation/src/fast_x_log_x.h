// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl {
namespace nurbs {

/** x log x without a call: the mantissa's first bits name an entry of a table, a cubic
 * does the rest. */
class FastXLogX {
public:
  /** Bound of the error divided by x. The cubic leaves r^4 / 4 with |r| <= 2^-8, that
   * is less than 6e-11; rounding is far smaller, also where the exponent is large. */
  static constexpr double kError = 1e-10;

  FastXLogX()
  {
    for (std::size_t i = 0; i < kEntries; ++i) {
      const double middle = 1.0 + (static_cast<double>(i) + 0.5) / kEntries;
      table_[i] = {1.0 / middle, std::log(middle)};
    }
  }

  /** \param[in] x finite and not negative; 0 is returned for less than 1e-300 */
  double
  operator()(double x) const
  {
    if (!(x > 1e-300))
      return 0.0;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof(bits));
    const Entry& entry = table_[(bits >> (52U - kBits)) & (kEntries - 1)];
    const auto exponent = static_cast<double>(static_cast<int>(bits >> 52U) - 1023);
    bits = (bits & 0x000FFFFFFFFFFFFFU) | 0x3FF0000000000000U; // in [1, 2)
    double mantissa = 0.0;
    std::memcpy(&mantissa, &bits, sizeof(bits));
    const double r = mantissa * entry.inverse - 1.0;
    const double log1p = r - r * r * (0.5 - r * (1.0 / 3.0));
    return x * (exponent * M_LN2 + entry.log + log1p);
  }

private:
  static constexpr unsigned int kBits = 7;
  static constexpr std::size_t kEntries = 1U << kBits;

  struct Entry {
    double inverse;
    double log;
  };

  std::array<Entry, kEntries> table_;
};

} // namespace nurbs
} // namespace pcl
