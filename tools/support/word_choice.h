// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "run_tool.h"

#include <map>
#include <string>

namespace pcl_nurbs_tools {

/** What a word stands for.
 * \param[in] what is chosen, for the message: "--cost", "the scene"
 * \throws ToolError of usage that names the words there are */
template <typename Value>
Value
chosen(const std::string& what,
       const std::string& word,
       const std::map<std::string, Value>& values)
{
  const auto found = values.find(word);
  if (found != values.end())
    return found->second;
  std::string words;
  for (const auto& value : values)
    words += (words.empty() ? "" : ", ") + value.first;
  throw ToolError(kUsage, what + " must be one of " + words);
}

} // namespace pcl_nurbs_tools
