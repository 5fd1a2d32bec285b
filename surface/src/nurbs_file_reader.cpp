// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_file.h>

#include "nurbs_section.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

// For messages only:
constexpr NurbsSectionType kFileHeader{'f', 'i', 'l', 'e'};
constexpr NurbsSectionType kSomeSection{'?', '?', '?', '?'};

std::string
nameOf(const NurbsSectionType& type)
{
  std::string name;
  for (char letter : type)
    name += letter >= 32 && letter < 127 ? letter : '?';
  return name;
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

} // namespace

NurbsFileError::NurbsFileError(const std::string& path,
                               const std::string& section,
                               const std::string& reason)
    : std::runtime_error(path + ": section " + section + ": " + reason),
      section_(section)
{
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

std::vector<std::uint8_t>
NurbsFileReader::readStored(NurbsSection& section)
{
  const std::uint64_t left = file_size_ - section.offset;
  std::array<std::uint8_t, kSectionHeaderSize> header_bytes{};
  if (left < kSectionHeaderSize + kSectionCrcSize)
    fail(kSomeSection, "ends too early");
  readBytes(header_bytes.data(), header_bytes.size(), kSomeSection);
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
    return unpackedSection(header, std::move(stored));
  } catch (const std::runtime_error& error) {
    fail(header.type, error.what());
  }
}

bool
NurbsFileReader::next(NurbsSection& section)
{
  if (finished_)
    return false;
  section.offset = static_cast<std::uint64_t>(file_.tellg());
  if (section.offset == file_size_)
    fail(kIndexSection, "is missing: the file was not finished");
  section.bytes = readStored(section);
  finished_ = section.type == kIndexSection;
  if (finished_ && static_cast<std::uint64_t>(file_.tellg()) != file_size_)
    fail(section.type, "is followed by more bytes");
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
