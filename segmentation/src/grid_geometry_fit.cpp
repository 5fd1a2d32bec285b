// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/grid_layout.h>

#include "principal_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kTurn = 2.0 * M_PI;
/** Points that choose among projections, and that fit the raster of the chosen one. */
constexpr std::size_t kTrialSample = 2000;
constexpr std::size_t kSample = 20000;
constexpr double kWorst = std::numeric_limits<double>::infinity();

double
median(std::vector<double> values)
{
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** A chart coordinate of all cells together with the column (or row) it depends on. */
struct Samples {
  std::vector<double> index;
  std::vector<double> value;
};

/** value = first + step * index; residual is the median distance in cells. */
struct Line {
  double first = 0.0;
  double step = 0.0;
  double residual = kWorst;
};

Line
fitLine(const Samples& samples)
{
  const auto n = static_cast<double>(samples.index.size());
  double index = 0.0;
  double value = 0.0;
  for (std::size_t i = 0; i < samples.index.size(); ++i) {
    index += samples.index[i] / n;
    value += samples.value[i] / n;
  }
  double spread = 0.0;
  double common = 0.0;
  for (std::size_t i = 0; i < samples.index.size(); ++i) {
    spread += (samples.index[i] - index) * (samples.index[i] - index);
    common += (samples.index[i] - index) * (samples.value[i] - value);
  }
  Line line;
  if (!(spread > 0.0) || common == 0.0)
    return line;
  line.step = common / spread;
  line.first = value - line.step * index;
  std::vector<double> residuals(samples.index.size());
  for (std::size_t i = 0; i < residuals.size(); ++i)
    residuals[i] =
        std::abs((samples.value[i] - line.first) / line.step - samples.index[i]);
  line.residual = median(std::move(residuals));
  return line;
}

/** Chart coordinates of a grid's points under one projection and frame. */
class Candidate {
public:
  Candidate(const PointList& points, const GridGeometry& geometry, std::size_t sample)
      : grid_(geometry)
  {
    // Pairs of neighbours from every row are enough.
    const auto width = static_cast<std::size_t>(grid_.width);
    const std::size_t stride = 2 * (points.size() / sample + 1);
    for (std::size_t row = 0; row * width < points.size(); ++row)
      // Rows take turns, so that every column is seen.
      for (std::size_t first = 2 * row % stride; first < width; first += stride)
        for (std::size_t column = first; column < std::min(first + 2, width); ++column)
          addPoint(points[row * width + column], column, row);
    if (grid_.projection == GridProjection::spherical)
      unrollColumns();
  }

  /** Fit the raster; the residual, in cells, of the worse axis. */
  double
  fit()
  {
    if (columns_.index.size() < 8)
      return kWorst;
    const Line column = fitLine(columns_);
    Line row = fitLine(rows_);
    grid_.first_u = column.first;
    grid_.step_u = column.step;
    grid_.first_v = row.first;
    grid_.step_v = row.step;
    if (grid_.projection == GridProjection::spherical && row.residual > 0.3)
      row.residual = std::min(row.residual, tabulateRows(row));
    const double turn = std::abs(column.step) * grid_.width;
    grid_.wrap = grid_.projection == GridProjection::spherical && grid_.width > 8 &&
                 std::abs(turn - kTurn) < 1.5 * std::abs(column.step);
    return std::max(column.residual, row.residual);
  }

  const GridGeometry&
  grid() const
  {
    return grid_;
  }

private:
  void
  addPoint(const Eigen::Vector3f& point, std::size_t column, std::size_t row)
  {
    if (!point.allFinite())
      return;
    const Eigen::Vector3d chart = grid_.chart(point.cast<double>());
    if (!chart.allFinite() || (isAngular() && chart.z() <= 0.0))
      return;
    add(columns_, column, chart.x());
    add(rows_, row, chart.y());
  }

  static void
  add(Samples& samples, std::size_t index, double value)
  {
    samples.index.push_back(static_cast<double>(index));
    samples.value.push_back(value);
  }

  bool
  isAngular() const
  {
    return grid_.projection != GridProjection::plane;
  }

  /** Azimuths jump by a turn somewhere; let them go on instead. */
  void
  unrollColumns()
  {
    std::vector<double> steps;
    for (std::size_t i = 1; i < columns_.index.size(); ++i)
      if (columns_.index[i] == columns_.index[i - 1] + 1.0)
        steps.push_back(
            std::remainder(columns_.value[i] - columns_.value[i - 1], kTurn));
    const double step = steps.empty() ? 0.0 : median(std::move(steps));
    double sine = 0.0;
    double cosine = 0.0;
    for (std::size_t i = 0; i < columns_.index.size(); ++i) {
      sine += std::sin(columns_.value[i] - step * columns_.index[i]);
      cosine += std::cos(columns_.value[i] - step * columns_.index[i]);
    }
    const double phase = std::atan2(sine, cosine);
    for (std::size_t i = 0; i < columns_.index.size(); ++i) {
      const double expected = phase + step * columns_.index[i];
      columns_.value[i] =
          expected + std::remainder(columns_.value[i] - expected, kTurn);
    }
  }

  /** One angle per row, its median; residual as in fitLine(). */
  double
  tabulateRows(const Line& line)
  {
    std::vector<std::vector<double>> by_row(static_cast<std::size_t>(grid_.height));
    for (std::size_t i = 0; i < rows_.index.size(); ++i)
      by_row[static_cast<std::size_t>(rows_.index[i])].push_back(rows_.value[i]);
    std::vector<double> table;
    for (std::size_t r = 0; r < by_row.size(); ++r)
      table.push_back(by_row[r].empty()
                          ? line.first + line.step * static_cast<double>(r)
                          : median(by_row[r]));
    const bool ordered =
        line.step > 0.0 ? std::is_sorted(table.begin(), table.end())
                        : std::is_sorted(table.begin(), table.end(), std::greater<>());
    if (!ordered)
      return kWorst;
    std::vector<double> residuals;
    for (std::size_t i = 0; i < rows_.index.size(); ++i)
      residuals.push_back(
          std::abs((rows_.value[i] - table[static_cast<std::size_t>(rows_.index[i])]) /
                   line.step));
    grid_.row_v = std::move(table);
    return median(std::move(residuals));
  }

  GridGeometry grid_;
  Samples columns_;
  Samples rows_;
};

/** Neighbours are all that is known: typical distances stand in for steps. */
GridGeometry
fitLattice(const PointList& points, GridGeometry grid)
{
  grid.projection = GridProjection::lattice;
  grid.frame = principalAxes(points);
  const auto step = [&](std::size_t offset) {
    std::vector<double> distances;
    for (std::size_t i = offset; i < points.size(); ++i) {
      const double distance = (points[i] - points[i - offset]).norm();
      if (std::isfinite(distance))
        distances.push_back(distance);
    }
    const double typical = median(std::move(distances));
    return typical > 0.0 ? typical : 1.0;
  };
  grid.step_u = step(1);
  grid.step_v = step(static_cast<std::size_t>(grid.width));
  return grid;
}

} // namespace

