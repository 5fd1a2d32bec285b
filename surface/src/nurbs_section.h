// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Frame of a .nurbs file: file header, section headers, packing, check sums.

#pragma once

#include <pcl/surface/nurbs/nurbs_file.h>

#include "byte_stream.h"

namespace pcl {
namespace nurbs {

constexpr std::array<std::uint8_t, 8> kNurbsMagic{
    0x89, 'N', 'R', 'B', '\r', '\n', 0x1A, '\n'};
constexpr std::uint16_t kNurbsMajor = 1; // readers refuse a higher one
constexpr std::uint16_t kNurbsMinor = 0; // readers accept any
constexpr std::size_t kFileHeaderSize = 16;
constexpr std::size_t kSectionHeaderSize = 16;
constexpr std::size_t kSectionCrcSize = 4;

enum class SectionPacking : std::uint32_t { None = 0, Zstd = 1 };

/** \brief What stands before the bytes of a section. */
struct SectionHeader {
  NurbsSectionType type{};
  std::uint32_t packing = 0;
  std::uint32_t stored_size = 0;
  std::uint32_t size = 0; // unpacked
};

std::vector<std::uint8_t>
fileHeader();

/** \brief Empty if the bytes are the header of a file that can be read, else why not.
 */
std::string
fileHeaderProblem(const std::array<std::uint8_t, kFileHeaderSize>& bytes);

/** \brief The whole section: header, bytes and check sum. */
std::vector<std::uint8_t>
packedSection(const NurbsSectionType& type,
              const std::vector<std::uint8_t>& bytes,
              SectionPacking packing);

SectionHeader
parsedSectionHeader(const std::array<std::uint8_t, kSectionHeaderSize>& bytes);

/** \brief Check sum over header and stored bytes. */
std::uint32_t
sectionCrc(const std::array<std::uint8_t, kSectionHeaderSize>& header,
           const std::vector<std::uint8_t>& stored);

/** \throws std::runtime_error if they do not unpack to the size of the header */
std::vector<std::uint8_t>
unpackedSection(const SectionHeader& header, std::vector<std::uint8_t> stored);

std::vector<std::uint8_t>
metadataBytes(const std::map<std::string, std::string>& metadata);

/** \brief Index section; its last 8 bytes are its own offset, so that it is found from
 * the end of the file. */
std::vector<std::uint8_t>
indexBytes(const std::vector<NurbsIndexEntry>& index, std::uint64_t offset);

/** \throws std::exception-derived if the bytes are no index */
std::vector<NurbsIndexEntry>
parsedIndex(const std::vector<std::uint8_t>& bytes);

/** \brief Entry for a section of these patches. */
NurbsIndexEntry
indexEntry(const std::vector<SurfacePatch>& patches, std::uint64_t offset);

} // namespace nurbs
} // namespace pcl
