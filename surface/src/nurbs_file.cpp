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
constexpr NurbsSectionType kFileHeader{'f', 'i', 'l', 'e'}; // for messages only

std::string
nameOf(const NurbsSectionType& type)
{
  std::string name;
  for (char letter : type)
    name += letter >= 32 && letter < 127 ? letter : '?';
  return name;
}

std::vector<std::uint8_t>
headBytes(const std::string& frame_id)
{
  ByteWriter writer;
  writer.text(frame_id);
  return writer.bytes;
}

void
parseMetadata(const std::vector<std::uint8_t>& bytes,
              std::map<std::string, std::string>& metadata)
{
  ByteReader reader(bytes.data(), bytes.size());
  for (auto count = reader.integer<std::uint32_t>(); count > 0; --count) {
    std::string key = reader.text();
    metadata[std::move(key)] = reader.text();
  }
}

std::string
partName(const std::string& path)
{
  return path + ".part";
}

} // namespace

NurbsFileError::NurbsFileError(const std::string& path,
                               const std::string& section,
                               const std::string& reason)
    : std::runtime_error(path + ": section " + section + ": " + reason),
      section_(section)
{
}

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

NurbsFileReader::NurbsFileReader(std::string path, NurbsFileLimits limits)
    : path_(std::move(path)),
      limits_(limits),
      numbers_left_(limits.numbers),
      file_(path_, std::ios::binary | std::ios::ate)
{
  if (!file_)
    fail(kFileHeader, "cannot be opened");
  file_size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(file_.tellg(), 0));
  file_.seekg(0);
  std::array<std::uint8_t, kFileHeaderSize> header;
  if (file_size_ < header.size())
    fail(kFileHeader, "not a .nurbs file");
  readBytes(header.data(), header.size(), kFileHeader);
  const std::string problem = fileHeaderProblem(header);
  if (!problem.empty())
    fail(kFileHeader, problem);
}

void
NurbsFileReader::fail(const NurbsSectionType& type, const std::string& reason) const
{
  throw NurbsFileError(path_, nameOf(type), reason);
}

void
NurbsFileReader::readBytes(void* target, std::size_t size, const NurbsSectionType& type)
{
  file_.read(static_cast<char*>(target), static_cast<std::streamsize>(size));
  if (!file_)
    fail(type, "cannot be read to its end");
}

bool
NurbsFileReader::next(NurbsSection& section)
{
  if (finished_)
    return false;
  section.offset = static_cast<std::uint64_t>(file_.tellg());
  const std::uint64_t left = file_size_ - section.offset;
  if (left == 0)
    fail(kIndexSection, "is missing: the file was not finished");
  std::array<std::uint8_t, kSectionHeaderSize> header_bytes{};
  if (left < kSectionHeaderSize + kSectionCrcSize)
    fail({'?', '?', '?', '?'}, "ends too early");
  readBytes(header_bytes.data(), header_bytes.size(), kFileHeader);
  const SectionHeader header = parsedSectionHeader(header_bytes);
  section.type = header.type;
  if (header.stored_size > left - kSectionHeaderSize - kSectionCrcSize)
    fail(header.type, "ends too early");
  if (std::max(header.stored_size, header.size) > limits_.section_bytes)
    fail(header.type, "is larger than the limit allows");
  std::vector<std::uint8_t> stored(header.stored_size);
  readBytes(stored.data(), stored.size(), header.type);
  std::array<std::uint8_t, kSectionCrcSize> crc{};
  readBytes(crc.data(), crc.size(), header.type);
  if (ByteReader(crc.data(), crc.size()).integer<std::uint32_t>() !=
      sectionCrc(header_bytes, stored))
    fail(header.type, "check sum is wrong");
  try {
    section.bytes = unpackedSection(header, std::move(stored));
  } catch (const std::runtime_error& error) {
    fail(header.type, error.what());
  }
  finished_ = header.type == kIndexSection;
  if (finished_ && static_cast<std::uint64_t>(file_.tellg()) != file_size_)
    fail(header.type, "is followed by more bytes");
  return true;
}

void
NurbsFileReader::seek(std::uint64_t offset)
{
  if (offset < kFileHeaderSize || offset > file_size_)
    fail(kIndexSection, "points out of the file");
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset));
  finished_ = false;
}

std::vector<NurbsIndexEntry>
NurbsFileReader::index()
{
  constexpr std::size_t kTail = 8 + kSectionCrcSize;
  if (file_size_ < kFileHeaderSize + kSectionHeaderSize + kTail)
    fail(kIndexSection, "is missing: the file was not finished");
  seek(file_size_ - kTail);
  std::array<std::uint8_t, 8> offset{};
  readBytes(offset.data(), offset.size(), kIndexSection);
  seek(ByteReader(offset.data(), offset.size()).integer<std::uint64_t>());
  NurbsSection section;
  next(section);
  if (section.type != kIndexSection)
    fail(kIndexSection, "is missing: the file was not finished");
  seek(kFileHeaderSize);
  try {
    return parsedIndex(section.bytes);
  } catch (const std::exception& error) {
    fail(kIndexSection, error.what());
  }
}

void
NurbsFileReader::decode(const NurbsSection& section, SurfaceModel& model)
{
  try {
    if (section.type == kHeaderSection) {
      model.frame_id = ByteReader(section.bytes.data(), section.bytes.size()).text();
    }
    else if (section.type == kMetadataSection) {
      parseMetadata(section.bytes, model.metadata);
    }
    else if (section.type == kIndexSection) {
      static_cast<void>(parsedIndex(section.bytes));
    }
    else if (section.type == kPatchSection) {
      std::vector<SurfacePatch> patches = decodePatches(section.bytes, numbers_left_);
      std::move(patches.begin(), patches.end(), std::back_inserter(model.patches));
    }
  } catch (const std::exception& error) {
    fail(section.type, error.what());
  }
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

SurfaceModel
readNurbsFile(const std::string& path, const NurbsFileLimits& limits)
{
  NurbsFileReader reader(path, limits);
  SurfaceModel model;
  NurbsSection section;
  while (reader.next(section))
    reader.decode(section, model);
  return model;
}

SurfaceModel
recoverNurbsFile(const std::string& path,
                 std::string& damage,
                 const NurbsFileLimits& limits)
{
  NurbsFileReader reader(path, limits);
  SurfaceModel model;
  NurbsSection section;
  damage.clear();
  try {
    while (reader.next(section))
      reader.decode(section, model);
  } catch (const NurbsFileError& error) {
    damage = error.what();
  }
  return model;
}

} // namespace nurbs
} // namespace pcl