GridGeometry
estimateGridGeometry(const PointList& points, int width, int height, int threads)
{
  if (width < 1 || height < 1 ||
      points.size() !=
          static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("estimateGridGeometry: not width times height points");
  if (threads < 1)
    throw std::invalid_argument("estimateGridGeometry: there must be a thread");
  constexpr double kAccepted = 0.5;
  GridGeometry empty;
  empty.width = width;
  empty.height = height;
  std::vector<GridGeometry> grids;
  for (const GridProjection projection :
       {GridProjection::perspective, GridProjection::spherical, GridProjection::plane})
    for (const Eigen::Matrix3d& frame : {GridGeometry::cameraFrame(),
                                         GridGeometry::vehicleFrame(),
                                         GridGeometry::mapFrame()}) {
      grids.push_back(empty);
      grids.back().projection = projection;
      grids.back().frame = frame;
    }
  std::vector<double> residuals(grids.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t k = 0; k < grids.size(); ++k)
    residuals[k] = Candidate(points, grids[k], kTrialSample).fit();
  const auto least = std::min_element(residuals.begin(), residuals.end());
  const auto best = static_cast<std::size_t>(least - residuals.begin());
  Candidate candidate(points, grids[best], kSample);
  return candidate.fit() < kAccepted ? candidate.grid() : fitLattice(points, empty);
}

} // namespace nurbs
} // namespace pcl
