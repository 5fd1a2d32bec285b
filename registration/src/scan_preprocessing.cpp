// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/beam_calibration.h>
#include <pcl/registration/scan_preprocessing.h>

#include "chunked_sum.h"
#include "local_surface.h"
#include "point_selection.h"
#include "voxel_key.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kDeskewSteps = 128;

/** Power of two that leaves at least half of the table empty. */
std::size_t
slotsFor(std::size_t keys)
{
  std::size_t slots = 64;
  while (slots < 2 * keys)
    slots *= 2;
  return slots;
}

/** Set of keys that only grows. */
class KeySet {
public:
  explicit KeySet(std::size_t most) : table_(slotsFor(most), kNone) {}

  /** Whether it was not there yet. */
  bool
  add(std::uint64_t key)
  {
    const std::size_t mask = table_.size() - 1;
    std::size_t i = voxelHash(key) & mask;
    for (; table_[i] != kNone; i = (i + 1) & mask)
      if (table_[i] == key)
        return false;
    table_[i] = key;
    return true;
  }

private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0}; // keys have 63 bits
  std::vector<std::uint64_t> table_;
};

/** Twice the median distance from the mean. */
double
extent(const ScanPoints& points)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points)
    mean += point.cast<double>();
  mean /= static_cast<double>(points.size());
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    distances.push_back((point.cast<double>() - mean).norm());
  const auto middle =
      distances.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 2.0 * *middle;
}

/** Share of some thousand points around which a map is flat. */
double
flatShare(const VoxelMap& map, const ScanPoints& points)
{
  const std::size_t step = std::max<std::size_t>(points.size() / 1000, 1);
  double flat = 0.0;
  double asked = 0.0;
  for (std::size_t i = 0; i < points.size(); i += step, asked += 1.0)
    flat += localSurface(map.surface(points[i].cast<double>())).flat() ? 1.0 : 0.0;
  return flat / asked;
}

} // namespace

std::vector<std::size_t>
voxelSubsampleIndices(const ScanPoints& points, double voxel_size)
{
  if (!(voxel_size > 0.0))
    throw std::invalid_argument("voxelSubsample: the voxel size must be positive");
  KeySet seen(points.size());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cell = voxelCell(points[i].cast<double>(), 1.0 / voxel_size);
    if (cell && seen.add(voxelKey(*cell)))
      kept.push_back(i);
  }
  return kept;
}

ScanPoints
voxelSubsample(const ScanPoints& points, double voxel_size)
{
  return selected(points, voxelSubsampleIndices(points, voxel_size));
}

ScanPoints
thinned(const ScanPoints& points, std::size_t most)
{
  return evenlyChosen(points, most);
}

double
suitableVoxelSize(const ScanPoints& points)
{
  constexpr int kLargest = 4;  // sizes are the extent over powers of two; at larger
  constexpr int kSmallest = 9; // ones a landscape is flat as a whole
  constexpr double kAlmost = 0.85;
  const double size = points.size() < 10 ? 0.0 : extent(points);
  if (!(size > 0.0))
    return 1.0;
  VoxelMapOptions options;
  options.voxel_size = std::ldexp(size, -kSmallest);
  options.max_points = 1;
  VoxelMap map(options);
  for (const Eigen::Vector3f& point : points)
    map.insert(point.cast<double>());
  std::vector<double> shares{flatShare(map, points)};
  for (int i = kSmallest - 1; i >= kLargest; --i) {
    map = map.coarsened();
    shares.push_back(flatShare(map, points));
  }
  const double enough = kAlmost * *std::max_element(shares.begin(), shares.end());
  const auto smallest = std::find_if(
      shares.begin(), shares.end(), [&](double share) { return share >= enough; });
  return std::ldexp(options.voxel_size, static_cast<int>(smallest - shares.begin()));
}

bool
isSparse(const ScanPoints& points)
{
  constexpr double kFewPoints = 5e-4; // of all, in an interval that counts
  constexpr double kRing = 50.0;      // points of a ring
  constexpr double kFew = 0.15;
  std::map<BeamCalibration::Beam, std::size_t> counts;
  for (const BeamCalibration::Beam beam : BeamCalibration::beamsOf(points))
    ++counts[beam];
  const double least = kFewPoints * static_cast<double>(points.size());
  double rings = 0.0;
  double field = 0.0;
  std::optional<BeamCalibration::Beam> lowest;
  for (const auto& [beam, count] : counts) {
    if (!(static_cast<double>(count) > least))
      continue;
    lowest = lowest.value_or(beam);
    field = beam - *lowest + 1.0;
    rings += 1.0;
  }
  return rings > 0.0 && static_cast<double>(points.size()) >= kRing * rings &&
         rings < kFew * field;
}

VerticalTurn::VerticalTurn(double angle)
    : cosine_(std::cos(angle)), sine_(std::sin(angle))
{
}

Eigen::Vector3f
VerticalTurn::operator()(const Eigen::Vector3f& point) const
{
  const Eigen::Vector3d p = point.cast<double>();
  const double level = p.head<2>().norm();
  if (!(level > 0.0)) // straight up or down, or not finite
    return point;
  Eigen::Vector3d turned;
  turned.head<2>() = p.head<2>() * ((cosine_ * level - sine_ * p.z()) / level);
  turned.z() = sine_ * level + cosine_ * p.z();
  return turned.cast<float>();
}

void
correctVerticalAngle(ScanPoints& points, double angle)
{
  const VerticalTurn turn(angle);
  for (Eigen::Vector3f& point : points)
    point = turn(point);
}

std::vector<float>
timesByAzimuth(const ScanPoints& points)
{
  std::vector<float> times;
  times.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    times.push_back(0.5F -
                    std::atan2(point.y(), point.x()) / static_cast<float>(2.0 * kPi));
  return times;
}

void
deskew(ScanPoints& points,
       const std::vector<float>& times,
       const Eigen::Isometry3d& motion,
       double reference_time,
       int threads)
{
  if (times.size() != points.size())
    throw std::invalid_argument("deskew: one time per point is needed");
  // The motion within one step turns by less than a table of this size can tell.
  const Tangent velocity = logarithm(motion);
  std::vector<Eigen::Isometry3f, Eigen::aligned_allocator<Eigen::Isometry3f>> table;
  for (std::size_t i = 0; i <= kDeskewSteps; ++i) {
    const double time = static_cast<double>(i) / kDeskewSteps - reference_time;
    table.push_back(exponential(time * velocity).cast<float>());
  }
  const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const float time = std::min(std::max(times[i], 0.0F), 1.0F) * kDeskewSteps;
      const auto step = std::min(static_cast<std::size_t>(time), kDeskewSteps - 1);
      const float rest = time - static_cast<float>(step);
      points[i] = (1.0F - rest) * (table[step] * points[i]) +
                  rest * (table[step + 1] * points[i]);
    }
  };
  forChunks(points.size(), threads, work);
}

} // namespace nurbs
} // namespace pcl
