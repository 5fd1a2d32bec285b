// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "input_file.h"

namespace pcl {
namespace nurbs {

/** Whether bytes begin as a gzip file does. */
bool
isGzip(std::string_view bytes);

/** The text in a gzip file. \throws InputError if it is damaged or there is more text
 * than so many bytes */
std::string
inflateGzip(const InputFile& file, std::size_t max_bytes);

/** A gzip file of a text. */
std::string
deflateGzip(std::string_view text);

} // namespace nurbs
} // namespace pcl
