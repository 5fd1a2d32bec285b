// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/trimmed_surface.h>

#include "coded_knots.h"

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The parameters a + k s that one coordinate of a polygon's corners may have.
 */
struct TrimLattice {
  std::int64_t cells = 0; /**< > 0: the domain in that many parts; 0: as follows */
  double origin = 0.0;
  double spacing = 1.0;

  /** \param[in] knots decoded knots of the direction
   * \param[in] place k */
  double
  at(const KnotVector& knots, std::int64_t place) const;

  bool
  operator==(const TrimLattice& other) const
  {
    return cells == other.cells && origin == other.origin && spacing == other.spacing;
  }
};

/** \brief A trimming loop as the .nurbs format holds it. */
struct CodedLoop {
  enum class Kind {
    Lattice, /**< polygon with its corners on a lattice */
    Corners, /**< polygon, corners as doubles */
    Curves   /**< any curves, every bit */
  };
  using Place = std::array<std::int64_t, 2>;

  Kind kind = Kind::Lattice;
  std::array<TrimLattice, 2> lattice;
  std::vector<Place> places;
  std::vector<double> corners;
  std::vector<NurbsCurve2> curves;

  /** \throws std::invalid_argument if the numbers make no loop */
  TrimLoop
  decoded(const KnotVector& knots_u, const KnotVector& knots_v) const;
};

/** \brief Loop whose corners move by at most half a \a tolerance; zeros keep every bit.
 * \param[in] loop loop in the domain of \a knots
 * \param[in] knots knots in u and v
 * \param[in] coded_knots the same as they will be decoded
 * \param[in] tolerance lattice spacing allowed in u and v
 * \throws std::invalid_argument if the loop is open */
CodedLoop
codedLoop(const TrimLoop& loop,
          const std::array<KnotVector, 2>& knots,
          const std::array<KnotVector, 2>& coded_knots,
          const std::array<double, 2>& tolerance);

/** \brief Whether all curves of a loop are polygons. */
bool
hasStraightEdges(const TrimLoop& loop);

/** \brief Models of all trimming loops of one section. */
class TrimCodec {
public:
  template <class Coder>
  void
  code(Coder& coder, CodedLoop& loop, CodecBudget& budget);

private:
  /** Direction of an edge relative to the one before. */
  enum Turn { Straight, Left, Right, Oblique, Back, kTurns };

  template <class Coder>
  void
  codeLattices(Coder& coder, std::array<TrimLattice, 2>& lattice);
  template <class Coder>
  void
  codeLattice(Coder& coder, TrimLattice& lattice);
  template <class Coder>
  void
  codePlaces(Coder& coder, std::vector<CodedLoop::Place>& places);
  template <class Coder>
  void
  codeEdge(Coder& coder, CodedLoop::Place& edge);
  template <class Coder>
  void
  codeCurve(Coder& coder, NurbsCurve2& curve, CodecBudget& budget);

  ChoiceModel<3, CodedLoop::Kind> kind_;
  UnsignedModel count_;
  AdaptiveBit same_lattice_;
  std::array<TrimLattice, 2> last_lattice_;
  SignedModel cells_;
  DoubleModel origin_;
  DoubleModel spacing_;
  SignedModel start_;
  UnsignedModel turn_[kTurns][kTurns];
  UnsignedModel run_;
  SignedModel oblique_;
  int heading_ = 0; // 0..3: +u, +v, -u, -v
  int last_turn_ = Straight;
  int turn_before_ = Straight;
  DoubleSequenceModel corner_;
  KnotCodec knots_;
  DoubleSequenceModel point_;
};

extern template void
TrimCodec::code(RangeEncoder&, CodedLoop&, CodecBudget&);
extern template void
TrimCodec::code(RangeDecoder&, CodedLoop&, CodecBudget&);

} // namespace nurbs
} // namespace pcl
