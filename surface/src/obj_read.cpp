// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/obj_io.h>

#include "obj_scanner.h"
#include "text_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

namespace pcl {
namespace nurbs {
namespace {

using Words = ObjScanner::Words;

constexpr double kDomainTolerance = 1e-9;  // of the length of the domain
constexpr double kClosingTolerance = 1e-6; // of the extent of the surface's domain

class ObjReader {
public:
  explicit ObjReader(std::string_view text) : scanner_(text) {}

  SurfaceModel
  read()
  {
    Words words;
    while (scanner_.next(words))
      run(words);
    if (element_ != Element::None)
      fail("a curve or surface has no \"end\"");
    return std::move(model_);
  }

private:
  enum class Element { None, Curve, Surface };
  using Statement = void (ObjReader::*)(const Words&);

  struct LoopPart {
    std::array<double, 2> range;
    int curve;
  };

  [[noreturn]] void
  fail(const std::string& reason) const
  {
    scanner_.fail(reason);
  }

  void
  run(const Words& words)
  {
    static const std::unordered_map<std::string_view, Statement> kStatements{
        {"v", &ObjReader::readVertex},
        {"vp", &ObjReader::readParameterVertex},
        {"cstype", &ObjReader::readType},
        {"deg", &ObjReader::readDegree},
        {"g", &ObjReader::readGroup},
        {"curv2", &ObjReader::beginCurve},
        {"surf", &ObjReader::beginSurface},
        {"parm", &ObjReader::readKnots},
        {"trim", &ObjReader::readLoop},
        {"hole", &ObjReader::readLoop},
        {"end", &ObjReader::endElement}};
    if (words.empty())
      return;
    const auto statement = kStatements.find(words[0]);
    if (statement != kStatements.end())
      (this->*statement->second)(words);
  }

  void
  readVertex(const Words& words)
  {
    vertices_.push_back(scanner_.point<3>(words));
  }

  void
  readParameterVertex(const Words& words)
  {
    if (words.size() == 2) // of a special point on a curve
      parameter_vertices_.emplace_back(scanner_.number(words[1]), 0.0, 1.0);
    else
      parameter_vertices_.push_back(scanner_.point<2>(words));
  }

  void
  readType(const Words& words)
  {
    is_bspline_ = words.back() == "bspline";
    is_rational_ = words.size() > 2 && words[1] == "rat";
  }

  void
  readDegree(const Words& words)
  {
    if (words.size() < 2)
      fail("a degree is missing");
    degrees_ = {scanner_.integer(words[1]),
                scanner_.integer(words[words.size() > 2 ? 2 : 1])};
  }

  void
  readGroup(const Words& words)
  {
    constexpr std::string_view kPrefix = "label_";
    label_ = 0;
    if (words.size() != 2 || words[1].substr(0, kPrefix.size()) != kPrefix)
      return;
    const std::string_view digits = words[1].substr(kPrefix.size());
    std::uint32_t label = 0;
    const auto result =
        std::from_chars(digits.data(), digits.data() + digits.size(), label);
    if (result.ec == std::errc() && result.ptr == digits.data() + digits.size())
      label_ = label;
  }

  void
  begin(Element element)
  {
    if (element_ != Element::None)
      fail("a curve or surface begins before the last one ended");
    element_ = element;
    places_.clear();
    knots_ = {};
    loops_.clear();
  }

  void
  beginCurve(const Words& words)
  {
    if (!is_bspline_)
      fail("curves of this cstype cannot be read, only \"bspline\"");
    begin(Element::Curve);
    for (std::size_t i = 1; i < words.size(); ++i)
      places_.push_back(scanner_.index(words[i], parameter_vertices_.size()));
  }

  void
  beginSurface(const Words& words)
  {
    if (!is_bspline_)
      fail("surfaces of this cstype cannot be read, only \"bspline\"");
    if (words.size() < 5)
      fail("the ranges of a surface are missing");
    begin(Element::Surface);
    for (std::size_t i = 0; i < 4; ++i)
      ranges_[i / 2][i % 2] = scanner_.number(words[1 + i]);
    for (std::size_t i = 5; i < words.size(); ++i)
      places_.push_back(scanner_.index(words[i], vertices_.size()));
  }

  void
  readKnots(const Words& words)
  {
    if (words.size() < 2 || (words[1] != "u" && words[1] != "v"))
      fail("parm is neither of u nor of v");
    std::vector<double>& knots = knots_[words[1] == "v" ? 1 : 0];
    for (std::size_t i = 2; i < words.size(); ++i)
      knots.push_back(scanner_.number(words[i]));
  }

