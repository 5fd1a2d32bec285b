// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "labels_file.h"

#include "common_options.h"

#include <cstring>

namespace pcl_nurbs_tools {

void
writeLabels(const std::string& path,
            const pcl::PointCloud<pcl::PointXYZ>& cloud,
            const std::vector<std::uint32_t>& labels)
{
  struct Record {
    float x, y, z;
    std::uint32_t label;
  };
  const std::string count = std::to_string(cloud.size());
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n"
                     "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\n"
                     "COUNT 1 1 1 1\nWIDTH " +
                     std::to_string(cloud.width) + "\nHEIGHT " +
                     std::to_string(cloud.height) +
                     "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  const std::size_t header = text.size();
  text.resize(header + cloud.size() * sizeof(Record));
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const Record record{cloud[k].x, cloud[k].y, cloud[k].z, labels[k]};
    std::memcpy(&text[header + k * sizeof(Record)], &record, sizeof(Record));
  }
  writeText(path, text);
}

} // namespace pcl_nurbs_tools
