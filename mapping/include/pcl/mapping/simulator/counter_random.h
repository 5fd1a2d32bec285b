// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstdint>

namespace pcl {
namespace nurbs {

/** \brief Random bits that depend on the argument only (splitmix64). */
constexpr std::uint64_t
scramble(std::uint64_t value)
{
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

/** \brief Random numbers that are a function of a key and of a counter.
 *
 * Who draws first, and on which thread, makes no difference: each (seed, scan, beam)
 * has a sequence of its own. Only additions and multiplications of IEEE doubles are
 * used, so that every machine gets the same bits; the standard library's distributions
 * would not. A plain value. \ingroup mapping
 */
class CounterRandom {
public:
  explicit CounterRandom(std::uint64_t seed) : key_(scramble(seed)) {}

  CounterRandom(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0)
      : key_(scramble(scramble(scramble(seed) ^ a) ^ (b + 0x632BE59BD9B4E019U)))
  {
  }

  /** \brief The next 64 bits. */
  std::uint64_t
  bits()
  {
    return scramble(key_ ^ (counter_++ * 0xD1B54A32D192ED03U));
  }

  /** \brief Uniform in [0, 1). */
  double
  uniform()
  {
    return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
  }

  /** \brief Uniform in [low, high). */
  double
  uniform(double low, double high)
  {
    return low + (high - low) * uniform();
  }

  /** \brief True with a probability. */
  bool
  chance(double probability)
  {
    return uniform() < probability;
  }

  /** \brief Very nearly normal, mean 0 and variance 1: the sum of twelve uniform
   * numbers (of 16 bits), never beyond 6. */
  double
  normal()
  {
    std::uint64_t sum = 0;
    for (int word = 0; word < 3; ++word) {
      const std::uint64_t random = bits();
      sum += (random & 0xFFFFU) + ((random >> 16U) & 0xFFFFU) +
             ((random >> 32U) & 0xFFFFU) + (random >> 48U);
    }
    // Each number stands for the middle of its 2^-16.
    return (static_cast<double>(sum) + 6.0) * 0x1.0p-16 - 6.0;
  }

private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

} // namespace nurbs
} // namespace pcl
