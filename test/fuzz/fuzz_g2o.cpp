// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What reads must come back as the same text, and as the same graph without its rows.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/pose_graph_io.h>

#include <cstdint>
#include <cstdlib>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pcl::nurbs;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const G2oGraph read = parseG2o(text, "input");
    if (toG2o(read.graph, read.layout.get()) != text)
      std::abort();
    const std::string plain = toG2o(read.graph);
    const G2oGraph again = parseG2o(plain, "again");
    if (again.graph.factors().size() > read.graph.factors().size())
      std::abort();
  } catch (const InputError&) {
    // refused, as it should be; without rows, a graph of nodes without poses is empty
  }
  return 0;
}
