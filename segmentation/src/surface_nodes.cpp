// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Terms that a smooth block is described by. */
int
blockTerms(const ViewChart& chart)
{
  return chart.termChoices()[1];
}

struct Blocks {
  Blocks(const GridGeometry& grid, BlockSize size)
      : across(
            static_cast<std::size_t>((grid.width + size.columns - 1) / size.columns)),
        down(static_cast<std::size_t>((grid.height + size.rows - 1) / size.rows))
  {
  }

  std::size_t across;
  std::size_t down;
};

/** Call visit(cell) for each cell of a block, row by row. */
template <typename Visit>
void
forEachCell(const GridGeometry& grid,
            BlockSize size,
            std::size_t block,
            const Visit& visit)
{
  const std::size_t across = Blocks(grid, size).across;
  const int left = static_cast<int>(block % across) * size.columns;
  const int top = static_cast<int>(block / across) * size.rows;
  const int right = std::min(left + size.columns, grid.width);
  const int bottom = std::min(top + size.rows, grid.height);
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column)
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
            static_cast<std::size_t>(column));
}

ViewSums
blockSums(const GridPoints& points,
          const ViewChart& chart,
          BlockSize size,
          std::size_t block)
{
  ViewSums sums;
  forEachCell(points.geometry, size, block, [&](std::size_t cell) {
    if (points.valid(cell))
      sums.add(chart.sample(cell));
  });
  return sums;
}

/** Mean square residual of a block's own model, per degree of freedom. */
double
meanSquare(const ViewSums& sums, const ViewChart& chart)
{
  const int rich = blockTerms(chart);
  const int terms = sums.count() >= 2.0 * rich ? rich : chart.termChoices().front();
  return sums.misfit(sums.fit(terms)) / std::max(1.0, sums.count() - terms);
}

/** Adds up what edges tell about pairs of nodes. */
class LinkCollector {
public:
  void
  add(std::uint32_t a, std::uint32_t b, float border, float weight)
  {
    if (a > b)
      std::swap(a, b);
    if (!links_.empty() && links_.back().a == a && links_.back().b == b) {
      links_.back().border += border;
      links_.back().weight += weight;
    }
    else
      links_.push_back({a, b, border, weight});
  }

  std::vector<NodeLink>
  take()
  {
    std::stable_sort(
        links_.begin(), links_.end(), [](const NodeLink& p, const NodeLink& q) {
          return p.a != q.a ? p.a < q.a : p.b < q.b;
        });
    LinkCollector merged;
    for (const NodeLink& link : links_)
      merged.add(link.a, link.b, link.border, link.weight);
    return std::move(merged.links_);
  }

private:
  std::vector<NodeLink> links_;
};

} // namespace

struct SurfaceNodes::Block {
  std::size_t index = 0;
  ViewSums sums;
  double mean_square = 0.0; // of the residuals, negative for no node
};

SurfaceNodes::SurfaceNodes(const GridPoints& points,
                           const KeptEdges& edges,
                           const ViewChart& chart)
    : points_(points), edges_(edges), chart_(chart), of_cell_(points.size(), kNone)
{
}

bool
SurfaceNodes::cutInside(std::size_t cell, BlockSize size) const
{
  const auto width = static_cast<std::size_t>(points_.geometry.width);
  const auto block = [&](std::size_t at) {
    return std::make_pair(at % width / static_cast<std::size_t>(size.columns),
                          at / width / static_cast<std::size_t>(size.rows));
  };
  const GridGraph& graph = edges_.graph();
  for (int d = 0; d < graph.numDirections(); ++d) {
    const std::int32_t target = graph.target(d)[cell];
    if (target != GridGraph::kNone && !edges_.keeps(d, cell) &&
        block(static_cast<std::size_t>(target)) == block(cell))
      return true;
  }
  return false;
}

