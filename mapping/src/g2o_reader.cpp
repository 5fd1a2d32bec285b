// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "g2o_layout.h"
#include "g2o_numbers.h"
#include "gzip_text.h"
#include "input_file.h"
#include "line_words.h"

#include <array>
#include <unordered_map>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kUnitLength = 1e-3; // how far quaternions are off in files, silently

class G2oParser {
public:
  G2oParser(std::string text, std::string name, const G2oLimits& limits)
      : layout_(std::make_shared<G2oLayout>(std::move(text))),
        name_(std::move(name)),
        limits_(limits)
  {
  }

  G2oGraph
  parse()
  {
    const std::string_view text = layout_->text();
    for (std::size_t position = 0; position < text.size();) {
      const std::size_t end = std::min(text.find('\n', position), text.size());
      ++line_;
      parseLine(text.substr(position, end - position));
      position = end + 1;
    }
    if (graph_.nodes().empty())
      throw InputError(name_, "has no vertex and no edge");
    applyFixes();
    reportUnplacedNodes();
    return finish();
  }

private:
  [[noreturn]] void
  fail(const std::string& reason) const
  {
    throw InputError(name_, "line " + std::to_string(line_) + ": " + reason);
  }

  void
  tell(const std::string& what)
  {
    if (result_.messages.size() < limits_.max_messages)
      result_.messages.push_back(name_ + ": line " + std::to_string(line_) + ": " +
                                 what);
    else
      ++untold_;
  }

  void
  parseLine(std::string_view line)
  {
    layout_->rows.push_back({G2oRowKind::Kept, line, 0});
    words_ = LineWords(line.substr(0, line.find('#')));
    const std::string_view tag = words_.next();
    if (tag.empty())
      return;
    if (tag == "VERTEX_SE2")
      parseNode(true);
    else if (tag == "VERTEX_SE3:QUAT")
      parseNode(false);
    else if (tag == "EDGE_SE2")
      parseEdge(true);
    else if (tag == "EDGE_SE3:QUAT")
      parseEdge(false);
    else if (tag == "FIX")
      parseFix();
    else {
      ++result_.ignored_rows;
      tell("tag \"" + std::string(tag.substr(0, 40)) +
           "\" is unknown, row kept as it is");
    }
  }

  NodeId
  idOf(std::string_view word) const
  {
    NodeId id = 0;
    if (!parseNumber(word, id))
      fail("\"" + std::string(word.substr(0, 20)) + "\" is not the number of a vertex");
    return id;
  }

  NodeId
  nextId()
  {
    const std::string_view word = words_.next();
    if (word.empty())
      fail("the row is too short");
    return idOf(word);
  }

  /** So many finite numbers, and no more words after them. */
  void
  nextNumbers(double* numbers, int count)
  {
    for (int k = 0; k < count; ++k) {
      const std::string_view word = words_.next();
      if (word.empty())
        fail("the row is too short: " + std::to_string(count - k) +
             " numbers are missing");
      if (!parseNumber(word, numbers[k]) || !std::isfinite(numbers[k]))
        fail("\"" + std::string(word.substr(0, 20)) + "\" is not a finite number");
    }
    if (!words_.next().empty())
      fail("the row is too long");
  }

  /** Pose from x y z qx qy qz qw. */
  Eigen::Isometry3d
  spatialPose(const double* n)
  {
    const Eigen::Quaterniond rotation(n[6], n[3], n[4], n[5]);
    const double length = rotation.norm();
    if (!(length > 1e-9))
      fail("the quaternion has no length");
    if (std::abs(length - 1.0) > kUnitLength)
      tell("the quaternion has the length " + std::to_string(length) +
           ", it is normalised");
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << n[0], n[1], n[2];
    pose.linear() = rotation.normalized().toRotationMatrix();
    return pose;
  }

