// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "nurbs_section.h"

#include <boost/crc.hpp>

#include <zstd.h>

#include <algorithm>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kZstdLevel = 19;
constexpr std::size_t kIndexEntrySize = 8 + 4 + 6 * 4;

std::uint32_t
crcOf(const std::uint8_t* bytes, std::size_t size)
{
  boost::crc_32_type crc;
  crc.process_bytes(bytes, size);
  return crc.checksum();
}

/** Empty if that is not shorter. */
std::vector<std::uint8_t>
zstdPacked(const std::vector<std::uint8_t>& bytes)
{
  std::vector<std::uint8_t> packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(
      packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0 || size >= bytes.size())
    return {};
  packed.resize(size);
  return packed;
}

} // namespace

std::vector<std::uint8_t>
fileHeader()
{
  ByteWriter writer;
  writer.raw(kNurbsMagic.data(), kNurbsMagic.size());
  writer.integer(kNurbsMajor);
  writer.integer(kNurbsMinor);
  writer.integer(crcOf(writer.bytes.data(), writer.bytes.size()));
  return writer.bytes;
}

std::string
fileHeaderProblem(const std::array<std::uint8_t, kFileHeaderSize>& bytes)
{
  if (!std::equal(kNurbsMagic.begin(), kNurbsMagic.end(), bytes.begin()))
    return "not a .nurbs file";
  ByteReader reader(bytes.data() + kNurbsMagic.size(), 8);
  const auto major = reader.integer<std::uint16_t>();
  reader.integer<std::uint16_t>(); // minor versions only add sections
  if (reader.integer<std::uint32_t>() != crcOf(bytes.data(), kFileHeaderSize - 4))
    return "check sum is wrong";
  if (major != kNurbsMajor)
    return "version " + std::to_string(major) + " is not known";
  return {};
}

std::vector<std::uint8_t>
packedSection(const NurbsSectionType& type,
              const std::vector<std::uint8_t>& bytes,
              SectionPacking packing)
{
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("a section of a .nurbs file is larger than 4 GiB");
  std::vector<std::uint8_t> packed;
  if (packing == SectionPacking::Zstd)
    packed = zstdPacked(bytes);
  const SectionPacking used = packed.empty() ? SectionPacking::None : packing;
  const std::vector<std::uint8_t>& stored = packed.empty() ? bytes : packed;
  ByteWriter writer;
  writer.raw(type.data(), type.size());
  writer.integer(static_cast<std::uint32_t>(used));
  writer.integer(static_cast<std::uint32_t>(stored.size()));
  writer.integer(static_cast<std::uint32_t>(bytes.size()));
  writer.raw(stored.data(), stored.size());
  writer.integer(crcOf(writer.bytes.data(), writer.bytes.size()));
  return writer.bytes;
}

SectionHeader
parsedSectionHeader(const std::array<std::uint8_t, kSectionHeaderSize>& bytes)
{
  SectionHeader header;
  std::copy_n(bytes.begin(), header.type.size(), header.type.begin());
  ByteReader reader(bytes.data() + header.type.size(), 12);
  header.packing = reader.integer<std::uint32_t>();
  header.stored_size = reader.integer<std::uint32_t>();
  header.size = reader.integer<std::uint32_t>();
  return header;
}

std::uint32_t
sectionCrc(const std::array<std::uint8_t, kSectionHeaderSize>& header,
           const std::vector<std::uint8_t>& stored)
{
  boost::crc_32_type crc;
  crc.process_bytes(header.data(), header.size());
  crc.process_bytes(stored.data(), stored.size());
  return crc.checksum();
}

std::vector<std::uint8_t>
unpackedSection(const SectionHeader& header, std::vector<std::uint8_t> stored)
{
  if (header.packing == static_cast<std::uint32_t>(SectionPacking::None)) {
    if (header.size != stored.size())
      throw std::runtime_error("sizes do not agree");
    return stored;
  }
  if (header.packing != static_cast<std::uint32_t>(SectionPacking::Zstd))
    throw std::runtime_error("packing " + std::to_string(header.packing) +
                             " is not known");
  if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != header.size)
    throw std::runtime_error("sizes do not agree");
  std::vector<std::uint8_t> bytes(header.size);
  const std::size_t size =
      ZSTD_decompress(bytes.data(), bytes.size(), stored.data(), stored.size());
  if (ZSTD_isError(size) != 0 || size != bytes.size())
    throw std::runtime_error("packed bytes are invalid");
  return bytes;
}

std::vector<std::uint8_t>
metadataBytes(const std::map<std::string, std::string>& metadata)
{
  ByteWriter writer;
  writer.integer(static_cast<std::uint32_t>(metadata.size()));
  for (const auto& [key, value] : metadata) {
    writer.text(key);
    writer.text(value);
  }
  return writer.bytes;
}

std::vector<std::uint8_t>
indexBytes(const std::vector<NurbsIndexEntry>& index, std::uint64_t offset)
{
  ByteWriter writer;
  writer.integer(static_cast<std::uint32_t>(index.size()));
  for (const NurbsIndexEntry& entry : index) {
    writer.integer(entry.offset);
    writer.integer(entry.patches);
    for (const Eigen::Vector3f& corner : {entry.low, entry.high})
      for (int d = 0; d < 3; ++d)
        writer.real(corner(d));
  }
  writer.integer(offset);
  return writer.bytes;
}

std::vector<NurbsIndexEntry>
parsedIndex(const std::vector<std::uint8_t>& bytes)
{
  ByteReader reader(bytes.data(), bytes.size());
  const auto count = reader.integer<std::uint32_t>();
  if (reader.left() != count * kIndexEntrySize + 8)
    throw std::runtime_error("wrong number of entries");
  std::vector<NurbsIndexEntry> index(count);
  for (NurbsIndexEntry& entry : index) {
    entry.offset = reader.integer<std::uint64_t>();
    entry.patches = reader.integer<std::uint32_t>();
    for (Eigen::Vector3f* corner : {&entry.low, &entry.high})
      for (int d = 0; d < 3; ++d)
        (*corner)(d) = reader.real();
  }
  return index;
}

NurbsIndexEntry
indexEntry(const std::vector<SurfacePatch>& patches, std::uint64_t offset)
{
  NurbsIndexEntry entry;
  entry.offset = offset;
  entry.patches = static_cast<std::uint32_t>(patches.size());
  if (patches.empty())
    return entry;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity);
  Eigen::Vector3d high = -low;
  for (const SurfacePatch& patch : patches) {
    const auto& points = patch.geometry.surface().homogeneousPoints();
    const Eigen::Matrix3Xd cartesian = points.colwise().hnormalized();
    low = low.cwiseMin(cartesian.rowwise().minCoeff());
    high = high.cwiseMax(cartesian.rowwise().maxCoeff());
  }
  for (int d = 0; d < 3; ++d) {
    entry.low(d) = std::nextafter(static_cast<float>(low(d)), -kInfinity);
    entry.high(d) = std::nextafter(static_cast<float>(high(d)), kInfinity);
  }
  return entry;
}

} // namespace nurbs
} // namespace pcl
