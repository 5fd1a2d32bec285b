// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Points and derivatives against a table that another implementation computed; see
// make_oracle_values.py beside it for what made the table and its layout.

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace pcl::nurbs;
using nlohmann::json;

const json&
table()
{
  static const json values =
      json::parse(std::ifstream(PCL_NURBS_TEST_DATA "/nurbs_oracle_values.json"));
  return values;
}

/** An array of equally long arrays as the columns of a matrix. */
Eigen::MatrixXd
columns(const json& rows)
{
  Eigen::MatrixXd matrix(rows.at(0).size(), rows.size());
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows[j].size(); ++i)
      matrix(i, j) = rows[j][i].get<double>();
  return matrix;
}

KnotVector
knotVector(const json& degree, const json& knots)
{
  return {degree.get<int>(), knots.get<std::vector<double>>()};
}

template <int Dim>
void
expectCurveAgrees(const json& entry)
{
  const NurbsCurve<Dim> curve(knotVector(entry.at("degree"), entry.at("knots")),
                              columns(entry.at("points")));
  for (const json& sample : entry.at("samples")) {
    const double u = sample.at("u");
    const Eigen::MatrixXd expected = columns(sample.at("derivatives"));
    const int order = static_cast<int>(expected.cols()) - 1;
    const auto values = curve.derivatives(u, order);
    EXPECT_LT((curve.evaluate(u) - expected.col(0)).norm(), 1e-13);
    double scale = 1.0;
    for (int k = 0; k <= order; ++k) {
      // A derivative inherits the rounding of those below it.
      scale = std::max(scale, expected.col(k).norm());
      EXPECT_LT((values[k] - expected.col(k)).norm(), 1e-12 * scale) << "order " << k;
    }
  }
}

TEST(OracleValues, tableIsComplete)
{
  EXPECT_EQ(table().at("curves").size(), 20u);
  EXPECT_EQ(table().at("surfaces").size(), 20u);
}

TEST(OracleValues, curvesAgree)
{
  for (const json& entry : table().at("curves"))
    if (entry.at("points").at(0).size() == 3)
      expectCurveAgrees<2>(entry);
    else
      expectCurveAgrees<3>(entry);
}

TEST(OracleValues, surfacesAgree)
{
  for (const json& entry : table().at("surfaces")) {
    const NurbsSurface surface(
        knotVector(entry.at("degrees").at(0), entry.at("knots").at(0)),
        knotVector(entry.at("degrees").at(1), entry.at("knots").at(1)),
        columns(entry.at("points")));
    for (const json& sample : entry.at("samples")) {
      const double u = sample.at("u");
      const double v = sample.at("v");
      const SurfaceDerivatives values = surface.derivatives(u, v, 3);
      double scale = 1.0;
      for (const auto& [name, value] : sample.at("derivatives").items()) {
        const Eigen::Vector3d expected(value.at(0), value.at(1), value.at(2));
        scale = std::max(scale, expected.norm());
      }
      for (const auto& [name, value] : sample.at("derivatives").items()) {
        const Eigen::Vector3d expected(value.at(0), value.at(1), value.at(2));
        EXPECT_LT((values(name[0] - '0', name[1] - '0') - expected).norm(),
                  1e-12 * scale)
            << "derivative " << name;
      }
    }
  }
}

} // namespace
