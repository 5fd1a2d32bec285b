// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstdint>
#include <stdexcept>

namespace pcl {
namespace nurbs {

/** \brief How many numbers untrusted bytes may still ask for. Charged before memory is
 * allocated. */
class CodecBudget {
public:
  explicit CodecBudget(std::uint64_t numbers) : left_(numbers) {}

  /** \throws std::length_error if there are fewer left */
  void
  take(std::uint64_t numbers)
  {
    if (numbers > left_)
      throw std::length_error("more numbers than the limit allows");
    left_ -= numbers;
  }

  std::uint64_t
  left() const
  {
    return left_;
  }

private:
  std::uint64_t left_;
};

/** \brief Charge for what is about to be decoded; encoding is not limited. */
template <class Coder>
void
charge([[maybe_unused]] CodecBudget& budget, [[maybe_unused]] std::uint64_t numbers)
{
  if constexpr (Coder::kDecodes)
    budget.take(numbers);
}

/** \brief Reject a decoded value that no writer makes. */
inline void
require(bool condition, const char* reason)
{
  if (!condition)
    throw std::invalid_argument(reason);
}

} // namespace nurbs
} // namespace pcl
