// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "edge_batch.h"

#include "vector_clones.h"

#include <cmath>
#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

/** x log x in arithmetic alone, so that loops over it become vector code. The mantissa
 * m is taken from [sqrt(1/2), sqrt(2)); log m = 2 artanh((m - 1) / (m + 1)), whose
 * series leaves less than 3e-8 after four terms. */
inline float
xLogXOfSingle(float x)
{
  std::int32_t bits = 0;
  std::memcpy(&bits, &x, sizeof(bits));
  constexpr std::int32_t kRootOfHalf = 0x3F3504F3;
  const std::int32_t exponent = (bits - kRootOfHalf) >> 23;
  bits -= exponent * (1 << 23);
  float mantissa = 0.0F;
  std::memcpy(&mantissa, &bits, sizeof(bits));
  const float s = (mantissa - 1.0F) / (mantissa + 1.0F);
  const float s2 = s * s;
  const float log =
      2.0F * s * (1.0F + s2 * (1.0F / 3.0F + s2 * (0.2F + s2 * (1.0F / 7.0F))));
  return x * (static_cast<float>(exponent) * static_cast<float>(M_LN2) + log);
}

/** What remains of a loop, not less than nothing; without a branch. */
inline float
shortened(float loop, float weight)
{
  const float rest = loop - weight;
  return 0.5F * (rest + std::abs(rest));
}

} // namespace

PCL_NURBS_VECTOR_CLONES void
EdgeBatch::boundGains()
{
  for (std::size_t k = 0; k < kMost; ++k) {
    const float w = weight[k];
    const float a = loop_a[k];
    const float b = loop_b[k];
    gain[k] = xLogXOfSingle(a) - xLogXOfSingle(shortened(a, w)) + xLogXOfSingle(b) -
              xLogXOfSingle(shortened(b, w)) - 2.0F * xLogXOfSingle(w) +
              static_cast<float>(kError);
  }
}

} // namespace nurbs
} // namespace pcl
