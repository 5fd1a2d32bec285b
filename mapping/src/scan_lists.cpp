// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "input_file.h"
#include "scan_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kLargestList = std::size_t{1} << 30U;

} // namespace

std::vector<std::filesystem::path>
filesIn(const std::filesystem::path& folder, const std::vector<std::string>& extensions)
{
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(folder.string(), "is not a folder");
  std::vector<std::filesystem::path> result;
  for (std::filesystem::directory_iterator entry(folder, error), end;
       !error && entry != end;
       entry.increment(error))
    if (std::find(extensions.begin(),
                  extensions.end(),
                  entry->path().extension().string()) != extensions.end())
      result.push_back(entry->path());
  if (error)
    throw InputError(folder.string(), error.message());
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::filesystem::path>
filesByName(const std::filesystem::path& folder,
            const std::vector<std::string>& extensions)
{
  std::vector<std::filesystem::path> result = filesIn(folder, extensions);
  if (result.empty())
    throw InputError(folder.string(), "holds no scan");
  return result;
}

std::vector<std::vector<std::string>>
wordsOf(const std::filesystem::path& file)
{
  std::istringstream lines(loadInputFile(file.string(), kLargestList).bytes);
  std::vector<std::vector<std::string>> result;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream stream(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
      words.push_back(word);
    if (!words.empty())
      result.push_back(std::move(words));
  }
  return result;
}

double
numberOf(const std::filesystem::path& file, const std::string& word)
{
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    throw InputError(file.string(), quotedWord(word) + " is not a finite number");
  return value;
}

std::vector<double>
readTimes(const std::filesystem::path& file)
{
  std::vector<double> times;
  for (const std::vector<std::string>& words : wordsOf(file)) {
    if (words.size() != 1)
      throw InputError(file.string(),
                       "line " + std::to_string(times.size() + 1) +
                           " has more than one time");
    times.push_back(numberOf(file, words[0]));
  }
  return times;
}

} // namespace nurbs
} // namespace pcl
