// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>
#include <pcl/surface/nurbs/json_io.h>

#include "text_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr int kMaxDepth = 32; // of nesting; a model needs 8

// --- writing

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

// --- reading

/** A value and where it stands, so that errors can say so. */
class Node {
public:
  Node(const json& value, std::string path) : value_(value), path_(std::move(path)) {}

  [[noreturn]] void
  fail(const std::string& reason) const
  {
    throw JsonIoError((path_.empty() ? "/" : path_) + ": " + reason);
  }

  bool
  has(const char* key) const
  {
    return value_.is_object() && value_.contains(key);
  }

  Node
  at(const char* key) const
  {
    if (!value_.is_object())
      fail("is not an object");
    const auto found = value_.find(key);
    if (found == value_.end())
      fail(std::string("has no \"") + key + "\"");
    return {*found, path_ + "/" + key};
  }

  Node
  at(std::size_t i) const
  {
    return {value_.at(i), path_ + "/" + std::to_string(i)};
  }

  std::size_t
  size() const
  {
    if (!value_.is_array())
      fail("is not an array");
    return value_.size();
  }

  const json&
  value() const
  {
    return value_;
  }

  double
  number() const
  {
    if (!value_.is_number())
      fail("is not a number");
    return value_.get<double>();
  }

  template <class Integer>
  Integer
  integer(std::uint64_t largest = std::numeric_limits<Integer>::max()) const
  {
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > largest)
      fail("is not an integer from 0 to " + std::to_string(largest));
    return static_cast<Integer>(value_.get<std::uint64_t>());
  }

  std::string
  text() const
  {
    if (!value_.is_string())
      fail("is not a text");
    return value_.get<std::string>();
  }

private:
  const json& value_;
  std::string path_;
};

/** All numbers in an array, nested or not. */
void
appendNumbers(const Node& node, std::vector<double>& numbers)
{
  if (!node.value().is_array()) {
    numbers.push_back(node.number());
    return;
  }
  for (std::size_t i = 0; i < node.size(); ++i)
    appendNumbers(node.at(i), numbers);
}

std::vector<double>
numbers(const Node& node)
{
  if (!node.value().is_array())
    node.fail("is not an array");
  std::vector<double> result;
  appendNumbers(node, result);
  return result;
}

/** Run \a make; what the kernel objects to is the fault of \a node. */
template <class Make>
auto
made(const Node& node, Make make)
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
knotsFrom(const Node& owner, const char* degree, const char* knots)
{
  const int p = owner.at(degree).integer<int>(kMaxDegree);
  const Node node = owner.at(knots);
  return made(node, [&] { return KnotVector(p, numbers(node)); });
}

/** Homogeneous points of an object with "points" and perhaps "weights". */
template <int Dim>
Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>
homogeneousFrom(const Node& owner, std::size_t count)
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
                             " numbers, there are " + std::to_string(count) + " points");
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
loopFrom(const Node& node)
{
  std::vector<NurbsCurve2> curves;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Node curve = node.at(i);
    const KnotVector knots = knotsFrom(curve, "degree", "knots");
    const auto points = homogeneousFrom<2>(
        curve, static_cast<std::size_t>(knots.numControlPoints()));
    curves.push_back(made(curve, [&] { return NurbsCurve2(knots, points); }));
  }
  return made(node, [&] { return TrimLoop(curves); });
}

NurbsSurface
surfaceFrom(const Node& node)
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
qualityFrom(const Node& node)
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
patchFrom(const Node& node)
{
  SurfacePatch patch;
  NurbsSurface surface = surfaceFrom(node);
  std::vector<TrimLoop> loops;
  if (node.has("trims"))
    for (std::size_t i = 0; i < node.at("trims").size(); ++i)
      loops.push_back(loopFrom(node.at("trims").at(i)));
  patch.geometry = made(
      node, [&] { return TrimmedSurface(std::move(surface), std::move(loops)); });
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

std::string
toJson(const SurfaceModel& model)
{
  OrderedJson root;
  root["format"] = "pcl_nurbs";
  root["version"] = kVersion;
  root["frame_id"] = model.frame_id;
  root["metadata"] = model.metadata;
  root["patches"] = OrderedJson::array();
  for (const SurfacePatch& patch : model.patches)
    root["patches"].push_back(patchJson(patch));
  return root.dump(1) + "\n";
}

SurfaceModel
fromJson(std::string_view text)
{
  const json document = parsed(text);
  const Node root(document, "");
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
      model.metadata[item.key()] = Node(item.value(), "/metadata/" + item.key()).text();
  }
  const Node patches = root.at("patches");
  for (std::size_t i = 0; i < patches.size(); ++i)
    model.patches.push_back(patchFrom(patches.at(i)));
  return model;
}

void
writeJsonFile(const std::string& path, const SurfaceModel& model)
{
  writeFileAtomically(path, toJson(model));
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
