// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// First byte even: the rest is a patch section, past the check sum. What decodes must
// encode and decode again. First byte odd: the rest is a file.

#include <pcl/surface/nurbs/nurbs_file.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

using namespace pcl::nurbs;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kNumbers = 20000; // small, so that no input takes long

void
decodeAndEncode(const Bytes& bytes)
{
  std::vector<SurfacePatch> patches;
  try {
    std::uint64_t numbers = kNumbers;
    patches = decodePatches(bytes, numbers);
  } catch (const std::exception&) {
    return; // refused, as it should be
  }
  NurbsFileOptions options;
  for (bool lossless : {true, false}) {
    options.lossless = lossless;
    std::uint64_t numbers = 8 * kNumbers;
    const Bytes again = encodePatches(patches, options);
    if (decodePatches(again, numbers).size() != patches.size())
      std::abort();
  }
}

void
readFile(const Bytes& bytes)
{
  static const std::string path =
      (std::filesystem::temp_directory_path() /
       ("fuzz" + std::to_string(std::random_device{}()) + ".nurbs"))
          .string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  NurbsFileLimits limits;
  limits.section_bytes = 1 << 20;
  limits.numbers = kNumbers;
  std::string damage;
  try {
    static_cast<void>(recoverNurbsFile(path, damage, limits));
    static_cast<void>(NurbsFileReader(path, limits).index());
  } catch (const NurbsFileError&) {
    // the only error a reader may raise
  }
  std::filesystem::remove(path);
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
    return 0;
  const Bytes bytes(data + 1, data + size);
  if (data[0] % 2 == 0)
    decodeAndEncode(bytes);
  else
    readFile(bytes);
  return 0;
}