  void
  parseNode(bool planar)
  {
    const NodeId id = nextId();
    std::array<double, 7> numbers{};
    nextNumbers(numbers.data(), planar ? 3 : 7);
    const auto [place, is_new] = vertex_lines_.try_emplace(id, line_);
    if (!is_new)
      fail("vertex " + std::to_string(id) + " is there already, line " +
           std::to_string(place->second));
    const Eigen::Isometry3d pose =
        planar ? planarPose(numbers.data()) : spatialPose(numbers.data());
    addNode(id, planar);
    graph_.setPose(id, pose);
    layout_->rows.back().kind = G2oRowKind::Node;
    layout_->rows.back().id = id;
  }

  void
  addNode(NodeId id, bool planar)
  {
    if (!graph_.hasNode(id)) {
      graph_.addNode(id, planar);
      first_lines_.emplace(id, line_);
    }
    else if (graph_.node(id).planar != planar)
      fail("vertex " + std::to_string(id) + " is planar and spatial");
  }

  void
  parseEdge(bool planar)
  {
    BetweenFactor factor;
    factor.from = nextId();
    factor.to = nextId();
    std::array<double, 28> numbers{};
    nextNumbers(numbers.data(), planar ? 9 : 28);
    factor.T_from_to =
        planar ? planarPose(numbers.data()) : spatialPose(numbers.data());
    factor.information = planar ? planarInformation(numbers.data() + 3)
                                : spatialInformation(numbers.data() + 7);
    addNode(factor.from, planar);
    addNode(factor.to, planar);
    const std::string flaw = flawOf(factor);
    if (!flaw.empty()) {
      ++result_.ignored_rows;
      tell("the edge is not used: " + flaw);
      return;
    }
    layout_->rows.back().kind = G2oRowKind::Factor;
    layout_->rows.back().id = graph_.addFactor(factor);
  }

  void
  parseFix()
  {
    layout_->rows.back().kind = G2oRowKind::Fix;
    layout_->rows.back().id = layout_->fixes.size();
    layout_->fixes.push_back({nextId()});
    fix_lines_.push_back(line_);
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next())
      layout_->fixes.back().push_back(idOf(word));
  }

  void
  applyFixes()
  {
    for (std::size_t k = 0; k < fix_lines_.size(); ++k)
      for (const NodeId id : layout_->fixes[k]) {
        line_ = fix_lines_[k];
        if (!graph_.hasNode(id))
          fail("there is no vertex " + std::to_string(id) + " to be fixed");
        if (!graph_.node(id).has_estimate)
          fail("vertex " + std::to_string(id) + " has no pose to be fixed at");
        graph_.setFixed(id, true);
      }
  }

  /** A file without vertices is usual; one in which some are missing is not. */
  void
  reportUnplacedNodes()
  {
    if (vertex_lines_.empty())
      return;
    for (const auto& [id, node] : graph_.nodes())
      if (!node.has_estimate) {
        line_ = first_lines_.at(id);
        tell("there is no vertex " + std::to_string(id) +
             ", its pose is found from the edges");
      }
  }

  G2oGraph
  finish()
  {
    if (untold_ > 0)
      result_.messages.push_back(name_ + ": and " + std::to_string(untold_) +
                                 " messages more");
    layout_->graph = graph_;
    result_.graph = std::move(graph_);
    result_.layout = layout_;
    return std::move(result_);
  }

  std::shared_ptr<G2oLayout> layout_;
  std::string name_;
  G2oLimits limits_;
  G2oGraph result_;
  PoseGraph graph_;
  LineWords words_{std::string_view()};
  std::size_t line_ = 0;
  std::size_t untold_ = 0;
  std::unordered_map<NodeId, std::size_t> vertex_lines_;
  std::unordered_map<NodeId, std::size_t> first_lines_; // where a name comes up first
  std::vector<std::size_t> fix_lines_;
};

} // namespace

G2oGraph
parseG2o(std::string text, const std::string& name, const G2oLimits& limits)
{
  return G2oParser(std::move(text), name, limits).parse();
}

G2oGraph
readG2o(const std::string& path, const G2oLimits& limits)
{
  InputFile file = loadInputFile(path, limits.max_bytes);
  if (isGzip(file.bytes))
    file.bytes = inflateGzip(file, limits.max_bytes);
  return parseG2o(std::move(file.bytes), path, limits);
}

} // namespace nurbs
} // namespace pcl
