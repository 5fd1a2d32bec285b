// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "labels_file.h"

#include "common_options.h"

#include <cstring>

namespace pcl_nurbs_tools {
namespace {

template <typename Value>
void
append(std::string& bytes, Value value)
{
  const std::size_t end = bytes.size();
  bytes.resize(end + sizeof(Value));
  std::memcpy(&bytes[end], &value, sizeof(Value));
}

/** Points and labels one after the other, coordinates as \a Real. */
template <typename Real>
void
appendRecords(std::string& bytes,
              const pcl::PointCloud<pcl::PointXYZ>& cloud,
              const Eigen::Vector3d& offset,
              const std::vector<std::uint32_t>& labels)
{
  bytes.reserve(bytes.size() + cloud.size() * (3 * sizeof(Real) + 4));
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const Eigen::Vector3d point = cloud[k].getVector3fMap().cast<double>() + offset;
    for (const double coordinate : point)
      append(bytes, static_cast<Real>(coordinate));
    append(bytes, labels[k]);
  }
}

} // namespace

void
writeLabels(const std::string& path,
            const pcl::PointCloud<pcl::PointXYZ>& cloud,
            const Eigen::Vector3d& offset,
            const std::vector<std::uint32_t>& labels)
{
  const std::string size = offset.isZero() ? "4" : "8";
  std::string text =
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "VERSION 0.7\nFIELDS x y z label\nSIZE " +
      size + ' ' + size + ' ' + size + " 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " +
      std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) +
      "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(cloud.size()) +
      "\nDATA binary\n";
  if (offset.isZero())
    appendRecords<float>(text, cloud, offset, labels);
  else // the coordinates are too large for single precision
    appendRecords<double>(text, cloud, offset, labels);
  writeText(path, text);
}

} // namespace pcl_nurbs_tools
