// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Steps and rounding shared by the quantised parts of the .nurbs format.

#pragma once

#include "codec_budget.h"
#include "range_coder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace pcl {
namespace nurbs {

/** \brief Largest quantised integer a writer makes; beyond it values are kept exact. */
constexpr double kMaxQuantised = 1.0e15;

/** \brief Quantisation step of code c = 4 e + m, 0 <= m < 4: (1 + m / 4) 2^e. Exact, so
 * every platform decodes the same values. */
inline double
stepFromCode(std::int64_t code)
{
  require(std::abs(code) <= 2000, "quantisation step out of range");
  const std::int64_t quarter = (code % 4 + 4) % 4;
  return std::ldexp(4.0 + static_cast<double>(quarter),
                    static_cast<int>((code - quarter) / 4) - 2);
}

/** \brief Code of the largest step that is not above \a step, within the range of the
 * codes. */
inline std::int64_t
codeFromStep(double step)
{
  int exponent = 0;
  const double bounded = step > 1e-150 ? std::min(step, 1e150) : 1e-150; // NaN, too
  const double fraction = std::frexp(bounded, &exponent);                // in [0.5, 1)
  const auto quarter = static_cast<std::int64_t>(8.0 * fraction) - 4;
  return 4 * (std::int64_t{exponent} - 1) + quarter;
}

/** \brief The nearest multiple of the largest power of two that is not above
 * \a tolerance; the value itself if that would need more bits than it has. */
inline double
roundedToTolerance(double value, double tolerance)
{
  if (!(tolerance > 0.0) || !std::isfinite(tolerance))
    return value;
  const double unit = std::ldexp(1.0, std::ilogb(tolerance));
  const double multiple = std::nearbyint(value / unit);
  return std::abs(multiple) < kMaxQuantised ? multiple * unit : value;
}

/** \brief Nearest integer of value / step; false if it is too large to be kept. */
inline bool
quantise(double value, double step, std::int64_t& integer)
{
  const double ratio = value / step;
  if (!(std::abs(ratio) < kMaxQuantised))
    return false;
  integer = std::llround(ratio);
  return true;
}

/** \brief Same as quantise(), 0 where it does not fit: for predictions that decoder and
 * encoder must agree on. */
inline std::int64_t
predictedInteger(double value, double step)
{
  std::int64_t integer = 0;
  return quantise(value, step, integer) ? integer : 0;
}

inline std::int64_t
wrappingAdd(std::int64_t a, std::int64_t b)
{
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) +
                                   static_cast<std::uint64_t>(b));
}

inline std::int64_t
wrappingSubtract(std::int64_t a, std::int64_t b)
{
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) -
                                   static_cast<std::uint64_t>(b));
}

/** \brief Code \a value as its difference to \a prediction. */
template <class Coder>
void
codeDifference(Coder& coder,
               SignedModel& model,
               std::int64_t& value,
               std::int64_t prediction)
{
  std::int64_t difference = wrappingSubtract(value, prediction);
  model.code(coder, difference);
  value = wrappingAdd(prediction, difference);
}

/** \brief Code one of \a Count alternatives. */
template <int Count, class Enum>
class ChoiceModel {
public:
  template <class Coder>
  void
  code(Coder& coder, Enum& choice)
  {
    int number = static_cast<int>(choice);
    model_.code(coder, number);
    require(number >= 0 && number < Count, "unknown alternative");
    choice = static_cast<Enum>(number);
  }

private:
  UnsignedModel model_;
};

} // namespace nurbs
} // namespace pcl
