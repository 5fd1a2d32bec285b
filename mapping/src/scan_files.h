// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/scan_readers.h>

#include <filesystem>
#include <optional>

namespace pcl {
namespace nurbs {

/** Faults of a data set: thrown, or collected to be skipped. */
class FaultList {
public:
  explicit FaultList(bool skip) : skip_(skip) {}

  void
  report(const std::filesystem::path& file, const std::string& reason);

  /** Run something that may throw an InputError. \return whether it did not */
  template <typename Action>
  bool
  attempt(const Action& action)
  {
    try {
      action();
      return true;
    } catch (const InputError& error) {
      if (!skip_)
        throw;
      lines_.emplace_back(error.what());
      return false;
    }
  }

  const std::vector<std::string>&
  lines() const
  {
    return lines_;
  }

private:
  bool skip_;
  std::vector<std::string> lines_;
};

/** One scan on disk. */
struct ScanFile {
  std::filesystem::path cloud;
  std::filesystem::path point_times; /**< empty for none */
  double stamp = 0.0;
  std::size_t line = 0;                   /**< its line in files of times and poses */
  std::optional<Eigen::Isometry3d> truth; /**< pose of the sensor */
};

/** What a layout was found to hold. */
struct ScanFiles {
  explicit ScanFiles(const ScanReadOptions& read_options);

  std::filesystem::path folder; /**< for messages */
  std::vector<ScanFile> scans;
  Eigen::Isometry3d calibration = Eigen::Isometry3d::Identity();
  ScanReadOptions options;
  FaultList faults;

  /** Give each scan its time of a list by its line; those without one are faults. */
  void
  setStamps(const std::vector<double>& times, const std::filesystem::path& source);

  /** Give each scan its pose of a list by its line; those without one are a fault. */
  void
  setTruth(const Trajectory& poses, const std::filesystem::path& source);

  /** Leave out what cannot be read and times that run backwards, and make the source.
   */
  std::unique_ptr<ScanSource>
  open();

private:
  void
  keepOnly(const std::vector<bool>& good);
};

/** Files of a folder with one of some extensions, by name; a folder that is missing is
 * an InputError. */
std::vector<std::filesystem::path>
filesIn(const std::filesystem::path& folder,
        const std::vector<std::string>& extensions);

/** The same; none is an InputError. */
std::vector<std::filesystem::path>
filesByName(const std::filesystem::path& folder,
            const std::vector<std::string>& extensions);

/** Words of each line of a text file that is not empty and no comment. */
std::vector<std::vector<std::string>>
wordsOf(const std::filesystem::path& file);

/** A finite number. \throws InputError naming the file */
double
numberOf(const std::filesystem::path& file, const std::string& word);

/** First number of each line, which must be its only one. */
std::vector<double>
readTimes(const std::filesystem::path& file);

} // namespace nurbs
} // namespace pcl
