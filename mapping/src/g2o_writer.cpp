// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "g2o_layout.h"
#include "gzip_text.h"

#include <pcl/surface/nurbs/atomic_file.h>

#include <array>
#include <charconv>
#include <cmath>
#include <set>

namespace pcl {
namespace nurbs {
namespace {

void
put(std::string& text, double number)
{
  std::array<char, 32> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
  text += ' ';
  text.append(buffer.data(), result.ptr);
}

void
put(std::string& text, NodeId id)
{
  text += ' ';
  text += std::to_string(id);
}

void
putPose(std::string& text, const Eigen::Isometry3d& pose, bool planar)
{
  const Eigen::Matrix3d& rotation = pose.linear();
  for (Eigen::Index k = 0; k < (planar ? 2 : 3); ++k)
    put(text, pose.translation()(k));
  if (planar) {
    put(text, std::atan2(rotation(1, 0), rotation(0, 0)));
    return;
  }
  const Eigen::Quaterniond q(rotation);
  for (const double number : {q.x(), q.y(), q.z(), q.w()})
    put(text, number);
}

template <typename Matrix>
void
putUpper(std::string& text, const Matrix& matrix)
{
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = row; column < matrix.cols(); ++column)
      put(text, matrix(row, column));
}

/** Information about a Tangent as one about x, y, angle. */
Eigen::Matrix3d
planarBlock(const TangentMatrix& information)
{
  Eigen::Matrix3d block;
  block << information(0, 0), information(0, 1), information(0, 5), information(1, 0),
      information(1, 1), information(1, 5), information(5, 0), information(5, 1),
      information(5, 5);
  return block;
}

/** g2o's error in space has half of our rotation. */
TangentMatrix
fileInformation(TangentMatrix information)
{
  information.rightCols<3>() *= 2.0;
  information.bottomRows<3>() *= 2.0;
  return information;
}

bool
sameMeasurement(const BetweenFactor& a, const BetweenFactor& b)
{
  return a.from == b.from && a.to == b.to &&
         a.T_from_to.matrix() == b.T_from_to.matrix() && a.information == b.information;
}

class G2oWriter {
public:
  G2oWriter(const PoseGraph& graph, const G2oLayout* layout)
      : graph_(graph), layout_(layout)
  {
  }

  std::string
  write()
  {
    if (layout_ != nullptr)
      writeRows();
    const std::size_t rows_end = text_.size();
    for (const auto& [id, node] : graph_.nodes())
      if (node.has_estimate && written_nodes_.count(id) == 0)
        writeNode(id, node);
    for (const auto& [id, node] : graph_.nodes())
      if (node.fixed && written_fixes_.count(id) == 0)
        line("FIX " + std::to_string(id));
    for (const auto& [id, factor] : graph_.factors())
      if (written_factors_.count(id) == 0)
        writeFactor(id, factor.measurement);
    const bool whole = layout_ == nullptr || layout_->text().back() == '\n';
    if (!whole && text_.size() == rows_end) // the last line had no end
      text_.pop_back();
    return std::move(text_);
  }

private:
  void
  line(std::string_view words)
  {
    text_ += words;
    text_ += '\n';
  }

  void
  writeRows()
  {
    for (const G2oRow& row : layout_->rows)
      switch (row.kind) {
      case G2oRowKind::Kept:
        line(row.text);
        break;
      case G2oRowKind::Node:
        writeNodeRow(row);
        break;
      case G2oRowKind::Factor:
        writeFactorRow(row);
        break;
      case G2oRowKind::Fix:
        writeFixRow(row);
        break;
      }
  }

  void
  writeNodeRow(const G2oRow& row)
  {
    const auto found = graph_.nodes().find(row.id);
    if (found == graph_.nodes().end())
      return;
    written_nodes_.insert(row.id);
    const PoseNode& before = layout_->graph.node(row.id);
    if (found->second.planar == before.planar &&
        found->second.T_world_node.matrix() == before.T_world_node.matrix())
      line(row.text);
    else
      writeNode(row.id, found->second);
  }

  void
  writeFactorRow(const G2oRow& row)
  {
    const auto found = graph_.factors().find(row.id);
    if (found == graph_.factors().end())
      return;
    const auto* now = std::get_if<BetweenFactor>(&found->second.measurement);
    const auto& before =
        std::get<BetweenFactor>(layout_->graph.factor(row.id).measurement);
    if (now == nullptr || !sameMeasurement(*now, before))
      return; // another graph's factor of that name
    written_factors_.insert(row.id);
    line(row.text);
  }

  /** A row may fix several; it stays if they all still are. */
  void
  writeFixRow(const G2oRow& row)
  {
    std::vector<NodeId> fixed;
    bool all = true;
    for (const NodeId id : layout_->fixes[row.id]) {
      const auto found = graph_.nodes().find(id);
      if (found != graph_.nodes().end() && found->second.fixed)
        fixed.push_back(id);
      else
        all = false;
    }
    written_fixes_.insert(fixed.begin(), fixed.end());
    if (all)
      line(row.text);
    else
      for (const NodeId id : fixed)
        line("FIX " + std::to_string(id));
  }

  void
  writeNode(NodeId id, const PoseNode& node)
  {
    text_ += node.planar ? "VERTEX_SE2" : "VERTEX_SE3:QUAT";
    put(text_, id);
    putPose(text_, node.T_world_node, node.planar);
    text_ += '\n';
  }

  void
  writeFactor(FactorId id, const Measurement& measurement)
  {
    const auto* between = std::get_if<BetweenFactor>(&measurement);
    if (between == nullptr) {
      line("# factor " + std::to_string(id) + " on vertex " +
           std::to_string(nodesOf(measurement).front()) +
           " is not written: g2o has no standard tag for it");
      return;
    }
    const bool planar =
        graph_.node(between->from).planar && graph_.node(between->to).planar;
    text_ += planar ? "EDGE_SE2" : "EDGE_SE3:QUAT";
    put(text_, between->from);
    put(text_, between->to);
    putPose(text_, between->T_from_to, planar);
    if (planar)
      putUpper(text_, planarBlock(between->information));
    else
      putUpper(text_, fileInformation(between->information));
    text_ += '\n';
  }

  const PoseGraph& graph_;
  const G2oLayout* layout_;
  std::string text_;
  std::set<NodeId> written_nodes_;
  std::set<NodeId> written_fixes_;
  std::set<FactorId> written_factors_;
};

} // namespace

std::string
toG2o(const PoseGraph& graph, const G2oLayout* layout)
{
  return G2oWriter(graph, layout).write();
}

void
writeG2o(const std::string& path, const PoseGraph& graph, const G2oLayout* layout)
{
  const std::string text = toG2o(graph, layout);
  const std::string_view ending = ".gz";
  const bool compressed =
      path.size() > ending.size() &&
      path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  writeFileAtomically(path, compressed ? deflateGzip(text) : text);
}

Trajectory
trajectoryOf(const PoseGraph& graph)
{
  Trajectory result;
  for (const auto& [id, node] : graph.nodes())
    if (node.has_estimate)
      result.push_back({static_cast<double>(id), node.T_world_node});
  return result;
}

} // namespace nurbs
} // namespace pcl
