// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What reads must write and read again to as many patches.

#include <pcl/surface/nurbs/json_io.h>

#include <cstdint>
#include <cstdlib>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pcl::nurbs;
  SurfaceModel model;
  try {
    model = fromJson({reinterpret_cast<const char*>(data), size});
  } catch (const JsonIoError&) {
    return 0; // refused, as it should be
  }
  std::string text;
  try {
    text = toJson(model);
    if (fromJson(text).patches.size() != model.patches.size())
      std::abort();
  } catch (const JsonIoError&) {
    // weights near the ends of the number range: points overflow
  }
  return 0;
}
