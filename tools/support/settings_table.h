// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/program_options/options_description.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace pcl_nurbs_tools {

/** A value for a setting, as text, and where it was found. */
struct GivenSetting {
  std::string key;
  std::string text;
  int line = 0; /**< in a file, from 1 */
};

/** Settings of a program by name, for options of the command line, YAML files and
 * reports alike.
 *
 * A key is a name or GROUP.NAME, words joined by '_'; its option is the same with '-'.
 */
class SettingsTable {
public:
  /** Where a setting's value is kept; must outlive the table. */
  using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::string*>;

  void
  add(const std::string& key, Target target, const std::string& description);

  /** Set a value. \throws std::invalid_argument "there is no setting KEY" or why the
   * text is no value for it */
  void
  set(const GivenSetting& given) const;

  /** Describe the options of a group (empty: of settings without one).
   * \param[out] given gets those of the command line when it has been parsed */
  void
  describe(const std::string& group,
           boost::program_options::options_description& description,
           std::vector<GivenSetting>& given) const;

  /** All values as YAML, with their descriptions as comments. */
  std::string
  yaml() const;

  /** All values, groups as objects. */
  nlohmann::json
  json() const;

private:
  struct Setting {
    std::string group;
    std::string name;
    Target target;
    std::string description;

    std::string
    key() const
    {
      return group.empty() ? name : group + '.' + name;
    }
  };

  std::vector<Setting> settings_;
};

/** Settings of a YAML file, at most one level of groups.
 * \throws pcl::nurbs::InputError naming file and line */
std::vector<GivenSetting>
readSettings(const std::string& path);

/** Set all values of a YAML file.
 * \throws pcl::nurbs::InputError naming file, line and reason */
void
applySettings(const SettingsTable& table,
              const std::string& path,
              const std::vector<GivenSetting>& settings);

} // namespace pcl_nurbs_tools
