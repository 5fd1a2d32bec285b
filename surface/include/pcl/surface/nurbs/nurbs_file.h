// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The project's own file format; doc/file_format.md describes every byte.

#pragma once

#include <pcl/surface/nurbs/surface_model.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A .nurbs file that cannot be read: what() names file, section and reason. */
class PCL_NURBS_SURFACE_EXPORT NurbsFileError : public std::runtime_error {
public:
  NurbsFileError(const std::string& path,
                 const std::string& section,
                 const std::string& reason);

  const std::string&
  section() const
  {
    return section_;
  }

private:
  std::string section_;
};

/** \brief How patches are written.
 *
 * Quantised, control values are rounded to multiples of a step D. A uniform rounding
 * error has the variance D^2 / 12; points of the surface are means of control values,
 * and the coarser frame of a patch adds at most 0.035 D^2, so the mean square distance
 * grows by at most 0.124 D^2. With D = rmse sqrt(5 ((1 + share)^2 - 1)) the root mean
 * square distance grows by less than the share: about 6 % of the 10 % by default. */
struct NurbsFileOptions {
  bool lossless = false; /**< keep every bit */

  /** \brief Allowed relative growth of the root mean square distance. */
  double rmse_share = 0.1;

  /** \brief Step of control values in metres; 0: from each patch's rmse, or its noise
   * where it has no rmse, or default_step where it has neither. */
  double step = 0.0;
  double default_step = 1e-4; /**< metres */

  /** \brief Spacing of trimming corners as a multiple of the step. */
  double trim_factor = 2.0;

  /** \throws std::invalid_argument naming the option that is out of range */
  void
  validate() const;

  /** \brief Upper bound of the quantisation step of a patch, in metres. */
  double
  stepFor(const PatchQuality& quality) const;
};

/** \brief What a reader accepts, so that no file makes it exhaust the memory. */
struct NurbsFileLimits {
  std::uint64_t section_bytes = 1ULL << 28; /**< largest section, packed or not */

  /** \brief Sum of control points, knots and trimming corners of a file, a patch
   * counting for 64 more. */
  std::uint64_t numbers = 1ULL << 23;
};

/** \brief Type of a section: four ASCII characters. */
using NurbsSectionType = std::array<char, 4>;

constexpr NurbsSectionType kHeaderSection{'H', 'E', 'A', 'D'};
constexpr NurbsSectionType kPatchSection{'P', 'T', 'C', 'H'};
constexpr NurbsSectionType kMetadataSection{'M', 'E', 'T', 'A'};
constexpr NurbsSectionType kIndexSection{'I', 'N', 'D', 'X'};

/** \brief A section with its bytes unpacked. */
struct NurbsSection {
  NurbsSectionType type{};
  std::uint64_t offset = 0; /**< of its first byte in the file */
  std::vector<std::uint8_t> bytes;
};

/** \brief Where the patches of one section are. */
struct NurbsIndexEntry {
  std::uint64_t offset = 0;
  std::uint32_t patches = 0;
  Eigen::Vector3f low = Eigen::Vector3f::Zero();  /**< box of the control points, */
  Eigen::Vector3f high = Eigen::Vector3f::Zero(); /**< rounded outwards */
};

/** \brief Patches in the coding of a patch section: for formats that embed them.
 * \throws std::invalid_argument for options or trimming loops that cannot be coded */
PCL_NURBS_SURFACE_EXPORT std::vector<std::uint8_t>
encodePatches(const std::vector<SurfacePatch>& patches,
              const NurbsFileOptions& options);

/** \brief Inverse of encodePatches().
 * \param[in] bytes untrusted
 * \param[in,out] numbers what the bytes may still ask for, see NurbsFileLimits::numbers
 * \throws std::exception-derived if the bytes are no patches or ask for more */
PCL_NURBS_SURFACE_EXPORT std::vector<SurfacePatch>
decodePatches(const std::vector<std::uint8_t>& bytes, std::uint64_t& numbers);

