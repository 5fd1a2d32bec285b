// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings_table.h"

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;

template <typename Number>
Number
numberOf(const GivenSetting& given, const char* kind)
{
  Number value{};
  const std::string& text = given.text;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  if (!whole || !std::isfinite(static_cast<double>(value)))
    throw std::invalid_argument(given.key + " must be " + kind + ", not \"" + text +
                                '"');
  return value;
}

/** Parses a text by the type of the target. */
struct Parser {
  const GivenSetting& given;

  void
  operator()(bool* target) const
  {
    if (given.text != "true" && given.text != "false")
      throw std::invalid_argument(given.key + " must be true or false, not \"" +
                                  given.text + '"');
    *target = given.text == "true";
  }

  void
  operator()(int* target) const
  {
    *target = numberOf<int>(given, "a whole number");
  }

  void
  operator()(std::uint64_t* target) const
  {
    *target = numberOf<std::uint64_t>(given, "a whole number of 0 or more");
  }

  void
  operator()(double* target) const
  {
    *target = numberOf<double>(given, "a finite number");
  }

  void
  operator()(std::string* target) const
  {
    *target = given.text;
  }
};

nlohmann::json
valueOf(const SettingsTable::Target& target)
{
  return std::visit([](const auto* value) { return nlohmann::json(*value); }, target);
}

} // namespace

void
SettingsTable::add(const std::string& key,
                   Target target,
                   const std::string& description)
{
  const std::size_t dot = key.find('.');
  const bool grouped = dot != std::string::npos;
  settings_.push_back({grouped ? key.substr(0, dot) : std::string(),
                       grouped ? key.substr(dot + 1) : key,
                       target,
                       description});
}

void
SettingsTable::set(const GivenSetting& given) const
{
  for (const Setting& setting : settings_)
    if (setting.key() == given.key)
      return std::visit(Parser{given}, setting.target);
  throw std::invalid_argument("there is no setting " + given.key);
}

void
SettingsTable::describe(const std::string& group,
                        po::options_description& description,
                        std::vector<GivenSetting>& given) const
{
  for (const Setting& setting : settings_) {
    if (setting.group != group)
      continue;
    std::string option = setting.key();
    std::replace(option.begin(), option.end(), '_', '-');
    const std::string value = valueOf(setting.target).dump();
    auto* semantic = po::value<std::string>()->notifier(
        [&given, key = setting.key()](const std::string& text) {
          given.push_back({key, text, 0});
        });
    if (std::holds_alternative<bool*>(setting.target))
      semantic->implicit_value("true")->value_name("true|false");
    else
      semantic->value_name(value == "\"\"" ? "TEXT" : value);
    description.add_options()(option.c_str(), semantic, setting.description.c_str());
  }
}

std::string
SettingsTable::yaml() const
{
  std::string text;
  std::string group;
  for (const Setting& setting : settings_) {
    if (setting.group != group)
      text += setting.group + ":\n";
    group = setting.group;
    // A JSON scalar is one of YAML too.
    text += (group.empty() ? "" : "  ") + setting.name + ": " +
            valueOf(setting.target).dump() + "  # " + setting.description + '\n';
  }
  return text;
}

nlohmann::json
SettingsTable::json() const
{
  nlohmann::json result = nlohmann::json::object();
  for (const Setting& setting : settings_)
    (setting.group.empty() ? result : result[setting.group])[setting.name] =
        valueOf(setting.target);
  return result;
}

} // namespace pcl_nurbs_tools