  void
  readLoop(const Words& words)
  {
    if (element_ != Element::Surface)
      fail("a trimming loop stands outside of a surface");
    if (words.size() < 4 || words.size() % 3 != 1)
      fail("a trimming loop is not a list of two parameters and a curve");
    std::vector<LoopPart> loop;
    for (std::size_t i = 1; i < words.size(); i += 3)
      loop.push_back({{scanner_.number(words[i]), scanner_.number(words[i + 1])},
                      static_cast<int>(scanner_.index(words[i + 2], curves_.size()))});
    loops_.push_back(std::move(loop));
  }

  void
  endElement(const Words&)
  {
    const Element element = element_;
    element_ = Element::None;
    try {
      if (element == Element::Curve)
        curves_.push_back(finishedCurve());
      else if (element == Element::Surface)
        addSurface();
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    } catch (const std::domain_error& error) {
      fail(error.what());
    }
  }

  void
  requireWholeDomain(const KnotVector& knots, const std::array<double, 2>& range) const
  {
    const double tolerance = kDomainTolerance * knots.domainLength();
    if (std::abs(range[0] - knots.domainMin()) > tolerance ||
        std::abs(range[1] - knots.domainMax()) > tolerance)
      fail("a part of a curve or surface cannot be read, only the whole");
  }

  NurbsCurve2
  finishedCurve() const
  {
    NurbsCurve2::HomogeneousPoints points(3, static_cast<Eigen::Index>(places_.size()));
    for (std::size_t i = 0; i < places_.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)) =
          homogeneous(parameter_vertices_[places_[i]], is_rational_);
    return NurbsCurve2(KnotVector(degrees_[0], knots_[0]), std::move(points));
  }

  NurbsSurface
  finishedSurface() const
  {
    const KnotVector u(degrees_[0], knots_[0]);
    const KnotVector v(degrees_[1], knots_[1]);
    requireWholeDomain(u, ranges_[0]);
    requireWholeDomain(v, ranges_[1]);
    const auto rows = static_cast<std::size_t>(u.numControlPoints());
    const auto cols = static_cast<std::size_t>(v.numControlPoints());
    if (places_.size() != rows * cols)
      fail("a surface has " + std::to_string(places_.size()) +
           " points, its knots need " + std::to_string(rows * cols));
    NurbsSurface::HomogeneousPoints points(4, static_cast<Eigen::Index>(rows * cols));
    for (std::size_t j = 0; j < cols; ++j)
      for (std::size_t i = 0; i < rows; ++i)
        points.col(static_cast<Eigen::Index>(i * cols + j)) =
            homogeneous(vertices_[places_[j * rows + i]], is_rational_);
    return NurbsSurface(u, v, std::move(points));
  }

  void
  addSurface()
  {
    NurbsSurface surface = finishedSurface();
    const double tolerance =
        kClosingTolerance *
        std::max(surface.knotsU().domainLength(), surface.knotsV().domainLength());
    std::vector<TrimLoop> loops;
    for (const std::vector<LoopPart>& parts : loops_) {
      std::vector<NurbsCurve2> curves;
      for (const LoopPart& part : parts) {
        curves.push_back(curves_[static_cast<std::size_t>(part.curve)]);
        requireWholeDomain(curves.back().knots(), part.range);
      }
      loops.emplace_back(std::move(curves), tolerance);
    }
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(std::move(surface), std::move(loops));
    patch.label = label_;
    model_.patches.push_back(std::move(patch));
  }

  SurfaceModel model_;
  ObjScanner scanner_;
  std::vector<Eigen::Vector4d> vertices_;
  std::vector<Eigen::Vector3d> parameter_vertices_;
  std::vector<NurbsCurve2> curves_;
  bool is_bspline_ = false;
  bool is_rational_ = false;
  std::array<int, 2> degrees_{};
  std::uint32_t label_ = 0;
  // Of the curve or surface that is being read:
  Element element_ = Element::None;
  std::array<std::array<double, 2>, 2> ranges_{};
  std::vector<std::size_t> places_;
  std::array<std::vector<double>, 2> knots_;
  std::vector<std::vector<LoopPart>> loops_;
};

} // namespace

SurfaceModel
fromObj(std::string_view text)
{
  return ObjReader(text).read();
}

SurfaceModel
readObjFile(const std::string& path)
{
  const std::string text = textOfFile<ObjIoError>(path);
  try {
    return fromObj(text);
  } catch (const ObjIoError& error) {
    throw ObjIoError(path + ": " + error.what());
  }
}

} // namespace nurbs
} // namespace pcl
