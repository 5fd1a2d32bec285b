// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings_table.h"

#include <pcl/mapping/cloud_reader.h>

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

using pcl::nurbs::InputError;

/** Collects the scalars of a YAML file. */
class Collector {
public:
  explicit Collector(const std::string& path) : path_(path) {}

  [[noreturn]] void
  fail(const YAML::Mark& mark, const std::string& reason) const
  {
    throw InputError(path_, "line " + std::to_string(mark.line + 1) + ": " + reason);
  }

  void
  addMap(const YAML::Node& map, const std::string& prefix)
  {
    for (const auto& entry : map) {
      const YAML::Node& name = entry.first;
      const YAML::Node& value = entry.second;
      if (!name.IsScalar())
        fail(name.Mark(), "a setting has a name");
      const std::string key = prefix + name.Scalar();
      if (value.IsMap() && prefix.empty())
        addMap(value, key + '.');
      else if (value.IsScalar())
        addScalar(key, value, name.Mark());
      else
        fail(name.Mark(), key + " has no single value");
    }
  }

  std::vector<GivenSetting> settings;

private:
  void
  addScalar(const std::string& key, const YAML::Node& value, const YAML::Mark& mark)
  {
    if (!keys_.insert(key).second)
      fail(mark, key + " is there twice");
    settings.push_back({key, value.Scalar(), mark.line + 1});
  }

  const std::string& path_;
  std::set<std::string> keys_;
};

} // namespace

std::vector<GivenSetting>
readSettings(const std::string& path)
{
  constexpr std::uintmax_t kLargest = std::uintmax_t{1} << 20U;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(path, error ? error.message() : "is not a file");
  if (std::filesystem::file_size(path, error) > kLargest)
    throw InputError(path, "is too large for a file of settings");
  Collector collector(path);
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (!root.IsMap() && !root.IsNull())
      collector.fail(root.Mark(), "holds no settings (name: value)");
    collector.addMap(root, "");
  } catch (const YAML::BadFile&) {
    throw InputError(path, "cannot be read");
  } catch (const YAML::Exception& problem) {
    collector.fail(problem.mark, problem.msg);
  }
  return collector.settings;
}

void
applySettings(const SettingsTable& table,
              const std::string& path,
              const std::vector<GivenSetting>& settings)
{
  for (const GivenSetting& setting : settings) {
    try {
      table.set(setting);
    } catch (const std::invalid_argument& problem) {
      throw InputError(path,
                       "line " + std::to_string(setting.line) + ": " + problem.what());
    }
  }
}

} // namespace pcl_nurbs_tools
