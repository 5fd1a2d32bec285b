// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "range_coder.h"

#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::uint32_t kRangeFloor = 1U << 24;

std::uint64_t
bitsOf(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

double
fromBits(std::uint64_t bits)
{
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/** Bit pattern as an integer that increases with the value. */
std::uint64_t
orderedBits(double value)
{
  const std::uint64_t bits = bitsOf(value);
  return bits >> 63 != 0 ? ~bits : bits | 1ULL << 63;
}

double
fromOrderedBits(std::uint64_t ordered)
{
  return fromBits(ordered >> 63 != 0 ? ordered & ~(1ULL << 63) : ~ordered);
}

} // namespace

void
RangeEncoder::bit(AdaptiveBit& model, const bool& value)
{
  const std::uint32_t split = (range_ >> 16) * model.probabilityOfZero();
  if (value) {
    low_ += split;
    range_ -= split;
  }
  else {
    range_ = split;
  }
  model.update(value);
  while (range_ < kRangeFloor) {
    range_ <<= 8;
    shiftOut();
  }
}

void
RangeEncoder::direct(const std::uint64_t& value, int count)
{
  for (int place = count - 1; place >= 0; --place) {
    range_ >>= 1;
    if ((value >> place & 1) != 0)
      low_ += range_;
    if (range_ < kRangeFloor) {
      range_ <<= 8;
      shiftOut();
    }
  }
}

void
RangeEncoder::shiftOut()
{
  const bool carry = low_ >> 32 != 0;
  const auto top = static_cast<std::uint8_t>(low_ >> 24);
  if (top != 0xFF || carry) {
    // No later carry can pass a byte below 0xFF: what waits before it is final.
    for (; pending_ > 0; --pending_) {
      bytes_.push_back(static_cast<std::uint8_t>(first_pending_ + (carry ? 1 : 0)));
      first_pending_ = 0xFF;
    }
    first_pending_ = top;
  }
  ++pending_;
  low_ = (low_ & 0x00FFFFFFU) << 8;
}

std::vector<std::uint8_t>
RangeEncoder::finish()
{
  // Of the numbers in [low, low + range) take the one with 24 zero bits at its end.
  low_ = (low_ + kRangeFloor - 1) & ~static_cast<std::uint64_t>(kRangeFloor - 1);
  for (int i = 0; i < 5; ++i)
    shiftOut();
  while (!bytes_.empty() && bytes_.back() == 0)
    bytes_.pop_back();
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(const std::uint8_t* bytes, std::size_t size)
    : next_(bytes), end_(bytes + size)
{
  for (int i = 0; i < 4; ++i)
    code_ = code_ << 8 | (next_ != end_ ? *next_++ : 0U);
}

void
RangeDecoder::normalise()
{
  while (range_ < kRangeFloor) {
    range_ <<= 8;
    code_ = code_ << 8 | (next_ != end_ ? *next_++ : 0U);
  }
}

void
RangeDecoder::bit(AdaptiveBit& model, bool& value)
{
  const std::uint32_t split = (range_ >> 16) * model.probabilityOfZero();
  value = code_ >= split;
  if (value) {
    code_ -= split;
    range_ -= split;
  }
  else {
    range_ = split;
  }
  model.update(value);
  normalise();
}

void
RangeDecoder::direct(std::uint64_t& value, int count)
{
  value = 0;
  for (int i = 0; i < count; ++i) {
    range_ >>= 1;
    const bool bit = code_ >= range_;
    if (bit)
      code_ -= range_;
    value = value << 1 | (bit ? 1 : 0);
    normalise();
  }
}

template <class Coder>
void
DoubleModel::code(Coder& coder, double& value)
{
  const std::uint64_t bits = bitsOf(value);
  bool negative = bits >> 63 != 0;
  coder.bit(negative_, negative);
  std::int64_t step = static_cast<std::int64_t>(bits >> 52 & 0x7FF) - last_exponent_;
  exponent_step_.code(coder, step);
  const auto exponent =
      (static_cast<std::uint64_t>(last_exponent_) + static_cast<std::uint64_t>(step)) &
      0x7FF;
  last_exponent_ = static_cast<std::int64_t>(exponent);
  std::uint64_t mantissa = bits & ((1ULL << 52) - 1);
  int count = 52;
  while (count > 0 && (mantissa >> (52 - count) & 1) == 0)
    --count;
  mantissa_bits_.code(coder, count);
  count = count < 0 || count > 52 ? 52 : count; // only untrusted bytes get here
  mantissa >>= 52 - count;
  coder.direct(mantissa, count);
  value = fromBits(static_cast<std::uint64_t>(negative) << 63 | exponent << 52 |
                   mantissa << (52 - count));
}

template <class Coder>
void
DoubleSequenceModel::code(Coder& coder, std::vector<double>& values, std::size_t stride)
{
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t before = orderedBits(i < stride ? 0.0 : values[i - stride]);
    auto step = static_cast<std::int64_t>(orderedBits(values[i]) - before);
    step_.code(coder, step);
    values[i] = fromOrderedBits(before + static_cast<std::uint64_t>(step));
  }
}

template void
DoubleModel::code(RangeEncoder&, double&);
template void
DoubleModel::code(RangeDecoder&, double&);
template void
DoubleSequenceModel::code(RangeEncoder&, std::vector<double>&, std::size_t);
template void
DoubleSequenceModel::code(RangeDecoder&, std::vector<double>&, std::size_t);

} // namespace nurbs
} // namespace pcl
