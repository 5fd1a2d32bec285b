// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "border_piece.h"
#include "point_welder.h"

#include <Eigen/Core>

#include <map>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A piece with its place in the model. */
struct Piece : BorderPiece {
  Piece(const BorderPiece& base, std::size_t of_patch, std::size_t of_loop, bool side)
      : BorderPiece(base), patch(of_patch), loop(of_loop), is_side(side)
  {
  }

  std::size_t patch, loop;
  bool is_side;           // of a domain without loops
  int start = 0, end = 0; // welded corners
};

/** \brief A piece that follows the first piece of its border. */
struct Follower {
  std::size_t piece;
  bool reversed;
};

/** \brief Pieces that are one curve in space. */
struct Border {
  std::size_t leader;
  std::vector<Follower> followers;
};

/** \brief Cuts the loops of patches into pieces and finds those that are one curve in
 * space.
 *
 * Pieces are single edges of straight-edged curves, else whole curves. Only pieces with
 * the same ends are compared, so the cost is linear in practice.
 */
class BorderMatcher {
public:
  BorderMatcher(const std::vector<const TrimmedSurface*>& patches,
                double weld_tolerance);

  /** \brief The loops of each patch, with the border of the domain for none. */
  const std::vector<std::vector<TrimLoop>>&
  loops() const
  {
    return loops_;
  }

  /** \brief All pieces, in the order of their patches, loops and curves. */
  const std::vector<Piece>&
  pieces() const
  {
    return pieces_;
  }

  const std::vector<Border>&
  borders() const
  {
    return borders_;
  }

  /** \brief Position of a welded corner. */
  const Eigen::Vector3d&
  corner(int index) const
  {
    return corners_.point(index);
  }

  /** \brief Parameter of a follower where its leader has the position \a target.
   * \param[in] leader piece
   * \param[in] follower piece and sense
   * \param[in] t parameter of the leader
   * \param[in] target position of the leader at \a t */
  double
  follow(std::size_t leader,
         const Follower& follower,
         double t,
         const Eigen::Vector3d& target) const;

private:
  void
  addPieces(const NurbsSurface& surface,
            const NurbsCurve2& curve,
            std::size_t patch,
            std::size_t loop,
            bool is_side);
  void
  join(std::size_t piece);
  bool
  coincide(std::size_t leader, const Follower& follower) const;

  double weld_tolerance_;
  PointWelder corners_;
  std::vector<std::vector<TrimLoop>> loops_;
  std::vector<Piece> pieces_;
  std::vector<Border> borders_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> borders_between_;
};

} // namespace nurbs
} // namespace pcl
