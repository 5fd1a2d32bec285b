// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

[[noreturn]] void
throwCannotWrite(const std::string& path, int error)
{
  throw std::runtime_error("cannot write " + path + ": " +
                           std::generic_category().message(error));
}

// Unlike mkstemp() this leaves the permissions to the user's umask.
int
openBeside(const std::string& path, std::string& temporary)
{
  static std::atomic<unsigned> counter{0};
  const std::string stem = path + ".tmp" + std::to_string(::getpid()) + '-';
  int descriptor = -1;
  do {
    temporary = stem + std::to_string(counter++);
    descriptor = ::open(
        temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_t{0666});
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

} // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path))
{
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode))
    throwCannotWrite(path_, EISDIR);
  const bool direct = exists && !S_ISREG(status.st_mode);
  const int descriptor = direct ? ::open(path_.c_str(), O_WRONLY | O_CLOEXEC)
                                : openBeside(path_, temporary_);
  if (descriptor < 0)
    throwCannotWrite(path_, errno);
  file_ = ::fdopen(descriptor, "wb");
  if (file_ == nullptr) {
    const int error = errno;
    ::close(descriptor);
    fail(error);
  }
  // The new file takes the place of the old one, so it keeps its permissions.
  if (exists && !direct && ::fchmod(descriptor, status.st_mode & 07777U) != 0)
    fail(errno);
}

AtomicFile::~AtomicFile()
{
  discard();
}

void
AtomicFile::write(const void* data, std::size_t size)
{
  if (file_ == nullptr)
    fail(EBADF);
  errno = 0;
  if (std::fwrite(data, 1, size, file_) != size)
    fail(errno != 0 ? errno : EIO);
}

void
AtomicFile::commit()
{
  if (file_ == nullptr)
    fail(EBADF);
  if (std::fflush(file_) != 0)
    fail(errno);
  if (!temporary_.empty() && ::fsync(::fileno(file_)) != 0)
    fail(errno);
  if (std::fclose(std::exchange(file_, nullptr)) != 0)
    fail(errno);
  if (!temporary_.empty() && std::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail(errno);
  temporary_.clear();
}

void
AtomicFile::fail(int error)
{
  discard();
  throwCannotWrite(path_, error);
}

void
AtomicFile::discard()
{
  if (file_ != nullptr)
    std::fclose(std::exchange(file_, nullptr));
  if (!temporary_.empty())
    ::unlink(temporary_.c_str());
  temporary_.clear();
}

void
writeFileAtomically(const std::string& path, std::string_view content)
{
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

} // namespace nurbs
} // namespace pcl
