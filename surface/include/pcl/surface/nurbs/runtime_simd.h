// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

// For functions of plain arrays only, so that a version for newer processors can be
// chosen at run time without touching the alignment of any type that crosses the
// library border. The level x86-64-v3 (AVX2, FMA) is asked for by what a processor can
// do; the name of a processor, which older compilers want, fits that one alone.
#if !defined(__x86_64__) || !defined(__GNUC__) || defined(__SANITIZE_THREAD__)
#define PCL_NURBS_RUNTIME_SIMD
#elif !defined(__clang__) && __GNUC__ >= 12
#define PCL_NURBS_RUNTIME_SIMD                                                         \
  __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PCL_NURBS_RUNTIME_SIMD __attribute__((target_clones("arch=haswell", "default")))
#endif
