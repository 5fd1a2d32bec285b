// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

inline std::string
readText(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error("cannot open " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

/** All numbers of a text; characters of \a separators count as white space. */
inline std::vector<double>
readNumbers(std::string text, const std::string& separators = "")
{
  for (char& c : text)
    if (separators.find(c) != std::string::npos)
      c = ' ';
  std::istringstream in(text);
  std::vector<double> numbers;
  for (double number = 0.0; in >> number;)
    numbers.push_back(number);
  if (!in.eof())
    throw std::runtime_error("text where a number was expected");
  return numbers;
}

/** Points of a geomdl file as columns in file order; four rows (homogeneous) for .cptw,
 * else three. */
inline Eigen::MatrixXd
readGeomdlPoints(const std::filesystem::path& path)
{
  const std::vector<double> numbers = readNumbers(readText(path), ",;");
  const int rows = path.extension() == ".cptw" ? 4 : 3;
  const auto columns = static_cast<Eigen::Index>(numbers.size()) / rows;
  return Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, columns);
}

/** Columns (i, j) reordered from "first index fastest" to the order of NurbsSurface. */
template <class Matrix>
Matrix
fromFirstIndexFastest(const Matrix& in, int n_u, int n_v)
{
  Matrix out(in.rows(), in.cols());
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j)
      out.col(i * n_v + j) = in.col(j * n_u + i);
  return out;
}

/** Surface from knots, weights and flat xyz coordinates, first index fastest: the order
 * of G+Smo and IGES. No weights mean all are 1. */
inline NurbsSurface
surfaceFromFirstIndexFastest(const KnotVector& u,
                             const KnotVector& v,
                             const std::vector<double>& weights,
                             const std::vector<double>& coordinates)
{
  const int n_u = u.numControlPoints();
  const int n_v = v.numControlPoints();
  const std::size_t count = static_cast<std::size_t>(n_u) * n_v;
  if (coordinates.size() != 3 * count || (!weights.empty() && weights.size() != count))
    throw std::runtime_error("number of control points does not fit the knots");
  const Eigen::Matrix3Xd points =
      Eigen::Map<const Eigen::Matrix3Xd>(coordinates.data(), 3, n_u * n_v);
  Eigen::RowVectorXd w = Eigen::RowVectorXd::Ones(n_u * n_v);
  std::copy(weights.begin(), weights.end(), w.data());
  return NurbsSurface::fromControlPoints(
      u,
      v,
      fromFirstIndexFastest(points, n_u, n_v),
      fromFirstIndexFastest(w, n_u, n_v).transpose());
}

/** Content of the elements <tag ...>content</tag> of an XML text without nesting. */
inline std::vector<std::string>
xmlElements(const std::string& text, const std::string& tag)
{
  std::vector<std::string> elements;
  for (std::size_t at = text.find("<" + tag); at != std::string::npos;
       at = text.find("<" + tag, at)) {
    at = text.find('>', at) + 1;
    const std::size_t end = text.find("</" + tag + ">", at);
    elements.push_back(text.substr(at, end - at));
    at = end;
  }
  return elements;
}

/** Tensor-product surfaces of a G+Smo XML file. */
inline std::vector<NurbsSurface>
readGismo(const std::filesystem::path& path)
{
  std::string text = readText(path);
  for (std::size_t at = text.find("<!--"); at != std::string::npos;
       at = text.find("<!--"))
    text.erase(at, text.find("-->", at) + 3 - at);
  std::vector<NurbsSurface> surfaces;
  for (const std::string& geometry : xmlElements(text, "Geometry")) {
    std::vector<KnotVector> knots;
    std::size_t at = 0;
    for (const std::string& element : xmlElements(geometry, "KnotVector")) {
      at = geometry.find("degree=\"", at) + 8;
      knots.emplace_back(std::stoi(geometry.substr(at)), readNumbers(element));
    }
    const std::vector<std::string> weights = xmlElements(geometry, "weights");
    surfaces.push_back(surfaceFromFirstIndexFastest(
        knots.at(0),
        knots.at(1),
        weights.empty() ? std::vector<double>() : readNumbers(weights[0]),
        readNumbers(xmlElements(geometry, "coefs").at(0))));
  }
  return surfaces;
}

/** Bicubic Bézier patches of a Geomview BBP file. */
inline std::vector<NurbsSurface>
readBezierPatches(const std::filesystem::path& path)
{
  const std::string text = readText(path);
  const std::vector<double> numbers = readNumbers(text.substr(text.find("BBP") + 3));
  std::vector<NurbsSurface> surfaces;
  const KnotVector knots = KnotVector::bezier(3);
  for (auto at = numbers.begin(); numbers.end() - at >= 48; at += 48)
    surfaces.push_back(surfaceFromFirstIndexFastest(knots, knots, {}, {at, at + 48}));
  return surfaces;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
