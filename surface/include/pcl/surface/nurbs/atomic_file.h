// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/exports.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

/** \brief An output file that appears under its name only when it is complete.
 *
 * Bytes go to a temporary beside the target; commit() flushes them to the disk and
 * renames. Whatever happens before that, an earlier file of that name stays as it was
 * and the temporary is removed. A target that is there and is no regular file (a pipe,
 * a device) is written directly, as there is nothing to replace.
 *
 * Not to be shared between threads; several files may be written at the same time.
 * \ingroup surface
 */
class PCL_NURBS_SURFACE_EXPORT AtomicFile {
public:
  /** \brief Open the temporary.
   * \param[in] path the final name; its folder must exist
   * \throws std::runtime_error "cannot write PATH: reason" */
  explicit AtomicFile(std::string path);

  /** \brief Discards what was written unless it was committed. */
  ~AtomicFile();

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile&
  operator=(const AtomicFile&) = delete;

  /** \brief Append bytes (buffered).
   * \throws std::runtime_error "cannot write PATH: reason", as for a full disk */
  void
  write(const void* data, std::size_t size);

  /** \brief Append text. */
  void
  write(std::string_view text)
  {
    write(text.data(), text.size());
  }

  /** \brief Flush to the disk and give the file its name. At most once.
   * \throws std::runtime_error "cannot write PATH: reason"; the target is then
   * untouched */
  void
  commit();

  /** \brief The final name. */
  const std::string&
  path() const
  {
    return path_;
  }

private:
  [[noreturn]] void
  fail(int error);

  void
  discard();

  std::string path_;
  std::string temporary_; // empty for a target that is written directly
  std::FILE* file_ = nullptr;
};

/** \brief Write a whole file at once with AtomicFile.
 * \throws std::runtime_error "cannot write PATH: reason"
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT void
writeFileAtomically(const std::string& path, std::string_view content);

} // namespace nurbs
} // namespace pcl
