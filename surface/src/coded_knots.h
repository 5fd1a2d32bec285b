// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include "quantisation.h"

namespace pcl {
namespace nurbs {

/** \brief A knot vector as the .nurbs format holds it. */
struct CodedKnots {
  enum class Layout {
    UniformClamped,   /**< spans of equal length, clamped ends */
    UniformUnclamped, /**< spacing continues past both ends */
    Lattice,          /**< clamped, interior knots at first + k (last - first) / 2^b */
    Exact             /**< every knot as a double */
  };

  int degree = 1;
  Layout layout = Layout::UniformClamped;
  int spans = 1;
  double first = 0.0;
  double last = 1.0;
  int lattice_bits = 0;
  std::vector<std::int64_t> places; /**< k of each interior knot, non-decreasing */
  std::vector<double> exact;

  /** \throws std::invalid_argument if the numbers are no knot vector */
  KnotVector
  decoded() const;
};

/** \brief Knots whose parameters move by at most about \a tolerance; 0 keeps every bit.
 * \param[in] knots knots to code
 * \param[in] tolerance in units of the parameter
 * \param[in] keep_domain whether the ends of the domain must not move */
CodedKnots
codedKnots(const KnotVector& knots, double tolerance, bool keep_domain);

/** \brief Models of all knot vectors of one section. */
class KnotCodec {
public:
  template <class Coder>
  void
  code(Coder& coder, CodedKnots& knots, CodecBudget& budget);

private:
  template <class Coder>
  void
  codeLattice(Coder& coder, CodedKnots& knots, CodecBudget& budget);

  UnsignedModel degree_;
  ChoiceModel<4, CodedKnots::Layout> layout_;
  UnsignedModel count_;
  DoubleModel first_;
  DoubleModel last_;
  UnsignedModel lattice_bits_;
  UnsignedModel place_step_;
  DoubleSequenceModel exact_;
};

extern template void
KnotCodec::code(RangeEncoder&, CodedKnots&, CodecBudget&);
extern template void
KnotCodec::code(RangeDecoder&, CodedKnots&, CodecBudget&);

} // namespace nurbs
} // namespace pcl
