// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "mask_boundary.h"

#include <array>
#include <cstddef>

namespace pcl {
namespace nurbs {
namespace {

/** Directions of border edges; the next one is a left turn in (column, row). */
constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/** Walks along the border edges of a mask. */
class BoundaryWalker {
public:
  explicit BoundaryWalker(const CellMask& mask)
      : mask_(mask),
        visited_(static_cast<std::size_t>(mask.width + 1) *
                 static_cast<std::size_t>(mask.height + 1) * 4)
  {
  }

  std::vector<LatticeLoop>
  walk()
  {
    std::vector<LatticeLoop> loops;
    for (int row = 0; row <= mask_.height; ++row)
      for (int column = 0; column <= mask_.width; ++column)
        for (int direction = 0; direction < 4; ++direction)
          if (isBorder(column, row, direction) && !visited(column, row, direction))
            loops.push_back(follow({column, row}, direction));
    return loops;
  }

private:
  /** Whether the edge from a corner has a cell on its left and none on its right. */
  bool
  isBorder(int column, int row, int direction) const
  {
    switch (direction) {
    case 0:
      return mask_.at(column, row) && !mask_.at(column, row - 1);
    case 1:
      return mask_.at(column - 1, row) && !mask_.at(column, row);
    case 2:
      return mask_.at(column - 1, row - 1) && !mask_.at(column - 1, row);
    default:
      return mask_.at(column, row - 1) && !mask_.at(column - 1, row - 1);
    }
  }

  std::vector<bool>::reference
  visited(int column, int row, int direction)
  {
    return visited_[(static_cast<std::size_t>(row) *
                         static_cast<std::size_t>(mask_.width + 1) +
                     static_cast<std::size_t>(column)) *
                        4 +
                    static_cast<std::size_t>(direction)];
  }

  LatticeLoop
  follow(Eigen::Vector2i corner, int direction)
  {
    LatticeLoop loop;
    int previous = -1;
    while (!visited(corner.x(), corner.y(), direction)) {
      visited(corner.x(), corner.y(), direction) = true;
      if (direction != previous)
        loop.push_back(corner);
      previous = direction;
      const auto& step = kStep[static_cast<std::size_t>(direction)];
      corner += Eigen::Vector2i(step[0], step[1]);
      // Left first: it closes around the one cell where two touch in a corner only.
      for (int turn : {1, 0, 3}) {
        const int next = (direction + turn) % 4;
        if (isBorder(corner.x(), corner.y(), next)) {
          direction = next;
          break;
        }
      }
    }
    return loop;
  }

  const CellMask& mask_;
  std::vector<bool> visited_;
};

} // namespace

std::vector<LatticeLoop>
traceBoundary(const CellMask& mask)
{
  return BoundaryWalker(mask).walk();
}

} // namespace nurbs
} // namespace pcl
