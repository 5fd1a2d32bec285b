// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What reads must write and read again to as many patches.

#include <pcl/surface/nurbs/obj_io.h>

#include <cstdint>
#include <cstdlib>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pcl::nurbs;
  SurfaceModel model;
  try {
    model = fromObj({reinterpret_cast<const char*>(data), size});
  } catch (const ObjIoError&) {
    return 0; // refused, as it should be
  }
  std::string text;
  try {
    text = toObj(model);
    if (fromObj(text).patches.size() != model.patches.size())
      std::abort();
  } catch (const ObjIoError&) {
    // weights near the ends of the number range: points overflow
  }
  return 0;
}