/** \brief Writes a file section by section while the model grows.
 *
 * Sections go to PATH.part, each handed to the operating system when it is complete;
 * finish() adds the index and renames to PATH. After a crash PATH.part holds all
 * sections that were complete and recoverNurbsFile() reads them. */
class PCL_NURBS_SURFACE_EXPORT NurbsFileWriter {
public:
  /** \throws std::runtime_error if the file cannot be written, std::invalid_argument
   * for options out of range */
  NurbsFileWriter(std::string path,
                  const std::string& frame_id,
                  NurbsFileOptions options = {});

  NurbsFileWriter(const NurbsFileWriter&) = delete;
  NurbsFileWriter&
  operator=(const NurbsFileWriter&) = delete;

  /** \brief Append a section of patches. */
  void
  appendPatches(const std::vector<SurfacePatch>& patches);

  /** \brief Append metadata; a key that comes again replaces the earlier one. */
  void
  appendMetadata(const std::map<std::string, std::string>& metadata);

  /** \brief Append a section of another type, zstd-packed where that is shorter.
   * Readers that do not know the type skip it. */
  void
  appendSection(const NurbsSectionType& type, const std::vector<std::uint8_t>& bytes);

  /** \brief Write the index and give the file its name. Nothing can be appended after.
   */
  void
  finish();

private:
  void
  writeBytes(const std::vector<std::uint8_t>& bytes);

  std::string path_;
  NurbsFileOptions options_;
  std::ofstream file_;
  std::uint64_t size_ = 0;
  std::vector<NurbsIndexEntry> index_;
};

/** \brief Reads a file section by section. */
class PCL_NURBS_SURFACE_EXPORT NurbsFileReader {
public:
  /** \throws NurbsFileError if the file cannot be opened or is no .nurbs file of a
   * version that can be read */
  explicit NurbsFileReader(std::string path, NurbsFileLimits limits = {});

  /** \brief Read the next section, known or not.
   * \return false at the end of a complete file (after its index)
   * \throws NurbsFileError if it is damaged, or the file ends without an index */
  bool
  next(NurbsSection& section);

  /** \brief Continue with the section at \a offset (from the index). */
  void
  seek(std::uint64_t offset);

  /** \brief Read the index of a complete file without its patches; next() then starts
   * at the first section.
   * \throws NurbsFileError if there is none */
  std::vector<NurbsIndexEntry>
  index();

  /** \brief Decode what next() gave into \a model; sections of unknown type are left
   * alone.
   * \throws NurbsFileError if the bytes are invalid */
  void
  decode(const NurbsSection& section, SurfaceModel& model);

private:
  [[noreturn]] void
  fail(const NurbsSectionType& type, const std::string& reason) const;

  /** \brief Bytes and type of the section that starts here. */
  std::vector<std::uint8_t>
  readStored(NurbsSection& section);

  void
  readBytes(void* target, std::size_t size, const NurbsSectionType& type);

  std::string path_;
  NurbsFileLimits limits_;
  std::uint64_t numbers_left_;
  std::ifstream file_;
  std::uint64_t file_size_ = 0;
  bool finished_ = false;
};

/** \brief Write a whole model; nothing appears under \a path before it is complete.
 * \throws std::runtime_error if the file cannot be written, std::invalid_argument for
 * options or trimming loops that cannot be coded */
PCL_NURBS_SURFACE_EXPORT void
writeNurbsFile(const std::string& path,
               const SurfaceModel& model,
               const NurbsFileOptions& options = {});

/** \brief Read a complete file.
 * \throws NurbsFileError if anything is wrong with it */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
readNurbsFile(const std::string& path, const NurbsFileLimits& limits = {});

/** \brief Read what is intact up to the first damage, as after a crash.
 * \param[in] path file to read
 * \param[out] damage what() of the damage; empty if the file is complete
 * \param[in] limits what to accept
 * \throws NurbsFileError if it is no .nurbs file at all */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
recoverNurbsFile(const std::string& path,
                 std::string& damage,
                 const NurbsFileLimits& limits = {});

} // namespace nurbs
} // namespace pcl
