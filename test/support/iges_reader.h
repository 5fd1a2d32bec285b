// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "reference_readers.h"

#include <map>

namespace pcl {
namespace nurbs {
namespace test {

/** Reader of the entities 102, 126, 128, 142 and 144 of a fixed-format ASCII IGES file
 * with the default delimiters and no transformations. Entities are named by the
 * sequence number of their directory entry. */
class IgesReader {
public:
  explicit IgesReader(const std::filesystem::path& path)
  {
    std::istringstream lines(readText(path));
    std::vector<std::string> directory;
    std::vector<std::string> data;
    for (std::string line; std::getline(lines, line);) {
      line.resize(80, ' ');
      if (line[72] == 'D')
        directory.push_back(line);
      else if (line[72] == 'P')
        data.push_back(line.substr(0, 64));
    }
    for (std::size_t i = 0; i + 1 < directory.size(); i += 2)
      readEntity(static_cast<int>(i) + 1, directory[i], directory[i + 1], data);
  }

  /** Entities of a type in file order. */
  std::vector<int>
  ofType(int type) const
  {
    std::vector<int> result;
    for (const auto& [number, entity] : entities_)
      if (entity[0] == type)
        result.push_back(number);
    return result;
  }

  /** Parameters of an entity after its type. */
  std::vector<double>
  parameters(int number) const
  {
    const std::vector<double>& all = entities_.at(number);
    return {all.begin() + 1, all.end()};
  }

  /** Entity 128. */
  NurbsSurface
  surface(int number) const
  {
    const std::vector<double> p = parameters(number);
    const int k1 = static_cast<int>(p.at(0));
    const int k2 = static_cast<int>(p.at(1));
    const int m1 = static_cast<int>(p.at(2));
    const int m2 = static_cast<int>(p.at(3));
    auto at = p.begin() + 9;
    const KnotVector u(m1, take(at, k1 + m1 + 2));
    const KnotVector v(m2, take(at, k2 + m2 + 2));
    const int count = (k1 + 1) * (k2 + 1);
    const std::vector<double> weights = take(at, count);
    return surfaceFromFirstIndexFastest(u, v, weights, take(at, 3 * count));
  }

  /** Entity 126. */
  NurbsCurve3
  curve(int number) const
  {
    const std::vector<double> p = parameters(number);
    const int k = static_cast<int>(p.at(0));
    const int m = static_cast<int>(p.at(1));
    auto at = p.begin() + 6;
    KnotVector knots(m, take(at, k + m + 2));
    const std::vector<double> weights = take(at, k + 1);
    const std::vector<double> points = take(at, 3 * (k + 1));
    return NurbsCurve3::fromControlPoints(
        std::move(knots),
        Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, k + 1),
        Eigen::Map<const Eigen::VectorXd>(weights.data(), k + 1));
  }

  /** The curves of a composite curve (102), or the one curve (126). */
  std::vector<NurbsCurve3>
  chain(int number) const
  {
    if (entities_.at(number)[0] == 126)
      return {curve(number)};
    std::vector<NurbsCurve3> curves;
    const std::vector<double> p = parameters(number);
    for (int i = 1; i <= p.at(0); ++i)
      curves.push_back(curve(static_cast<int>(p.at(i))));
    return curves;
  }

private:
  using Iterator = std::vector<double>::const_iterator;

  static std::vector<double>
  take(Iterator& at, int count)
  {
    at += count;
    return {at - count, at};
  }

  static int
  field(const std::string& line, int index)
  {
    const std::string text = line.substr(8 * static_cast<std::size_t>(index), 8);
    return text.find_first_not_of(' ') == std::string::npos ? 0 : std::stoi(text);
  }

  void
  readEntity(int number,
             const std::string& first,
             const std::string& second,
             const std::vector<std::string>& data)
  {
    if (field(first, 6) != 0)
      throw std::runtime_error("IGES transformations are not supported");
    std::string text;
    for (int i = 0; i < field(second, 3); ++i)
      text += data.at(static_cast<std::size_t>(field(first, 1) - 1 + i));
    std::replace(text.begin(), text.end(), 'D', 'E');
    entities_[number] = readNumbers(text.substr(0, text.find(';')), ",");
  }

  std::map<int, std::vector<double>> entities_;
};

} // namespace test
} // namespace nurbs
} // namespace pcl
