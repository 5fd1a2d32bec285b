// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstddef> // for __GLIBC__: other loaders cannot choose

/** \def PCL_NURBS_VECTOR_CLONES
 * Before a function whose loops become vector code: it is compiled for the wider
 * registers of newer processors as well, and the loader takes what the machine has.
 * Without fused operations, so that all of them give the same bits. Only for functions
 * that neither take nor return types whose layout depends on the registers. Sanitizers
 * see the function as written: they do not work before the loader has chosen. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) &&                  \
    !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                           \
    !defined(__SANITIZE_THREAD__)
#define PCL_NURBS_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define PCL_NURBS_VECTOR_CLONES
#endif
