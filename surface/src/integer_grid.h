// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "quantisation.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Quantised scalars of a control net, row by row. */
struct IntegerGrid {
  IntegerGrid() = default;
  IntegerGrid(int rows_in, int cols_in)
      : rows(rows_in), cols(cols_in), values(static_cast<std::size_t>(rows) * cols)
  {
  }

  std::int64_t&
  at(int i, int j)
  {
    return values[static_cast<std::size_t>(i) * cols + j];
  }

  std::int64_t
  at(int i, int j) const
  {
    return values[static_cast<std::size_t>(i) * cols + j];
  }

  int rows = 0;
  int cols = 0;
  std::vector<std::int64_t> values;
};

/** \brief Codes a grid as differences of the order that makes them smallest, chosen in
 * each direction: order 1 in both is the parallelogram prediction, order 2 continues a
 * slope. The size of the neighbours' differences selects the model. */
class IntegerGridCodec {
public:
  /** \brief Rows and columns of \a grid are known to both sides. */
  template <class Coder>
  void
  code(Coder& coder, IntegerGrid& grid);

private:
  static constexpr int kContexts = 4;
  UnsignedModel order_;
  SignedModel corner_;
  SignedModel difference_[kContexts];
};

extern template void
IntegerGridCodec::code(RangeEncoder&, IntegerGrid&);
extern template void
IntegerGridCodec::code(RangeDecoder&, IntegerGrid&);

} // namespace nurbs
} // namespace pcl
