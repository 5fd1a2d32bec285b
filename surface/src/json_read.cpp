// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/json_io.h>

#include "json_node.h"
#include "text_file.h"

#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;
constexpr int kMaxDepth = 32; // of nesting; a model needs 8

/** Run \a make; what the kernel objects to is the fault of \a node. */
template <class Make>
auto
made(const JsonNode& node, Make make)
{
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    node.fail(error.what());
  } catch (const std::domain_error& error) {
    node.fail(error.what());
  }
}

KnotVector
knotsFrom(const JsonNode& owner, const char* degree, const char* knots)
{
  const int p = owner.at(degree).integer<int>(kMaxDegree);
  const JsonNode node = owner.at(knots);
  return made(node, [&] { return KnotVector(p, numbers(node)); });
}

/** Homogeneous points of an object with "points" and perhaps "weights". */
template <int Dim>
Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>
homogeneousFrom(const JsonNode& owner, std::size_t count)
{
  const std::vector<double> points = numbers(owner.at("points"));
  if (points.size() != Dim * count)
    owner.at("points").fail("has " + std::to_string(points.size()) +
                            " numbers, the knots need " + std::to_string(Dim * count));
  std::vector<double> weights(count, 1.0);
  if (owner.has("weights"))
    weights = numbers(owner.at("weights"));
  if (weights.size() != count)
    owner.at("weights").fail("has " + std::to_string(weights.size()) +
                             " numbers, there are " + std::to_string(count) +
                             " points");
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> result(
      Dim + 1, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (int d = 0; d < Dim; ++d)
      result(d, static_cast<Eigen::Index>(i)) = weights[i] * points[Dim * i + d];
    result(Dim, static_cast<Eigen::Index>(i)) = weights[i];
  }
  return result;
}

TrimLoop
loopFrom(const JsonNode& node)
{
  std::vector<NurbsCurve2> curves;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const JsonNode curve = node.at(i);
    const KnotVector knots = knotsFrom(curve, "degree", "knots");
    const auto points =
        homogeneousFrom<2>(curve, static_cast<std::size_t>(knots.numControlPoints()));
    curves.push_back(made(curve, [&] { return NurbsCurve2(knots, points); }));
  }
  return made(node, [&] { return TrimLoop(curves); });
}

NurbsSurface
surfaceFrom(const JsonNode& node)
{
  const KnotVector u = knotsFrom(node, "degree_u", "knots_u");
  const KnotVector v = knotsFrom(node, "degree_v", "knots_v");
  const auto points =
      homogeneousFrom<3>(node,
                         static_cast<std::size_t>(u.numControlPoints()) *
                             static_cast<std::size_t>(v.numControlPoints()));
  return made(node, [&] { return NurbsSurface(u, v, points); });
}

PatchQuality
qualityFrom(const JsonNode& node)
{
  const auto optional = [&](const char* key) {
    const bool known = node.has(key) && !node.at(key).value().is_null();
    return known ? node.at(key).number() : std::numeric_limits<double>::quiet_NaN();
  };
  PatchQuality quality;
  quality.points = node.at("points").integer<std::uint64_t>();
  quality.noise = optional("noise");
  quality.rmse = optional("rmse");
  quality.max = optional("max");
  return quality;
}

SurfacePatch
patchFrom(const JsonNode& node)
{
  SurfacePatch patch;
  NurbsSurface surface = surfaceFrom(node);
  std::vector<TrimLoop> loops;
  if (node.has("trims"))
    for (std::size_t i = 0; i < node.at("trims").size(); ++i)
      loops.push_back(loopFrom(node.at("trims").at(i)));
  patch.geometry =
      made(node, [&] { return TrimmedSurface(std::move(surface), std::move(loops)); });
  if (node.has("label"))
    patch.label = node.at("label").integer<std::uint32_t>();
  if (node.has("quality"))
    patch.quality = qualityFrom(node.at("quality"));
  return patch;
}

json
parsed(std::string_view text)
{
  const auto limit_depth = [](int depth, json::parse_event_t, json&) {
    if (depth > kMaxDepth)
      throw JsonIoError("/: is nested too deeply");
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), limit_depth);
  } catch (const json::exception& error) {
    throw JsonIoError(std::string("/: ") + error.what());
  }
}

} // namespace

SurfaceModel
fromJson(std::string_view text)
{
  const json document = parsed(text);
  const JsonNode root(document, "");
  if (root.at("format").text() != "pcl_nurbs")
    root.at("format").fail("is not \"pcl_nurbs\"");
  if (root.at("version").integer<int>() != kVersion)
    root.at("version").fail("is not " + std::to_string(kVersion));
  SurfaceModel model;
  if (root.has("frame_id"))
    model.frame_id = root.at("frame_id").text();
  if (root.has("metadata")) {
    if (!root.at("metadata").value().is_object())
      root.at("metadata").fail("is not an object");
    for (const auto& item : root.at("metadata").value().items())
      model.metadata[item.key()] =
          JsonNode(item.value(), "/metadata/" + item.key()).text();
  }
  const JsonNode patches = root.at("patches");
  for (std::size_t i = 0; i < patches.size(); ++i)
    model.patches.push_back(patchFrom(patches.at(i)));
  return model;
}

SurfaceModel
readJsonFile(const std::string& path)
{
  const std::string text = textOfFile<JsonIoError>(path);
  try {
    return fromJson(text);
  } catch (const JsonIoError& error) {
    throw JsonIoError(path + ": " + error.what());
  }
}

} // namespace nurbs
} // namespace pcl
