// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/impl/entropy_rate_segmentation.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(EntropyRateSegmentation, PCL_XYZ_POINT_TYPES)
