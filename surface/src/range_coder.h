// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Adaptive binary range coder and the integer models on top of it. Encoder and decoder
// have the same members, so one template describes a format in both directions:
// `coder.bit(model, value)` writes the value or overwrites it with what was read.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Running estimate of the probability that a bit is zero, in 1/65536.
 *
 * The n-th observation moves it by 1/(n + 2) of the way, n at most 30: quick at first,
 * which matters as most sections hold few values. */
class AdaptiveBit {
public:
  std::uint32_t
  probabilityOfZero() const
  {
    return zero_;
  }

  void
  update(bool bit)
  {
    if (bit)
      zero_ -= zero_ / (seen_ + 2);
    else
      zero_ += (65536 - zero_) / (seen_ + 2);
    if (seen_ < kMemory)
      ++seen_;
  }

private:
  static constexpr std::uint32_t kMemory = 30;
  std::uint32_t zero_ = 32768; // stays in 31..65505: the moves round towards zero
  std::uint32_t seen_ = 0;
};

/** \brief Writes bits into bytes; see finish(). */
class RangeEncoder {
public:
  static constexpr bool kDecodes = false;

  void
  bit(AdaptiveBit& model, const bool& value);

  /** \brief The low \a count bits (at most 64) of \a value, without a model. */
  void
  direct(const std::uint64_t& value, int count);

  /** \brief Close the stream and take its bytes; zero bytes at its end are left out. */
  std::vector<std::uint8_t>
  finish();

private:
  void
  shiftOut();

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFFU;
  std::uint64_t pending_ = 0; // bytes that a carry may still change
  std::uint8_t first_pending_ = 0xFF;
  std::vector<std::uint8_t> bytes_;
};

/** \brief Reads what a RangeEncoder wrote. Past the end it reads zeros, so it never
 * fails: callers bound what they allocate and loop over. */
class RangeDecoder {
public:
  static constexpr bool kDecodes = true;

  /** \brief The bytes must outlive the decoder. */
  RangeDecoder(const std::uint8_t* bytes, std::size_t size);

  void
  bit(AdaptiveBit& model, bool& value);

  void
  direct(std::uint64_t& value, int count);

private:
  void
  normalise();

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  std::uint32_t range_ = 0xFFFFFFFFU;
  std::uint32_t code_ = 0;
};

/** \brief Model of positive integers: the number of bits in unary, then the bits, of
 * which the two highest below the leading one are modelled. */
class PositiveModel {
public:
  template <class Coder>
  void
  code(Coder& coder, std::uint64_t& value)
  {
    int length = 0; // position of the leading one
    for (bool more = true; length < 63; ++length) {
      more = value >> length > 1;
      coder.bit(length_[static_cast<std::size_t>(length)], more);
      if (!more)
        break;
    }
    std::uint64_t result = 1;
    for (int place = length - 1; place >= 0; --place)
      codePlace(coder, value, place, length, result);
    value = result;
  }

private:
  template <class Coder>
  void
  codePlace(Coder& coder,
            const std::uint64_t& value,
            int place,
            int length,
            std::uint64_t& result)
  {
    if (result < 4) { // 1, then 2 or 3: the bits seen so far select the model
      bool bit = (value >> place & 1) != 0;
      coder.bit(high_[static_cast<std::size_t>(length)][result - 1], bit);
      result = 2 * result + (bit ? 1 : 0);
      return;
    }
    std::uint64_t bit = value >> place & 1;
    coder.direct(bit, 1);
    result = 2 * result + bit;
  }

  std::array<AdaptiveBit, 64> length_;
  std::array<std::array<AdaptiveBit, 3>, 64> high_;
};

/** \brief Model of integers >= 0. */
class UnsignedModel {
public:
  template <class Coder, class Integer>
  void
  code(Coder& coder, Integer& value)
  {
    std::uint64_t positive = static_cast<std::uint64_t>(value) + 1;
    model_.code(coder, positive);
    value = static_cast<Integer>(positive - 1);
  }

private:
  PositiveModel model_;
};

/** \brief Model of signed integers that cluster around zero. */
class SignedModel {
public:
  template <class Coder>
  void
  code(Coder& coder, std::int64_t& value)
  {
    bool nonzero = value != 0;
    coder.bit(nonzero_, nonzero);
    if (!nonzero) {
      value = 0;
      return;
    }
    bool negative = value < 0;
    coder.bit(negative_, negative);
    // Unsigned arithmetic: also right for the lowest integer.
    auto magnitude = static_cast<std::uint64_t>(value);
    if (negative)
      magnitude = 0 - magnitude;
    magnitude_.code(coder, magnitude);
    value = static_cast<std::int64_t>(negative ? 0 - magnitude : magnitude);
  }

private:
  AdaptiveBit nonzero_;
  AdaptiveBit negative_;
  PositiveModel magnitude_;
};

/** \brief Model of doubles, exact for every bit pattern; values with few significant
 * bits (0, 1, -0.5, multiples of a power of two) are short. */
class DoubleModel {
public:
  template <class Coder>
  void
  code(Coder& coder, double& value);

private:
  AdaptiveBit negative_;
  SignedModel exponent_step_;
  UnsignedModel mantissa_bits_;
  std::int64_t last_exponent_ = 1023;
};

/** \brief Sequence of doubles that resemble each other, exact for every bit pattern. */
class DoubleSequenceModel {
public:
  template <class Coder>
  void
  code(Coder& coder, std::vector<double>& values, std::size_t stride);

private:
  SignedModel step_;
};

extern template void
DoubleModel::code(RangeEncoder&, double&);
extern template void
DoubleModel::code(RangeDecoder&, double&);
extern template void
DoubleSequenceModel::code(RangeEncoder&, std::vector<double>&, std::size_t);
extern template void
DoubleSequenceModel::code(RangeDecoder&, std::vector<double>&, std::size_t);

} // namespace nurbs
} // namespace pcl
