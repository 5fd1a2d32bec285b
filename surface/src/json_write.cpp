// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>
#include <pcl/surface/nurbs/json_io.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using OrderedJson = nlohmann::ordered_json;

template <int Dim>
OrderedJson
pointsJson(const Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>& homogeneous)
{
  OrderedJson points = OrderedJson::array();
  for (Eigen::Index i = 0; i < homogeneous.cols(); ++i) {
    OrderedJson point = OrderedJson::array();
    for (int d = 0; d < Dim; ++d)
      point.push_back(homogeneous(d, i) / homogeneous(Dim, i));
    points.push_back(std::move(point));
  }
  return points;
}

/** Weights of all points, or nothing where all are 1. */
template <class Homogeneous>
void
addWeights(OrderedJson& object, const Homogeneous& homogeneous)
{
  const auto weights = homogeneous.row(homogeneous.rows() - 1);
  if ((weights.array() == 1.0).all())
    return;
  object["weights"] = OrderedJson::array();
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    object["weights"].push_back(weights(i));
}

OrderedJson
loopJson(const TrimLoop& loop)
{
  OrderedJson curves = OrderedJson::array();
  for (const NurbsCurve2& curve : loop.curves()) {
    OrderedJson object;
    object["degree"] = curve.degree();
    object["knots"] = curve.knots().values();
    object["points"] = pointsJson<2>(curve.homogeneousPoints());
    addWeights(object, curve.homogeneousPoints());
    curves.push_back(std::move(object));
  }
  return curves;
}

/** JSON has no numbers that are not finite: null stands for "not known". */
OrderedJson
finiteOrNull(double value)
{
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

OrderedJson
patchJson(const SurfacePatch& patch)
{
  const NurbsSurface& surface = patch.geometry.surface();
  OrderedJson object;
  object["degree_u"] = surface.knotsU().degree();
  object["degree_v"] = surface.knotsV().degree();
  object["knots_u"] = surface.knotsU().values();
  object["knots_v"] = surface.knotsV().values();
  object["points"] = pointsJson<3>(surface.homogeneousPoints());
  addWeights(object, surface.homogeneousPoints());
  object["trims"] = OrderedJson::array();
  for (const TrimLoop& loop : patch.geometry.loops())
    object["trims"].push_back(loopJson(loop));
  object["label"] = patch.label;
  object["quality"] = {{"points", patch.quality.points},
                       {"noise", finiteOrNull(patch.quality.noise)},
                       {"rmse", finiteOrNull(patch.quality.rmse)},
                       {"max", finiteOrNull(patch.quality.max)}};
  return object;
}

} // namespace

std::string
toJson(const SurfaceModel& model)
{
  OrderedJson root;
  root["format"] = "pcl_nurbs";
  root["version"] = 1;
  root["frame_id"] = model.frame_id;
  root["metadata"] = model.metadata;
  root["patches"] = OrderedJson::array();
  for (const SurfacePatch& patch : model.patches)
    root["patches"].push_back(patchJson(patch));
  return root.dump(1) + "\n";
}

void
writeJsonFile(const std::string& path, const SurfaceModel& model)
{
  writeFileAtomically(path, toJson(model));
}

} // namespace nurbs
} // namespace pcl
