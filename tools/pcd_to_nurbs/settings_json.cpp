// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings.h"

#include <nlohmann/json.hpp>

namespace pcl_nurbs_tools {

nlohmann::json
optionsAsJson(const Settings& settings)
{
  const pcl::nurbs::ReconstructionOptions& fit = settings.reconstruction;
  nlohmann::json result = settings.words;
  result.update(nlohmann::json{{"threads", settings.common.threads},
                               {"demo", settings.demo},
                               {"depth_scale", settings.read.depth_scale},
                               {"rotated_depth", settings.read.rotated_depth_bits},
                               {"bin_values", settings.read.bin_values_per_point},
                               {"tolerance", fit.tolerance},
                               {"tolerance_sigmas", fit.tolerance_sigmas},
                               {"min_segment", settings.min_segment},
                               {"min_patch", fit.min_patch_points},
                               {"max_degree", fit.knots.max_degree},
                               {"max_control_points", fit.knots.max_control_points},
                               {"correlation", fit.knots.points_per_sample},
                               {"hold_out", fit.hold_out_every},
                               {"lossless", settings.output.nurbs.lossless},
                               {"mesh_tolerance", settings.output.mesh_tolerance},
                               {"shade", settings.picture.shade},
                               {"view", settings.picture.view},
                               {"draw_points", settings.picture.points}});
  return result;
}

} // namespace pcl_nurbs_tools
