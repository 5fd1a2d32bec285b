// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/reconstruction_statistics.h>

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {

ReconstructionStatistics
summarize(const Reconstruction& reconstruction)
{
  ReconstructionStatistics result;
  const bool any_held_out =
      std::find(reconstruction.held_out.begin(), reconstruction.held_out.end(), true) !=
      reconstruction.held_out.end();
  std::vector<double> distances;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t cell = 0; cell < reconstruction.labels.size(); ++cell) {
    if (reconstruction.labels[cell] == 0)
      continue;
    ++result.covered_points;
    if (any_held_out && !reconstruction.held_out[cell])
      continue;
    const double distance = std::abs(reconstruction.distances[cell]);
    distances.push_back(distance);
    sum += distance;
    squares += distance * distance;
  }
  result.measured_points = distances.size();
  if (distances.empty())
    return result;
  const double count = static_cast<double>(distances.size());
  result.rmse = std::sqrt(squares / count);
  result.mean = sum / count;
  const auto p95 =
      distances.begin() + static_cast<std::ptrdiff_t>(0.95 * (distances.size() - 1));
  std::nth_element(distances.begin(), p95, distances.end());
  result.p95 = *p95;
  result.max = *std::max_element(p95, distances.end());
  return result;
}

std::vector<double>
nearestDistances(const GridPoints& points,
                 const Reconstruction& reconstruction,
                 const std::vector<Eigen::Vector3d>& queries,
                 double radius)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  std::vector<float> values;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (reconstruction.labels[cell] != 0) {
      cloud->emplace_back(points.x[cell], points.y[cell], points.z[cell]);
      values.push_back(reconstruction.distances[cell]);
    }
  std::vector<double> result(queries.size(), std::numeric_limits<double>::quiet_NaN());
  if (cloud->empty())
    return result;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  pcl::Indices index(1);
  std::vector<float> squared(1);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    pcl::PointXYZ query;
    query.getVector3fMap() = queries[k].cast<float>();
    if (tree.nearestKSearch(query, 1, index, squared) > 0 &&
        squared[0] <= radius * radius)
      result[k] = values[static_cast<std::size_t>(index[0])];
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
