// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>
#include <pcl/surface/nurbs/nurbs_file.h>

#include "nurbs_section.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Few enough to read one part of a map, enough for the models to learn. */
constexpr std::size_t kPatchesPerSection = 4096;

std::vector<std::uint8_t>
headBytes(const std::string& frame_id)
{
  ByteWriter writer;
  writer.text(frame_id);
  return writer.bytes;
}

std::string
partName(const std::string& path)
{
  return path + ".part";
}

} // namespace

NurbsFileWriter::NurbsFileWriter(std::string path,
                                 const std::string& frame_id,
                                 NurbsFileOptions options)
    : path_(std::move(path)), options_(options)
{
  options_.validate();
  file_.open(partName(path_), std::ios::binary | std::ios::trunc);
  writeBytes(fileHeader());
  writeBytes(packedSection(kHeaderSection, headBytes(frame_id), SectionPacking::None));
}

void
NurbsFileWriter::writeBytes(const std::vector<std::uint8_t>& bytes)
{
  file_.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  file_.flush();
  if (!file_)
    throw std::runtime_error("cannot write " + partName(path_));
  size_ += bytes.size();
}

void
NurbsFileWriter::appendPatches(const std::vector<SurfacePatch>& patches)
{
  const NurbsIndexEntry entry = indexEntry(patches, size_);
  writeBytes(packedSection(
      kPatchSection, encodePatches(patches, options_), SectionPacking::None));
  index_.push_back(entry);
}

void
NurbsFileWriter::appendMetadata(const std::map<std::string, std::string>& metadata)
{
  appendSection(kMetadataSection, metadataBytes(metadata));
}

void
NurbsFileWriter::appendSection(const NurbsSectionType& type,
                               const std::vector<std::uint8_t>& bytes)
{
  writeBytes(packedSection(type, bytes, SectionPacking::Zstd));
}

void
NurbsFileWriter::finish()
{
  writeBytes(
      packedSection(kIndexSection, indexBytes(index_, size_), SectionPacking::None));
  file_.close();
  std::error_code error;
  std::filesystem::rename(partName(path_), path_, error);
  if (!file_ || error)
    throw std::runtime_error("cannot write " + path_);
}

void
writeNurbsFile(const std::string& path,
               const SurfaceModel& model,
               const NurbsFileOptions& options)
{
  AtomicFile file(path);
  std::uint64_t size = 0;
  const auto write = [&](const std::vector<std::uint8_t>& bytes) {
    file.write(bytes.data(), bytes.size());
    size += bytes.size();
  };
  write(fileHeader());
  write(packedSection(kHeaderSection, headBytes(model.frame_id), SectionPacking::None));
  std::vector<NurbsIndexEntry> index;
  for (std::size_t i = 0; i < model.patches.size(); i += kPatchesPerSection) {
    const auto first = model.patches.begin() + static_cast<std::ptrdiff_t>(i);
    const std::size_t count = std::min(kPatchesPerSection, model.patches.size() - i);
    const std::vector<SurfacePatch> patches(first,
                                            first + static_cast<std::ptrdiff_t>(count));
    index.push_back(indexEntry(patches, size));
    write(packedSection(
        kPatchSection, encodePatches(patches, options), SectionPacking::None));
  }
  if (!model.metadata.empty())
    write(packedSection(
        kMetadataSection, metadataBytes(model.metadata), SectionPacking::Zstd));
  write(packedSection(kIndexSection, indexBytes(index, size), SectionPacking::None));
  file.commit();
}

} // namespace nurbs
} // namespace pcl
