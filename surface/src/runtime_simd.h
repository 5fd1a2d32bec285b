// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

// For functions of plain arrays only, so that a version for newer processors can be
// chosen at run time without touching the alignment of any type that crosses the
// library border.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_THREAD__)
#define PCL_NURBS_RUNTIME_SIMD __attribute__((target_clones("arch=haswell", "default")))
#else
#define PCL_NURBS_RUNTIME_SIMD
#endif
