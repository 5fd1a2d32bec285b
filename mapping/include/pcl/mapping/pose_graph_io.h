// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>
#include <pcl/mapping/trajectory.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

class G2oLayout;

/** \brief A graph as a g2o file has it.
 * \ingroup mapping */
struct G2oGraph {
  PoseGraph graph;
  /** Rows of the file, for writing it back with nothing lost. */
  std::shared_ptr<const G2oLayout> layout;
  /** One line each, "FILE: line N: what": quaternions that were normalised, unknown
   * tags, edges that are kept but say nothing or are no valid measurement, nodes that
   * only edges name. */
  std::vector<std::string> messages;
  /** Rows that are kept in the file but are not part of the graph: unknown tags and
   * invalid edges. */
  std::size_t ignored_rows = 0;
};

/** \brief What is accepted of a g2o file. */
struct G2oLimits {
  /** Bytes of the file, and of the text in it if it is compressed. */
  std::size_t max_bytes = std::size_t{2} << 30U;
  /** Messages kept; of more, only the number. */
  std::size_t max_messages = 100;
};

/** \brief Read a g2o file, gzip-compressed if its name ends in .gz.
 *
 * Rows: VERTEX_SE2 id x y theta; VERTEX_SE3:QUAT id x y z qx qy qz qw; EDGE_SE2 i j x y
 * theta and 6 numbers; EDGE_SE3:QUAT i j x y z qx qy qz qw and 21 numbers, the upper
 * triangle of the information matrix by rows; FIX id...; EDGE_PRIOR... and all other
 * tags are kept and reported. '#' begins a comment. In space, g2o's rotational error is
 * half of ours, so its information is four times ours; the conversion is exact.
 *
 * \throws InputError "FILE: line N: reason" if the file cannot be read or a row of a
 * known tag is not what it should be: too few numbers, too many, not finite, a name
 * used twice, a quaternion of zero length */
PCL_NURBS_MAPPING_EXPORT G2oGraph
readG2o(const std::string& path, const G2oLimits& limits = {});

/** \brief The same from text. \param[in] name of it, for messages */
PCL_NURBS_MAPPING_EXPORT G2oGraph
parseG2o(std::string text, const std::string& name, const G2oLimits& limits = {});

/** \brief A graph as g2o text, numbers so that they are read back the same to the last
 * bit. With a layout (of a file that was read), its rows stay as they are, in their
 * order with comments and unknown tags; rows of nodes that moved get the new numbers,
 * rows of what was removed are left out and what is new is appended, planar graphs in
 * g2o's planar tags. Factors that g2o's standard tags cannot hold (positions,
 * directions) are written as comments that say so.
 * \param[in] graph the graph \param[in] layout null for none */
PCL_NURBS_MAPPING_EXPORT std::string
toG2o(const PoseGraph& graph, const G2oLayout* layout = nullptr);

/** \brief Write toG2o() to a file, gzip-compressed if its name ends in .gz.
 * \throws std::runtime_error "cannot write PATH: reason" */
PCL_NURBS_MAPPING_EXPORT void
writeG2o(const std::string& path,
         const PoseGraph& graph,
         const G2oLayout* layout = nullptr);

/** \brief Poses of the nodes in the order of their names, which are the stamps; without
 * those that have no estimate. */
PCL_NURBS_MAPPING_EXPORT Trajectory
trajectoryOf(const PoseGraph& graph);

} // namespace nurbs
} // namespace pcl
