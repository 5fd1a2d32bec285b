// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_io.h>

#include <string_view>
#include <vector>

namespace pcl {
namespace nurbs {

/** What a row of a g2o file stands for. */
enum class G2oRowKind {
  Kept, /**< a comment, an empty line, an unknown tag, an edge that is not in the graph
         */
  Node,
  Factor,
  Fix
};

/** One line of a g2o file, without its end. */
struct G2oRow {
  G2oRowKind kind = G2oRowKind::Kept;
  std::string_view text;
  std::uint64_t id = 0; /**< of the node or factor; place among the layout's fixes */
};

/** The rows of a g2o file and what they said. */
class G2oLayout {
public:
  explicit G2oLayout(std::string text) : text_(std::move(text)) {}

  G2oLayout(const G2oLayout&) = delete;
  G2oLayout&
  operator=(const G2oLayout&) = delete;

  std::string_view
  text() const
  {
    return text_;
  }

  std::vector<G2oRow> rows;
  std::vector<std::vector<NodeId>> fixes; /**< what each FIX row names */
  PoseGraph graph; /**< as it was read, so that what has changed is known */

private:
  std::string text_;
};

} // namespace nurbs
} // namespace pcl
