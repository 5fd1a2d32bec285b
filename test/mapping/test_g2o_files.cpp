// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graphs.h"
#include "test_data.h"

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/pose_graph_cost.h>
#include <pcl/mapping/pose_graph_io.h>

#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

const std::string kPlanarEdge = "EDGE_SE2 0 1 1 0 0 4 0 0 4 0 9\n";
const std::string kSpatialEdge = "EDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1 "
                                 "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n";

std::string
contentOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string
messageOf(const std::string& text)
{
  try {
    parseG2o(text, "a.g2o");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(G2oFile, WhatDoesNotChangeIsWrittenByteForByte)
{
  for (const char* ending : {"\n", "", "\r\n", "\n\n"}) {
    const std::string text = "# a comment\nVERTEX_SE2 0 0.10 0 0\n\nPARAMS_X 1 2\n"
                             "VERTEX_SE2 1  1e0 0 +0.5 # with a remark\nFIX 0\n"
                             "EDGE_SE2 0 1 1 0 0 4 0 0 4 0 9" +
                             std::string(ending);
    const G2oGraph read = parseG2o(text, "a.g2o");
    EXPECT_EQ(toG2o(read.graph, read.layout.get()), text);
    EXPECT_EQ(read.ignored_rows, 1U);
    ASSERT_EQ(read.messages.size(), 1U);
    EXPECT_NE(read.messages[0].find("a.g2o: line 4: tag \"PARAMS_X\""),
              std::string::npos);
    EXPECT_TRUE(read.graph.node(0).fixed);
  }
}

TEST(G2oFile, RowsFollowTheGraph)
{
  const G2oGraph read = parseG2o(
      "VERTEX_SE2 0 0 0 0\n# between\nVERTEX_SE2 1 1 0 0\nFIX 0 1\n" + kPlanarEdge,
      "a.g2o");
  PoseGraph graph = read.graph;
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.translation().x() = 0.1;
  graph.setFixed(1, false);
  graph.setPose(1, moved);
  graph.addNode(5, true);
  graph.setPose(5, moved);
  graph.addFactor(BetweenFactor{1, 5, moved, planarInformation(2.0, 3.0)});
  EXPECT_EQ(toG2o(graph, read.layout.get()),
            "VERTEX_SE2 0 0 0 0\n# between\nVERTEX_SE2 1 0.1 0 0\nFIX 0\n" +
                kPlanarEdge +
                "VERTEX_SE2 5 0.1 0 0\nEDGE_SE2 1 5 0.1 0 0 2 0 0 2 0 3\n");
  graph.removeNode(1);
  EXPECT_EQ(toG2o(graph, read.layout.get()),
            "VERTEX_SE2 0 0 0 0\n# between\nFIX 0\nVERTEX_SE2 5 0.1 0 0\n");
}

/** Without a layout: numbers come back as they were, the information to the bit. */
TEST(G2oFile, GraphsComeBack)
{
  for (const bool planar : {false, true}) {
    PoseGraph graph = randomGraph(1, {30, 20, 0.1, planar, false});
    graph.setFixed(3, true);
    const std::string text = toG2o(graph);
    const G2oGraph read = parseG2o(text, "a.g2o");
    EXPECT_EQ(toG2o(read.graph, read.layout.get()), text);
    EXPECT_TRUE(read.messages.empty());
    EXPECT_LT(poseDifference(graph, read.graph), 1e-14);
    EXPECT_TRUE(read.graph.node(3).fixed);
    EXPECT_EQ(read.graph.node(0).planar, planar);
    auto other = read.graph.factors().begin();
    for (const auto& [id, factor] : graph.factors()) {
      const auto& a = std::get<BetweenFactor>(factor.measurement);
      const auto& b = std::get<BetweenFactor>((other++)->second.measurement);
      EXPECT_EQ(a.information, b.information);
      EXPECT_TRUE(a.T_from_to.isApprox(b.T_from_to, 1e-14));
    }
  }
}

/** g2o's chi square is of half of the rotation: e = (t, q_xyz). */
TEST(G2oFile, ChiSquareIsG2os)
{
  const double half = 0.1;
  char vertex[200];
  std::snprintf(vertex,
                sizeof vertex,
                "VERTEX_SE3:QUAT 2 1.5 0 0 %.17g 0 0 %.17g\n",
                std::sin(half),
                std::cos(half));
  const G2oGraph read =
      parseG2o("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n" + std::string(vertex) + kSpatialEdge,
               "a.g2o");
  EXPECT_NEAR(costOf(read.graph), 0.25 + 4.0 * std::sin(half) * std::sin(half), 1e-14);
}

TEST(G2oFile, EdgesAloneMakeNodes)
{
  const G2oGraph read = parseG2o(kPlanarEdge, "a.g2o");
  EXPECT_EQ(read.graph.nodes().size(), 2U);
  EXPECT_FALSE(read.graph.node(1).has_estimate);
  EXPECT_TRUE(read.messages.empty());
}

TEST(G2oFile, OddButUsableRowsAreReported)
{
  const auto told = [](const std::string& text) {
    const G2oGraph read = parseG2o(text, "a.g2o");
    EXPECT_EQ(read.messages.size(), 1U) << text;
    EXPECT_EQ(toG2o(read.graph, read.layout.get()), text);
    return read.messages.empty() ? "" : read.messages.front();
  };
  EXPECT_EQ(told("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 2\n"),
            "a.g2o: line 1: the quaternion has the length 2.000000, it is normalised");
  EXPECT_EQ(told("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 4 0 0 -4 0 9\n" + kPlanarEdge +
                 "VERTEX_SE2 1 0 0 0\n"),
            "a.g2o: line 2: the edge is not used: the information matrix is not "
            "positive semidefinite");
  EXPECT_EQ(told("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 1 0 0 4 0 0 4 0 9\n"),
            "a.g2o: line 2: the edge is not used: it joins node 0 to itself");
  EXPECT_EQ(
      told("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nEDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\n"),
      "a.g2o: line 3: the edge is not used: the information matrix is zero");
  EXPECT_EQ(told("VERTEX_SE2 0 0 0 0\n" + kPlanarEdge),
            "a.g2o: line 2: there is no vertex 1, its pose is found from the edges");
}

TEST(G2oFile, BadRowsAreNamed)
{
  const std::string good = "VERTEX_SE2 0 0 0 0\n";
  for (const auto& [row, reason] : std::vector<std::pair<std::string, std::string>>{
           {"VERTEX_SE2 1 0 0", "the row is too short: 1 numbers are missing"},
           {"VERTEX_SE2 1 0 0 0 0", "the row is too long"},
           {"VERTEX_SE2", "the row is too short"},
           {"VERTEX_SE2 one 0 0 0", "\"one\" is not the number of a vertex"},
           {"VERTEX_SE2 -1 0 0 0", "\"-1\" is not the number of a vertex"},
           {"VERTEX_SE2 99999999999999999999 0 0 0",
            "\"99999999999999999999\" is not the number of a vertex"},
           {"VERTEX_SE2 1 nan 0 0", "\"nan\" is not a finite number"},
           {"VERTEX_SE2 1 1e999 0 0", "\"1e999\" is not a finite number"},
           {"VERTEX_SE2 0 1 1 1", "vertex 0 is there already, line 1"},
           {"VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0", "the quaternion has no length"},
           {"EDGE_SE2 0 1 1 0 0 4 0 0", "the row is too short: 3 numbers are missing"},
           {kSpatialEdge + kPlanarEdge.substr(0, 20),
            "the row is too short: 5 numbers are missing"},
           {"EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4",
            "vertex 0 is planar and spatial"},
           {"FIX 7", "there is no vertex 7 to be fixed"}}) {
    const std::string message = messageOf(good + row);
    const auto line = 2 + std::count(row.begin(), row.end(), '\n');
    EXPECT_EQ(message, "a.g2o: line " + std::to_string(line) + ": " + reason) << row;
  }
  EXPECT_EQ(messageOf("# nothing\n"), "a.g2o: has no vertex and no edge");
}

TEST(G2oFile, ManyMessagesAreCounted)
{
  std::string text = "VERTEX_SE2 0 0 0 0\n";
  for (int k = 0; k < 150; ++k)
    text += "TAG " + std::to_string(k) + '\n';
  const G2oGraph read = parseG2o(text, "a.g2o");
  EXPECT_EQ(read.messages.size(), 101U);
  EXPECT_EQ(read.messages.back(), "a.g2o: and 50 messages more");
  EXPECT_EQ(read.ignored_rows, 150U);
}

TEST(G2oFile, CompressedFiles)
{
  const std::filesystem::path folder = testing::TempDir();
  const std::string path = (folder / "graph.g2o.gz").string();
  const PoseGraph graph = randomGraph(2);
  writeG2o(path, graph);
  const std::string bytes = contentOf(path);
  EXPECT_EQ(bytes.substr(0, 2), "\x1f\x8b");
  EXPECT_LT(poseDifference(readG2o(path).graph, graph), 1e-14);
  G2oLimits limits;
  limits.max_bytes = bytes.size();
  EXPECT_THROW(readG2o(path, limits), InputError);
  for (const std::size_t size : {bytes.size() / 2, bytes.size() - 3, std::size_t{5}}) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, size);
    EXPECT_THROW(readG2o(path), InputError) << size;
  }
  std::filesystem::remove(path);
}

TEST(G2oFile, WhatG2oCannotHoldIsSaid)
{
  PoseGraph graph;
  graph.addNode(4, Eigen::Isometry3d::Identity());
  graph.addFactor(PositionFactor{4, kOrigin, kOrigin, Eigen::Matrix3d::Identity()});
  const std::string text = toG2o(graph);
  EXPECT_NE(text.find("# factor 0 on vertex 4 is not written"), std::string::npos);
  EXPECT_EQ(parseG2o(text, "a.g2o").graph.factors().size(), 0U);
}

TEST(G2oFile, PublicGraphsComeBackByteForByte)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "g2o");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".g2o")
      continue;
    const G2oGraph read = readG2o(entry.path().string());
    EXPECT_TRUE(read.messages.empty()) << entry.path();
    EXPECT_EQ(toG2o(read.graph, read.layout.get()), contentOf(entry.path()))
        << entry.path();
  }
}

} // namespace