SurfaceNodes::Block
SurfaceNodes::gather(std::size_t index, BlockSize size) const
{
  Block block;
  block.index = index;
  block.mean_square = -1.0;
  const GridGeometry& grid = points_.geometry;
  bool usable = true;
  std::size_t members = 0;
  forEachCell(grid, size, index, [&](std::size_t cell) {
    if (!points_.valid(cell))
      return;
    usable = usable && of_cell_[cell] == kNone && !cutInside(cell, size);
    ++members;
  });
  const int gap = grid.max_gap;
  const int share = 2 * gap * gap; // of the cells that must be filled
  const int least = std::max(4, size.columns * size.rows / share);
  if (!usable || members < static_cast<std::size_t>(least))
    return block;
  block.sums = blockSums(points_, chart_, size, index);
  block.mean_square = meanSquare(block.sums, chart_);
  return block;
}

void
SurfaceNodes::append(const std::vector<Block>& blocks, BlockSize size, double limit)
{
  for (const Block& block : blocks) {
    if (block.mean_square < 0.0 || block.mean_square > limit)
      continue;
    forEachCell(points_.geometry, size, block.index, [&](std::size_t cell) {
      if (points_.valid(cell))
        of_cell_[cell] = count();
    });
    sums_.push_back(block.sums);
    block_.push_back(block.index);
  }
}

void
SurfaceNodes::addBlocks(BlockSize size, double sigmas, int threads)
{
  const Blocks shape(points_.geometry, size);
  const auto rows = static_cast<std::ptrdiff_t>(shape.down);
  // A row of blocks at a time keeps the candidates that are dropped out of memory.
  std::vector<std::vector<Block>> found(shape.down);
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
  for (std::ptrdiff_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < shape.across; ++k) {
      Block block = gather(static_cast<std::size_t>(row) * shape.across + k, size);
      if (block.mean_square >= 0.0)
        found[static_cast<std::size_t>(row)].push_back(block);
    }
  for (const std::vector<Block>& line : found)
    append(line, size, sigmas * sigmas);
}

std::vector<NodeLink>
SurfaceNodes::links(std::uint32_t first, int threads) const
{
  const GridGraph& graph = edges_.graph();
  std::vector<LinkCollector> collected(static_cast<std::size_t>(graph.numDirections()));
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int d = 0; d < graph.numDirections(); ++d) {
    const bool side = d == GridGraph::kRight || d == GridGraph::kDown;
    for (std::size_t i = 0; i < of_cell_.size(); ++i) {
      if (of_cell_[i] == kNone || !edges_.keeps(d, i))
        continue;
      const std::uint32_t far = of_cell_[static_cast<std::size_t>(graph.target(d)[i])];
      if (far != kNone && far != of_cell_[i] && std::max(far, of_cell_[i]) >= first)
        collected[static_cast<std::size_t>(d)].add(
            of_cell_[i], far, side ? 1.0F : 0.0F, graph.weight(d)[i]);
    }
  }
  LinkCollector all;
  for (LinkCollector& one : collected)
    for (const NodeLink& link : one.take())
      all.add(link.a, link.b, link.border, link.weight);
  return all.take();
}

double
measureNoiseScale(const GridPoints& points,
                  const ViewChart& chart,
                  BlockSize size,
                  int threads)
{
  // A good part of the blocks of a scene is smooth.
  constexpr double kQuantile = 0.3;
  constexpr std::size_t kSample = 600;
  constexpr double kMuchLarger = 2.0; // in variance; less may be chance
  constexpr double kNone = -1.0;
  const Blocks shape(points.geometry, size);
  const std::size_t count = shape.across * shape.down;
  const double least = 2.0 * blockTerms(chart);
  const std::size_t stride = count / kSample + 1;
  std::vector<double> squares((count + stride - 1) / stride, kNone);
#pragma omp parallel for num_threads(threads)
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const ViewSums sums = blockSums(points, chart, size, k * stride);
    if (sums.count() >= least)
      squares[k] = meanSquare(sums, chart);
  }
  squares.erase(std::remove(squares.begin(), squares.end(), kNone), squares.end());
  if (squares.empty())
    return 1.0;
  const auto where =
      squares.begin() +
      static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(squares.size()));
  std::nth_element(squares.begin(), where, squares.end());
  return *where > kMuchLarger ? std::sqrt(*where) : 1.0;
}

} // namespace nurbs
} // namespace pcl
