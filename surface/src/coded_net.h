// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Control nets as the .nurbs format holds them. In two of the three quantised classes
// the position of a control point follows from its Greville abscissae (g, k) and one
// scalar: a height over a plane, or the inverse depth along the ray of a pixel.

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "integer_grid.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <variant>

namespace pcl {
namespace nurbs {

/** \brief Greville abscissae of the two directions. */
struct GrevilleGrid {
  GrevilleGrid(const KnotVector& knots_u, const KnotVector& knots_v);

  double
  centre(int direction) const;

  /** \brief Half the distance of the outermost abscissae. */
  double
  halfWidth(int direction) const;

  std::array<std::vector<double>, 2> values;
};

/** \brief Homogeneous control points, bit by bit. */
struct ExactNet {
  std::vector<double> values;

  NurbsSurface::HomogeneousPoints
  decoded(const GrevilleGrid& greville) const;
};

/** \brief Control points on a cubic lattice; weights if they differ. */
struct GeneralNet {
  std::int64_t step = 0;
  std::array<IntegerGrid, 3> coordinates;
  bool rational = false;
  std::int64_t weight_step = 0;
  IntegerGrid weights;

  NurbsSurface::HomogeneousPoints
  decoded(const GrevilleGrid& greville) const;
};

/** \brief Heights over a plane: origin + (g - g_c) a + (k - k_c) b + height n, with the
 * unit normal n along a x b. */
struct HeightNet {
  std::int64_t step = 0;
  bool orthogonal = true;
  std::array<double, 2> scales{1.0, 1.0}; /**< lengths of a and b, if orthogonal */
  int dropped = 0;                        /**< largest part of the quaternion */
  std::array<std::int64_t, 3> rotation{}; /**< the other parts, if orthogonal */
  std::array<std::int64_t, 6> axes{};     /**< a and b, if not */
  std::array<std::int64_t, 3> origin{};
  bool flat = false; /**< all heights are zero */
  IntegerGrid heights;

  struct Frame {
    Eigen::Vector3d origin, a, b, n;
  };

  Frame
  frame(const GrevilleGrid& greville) const;

  /** \brief Distance of the lattice planes that the origin lies on. */
  double
  frameStep() const;

  NurbsSurface::HomogeneousPoints
  decoded(const GrevilleGrid& greville) const;
};

/** \brief Inverse depths q along the rays of a camera: the homogeneous point is
 * (M (1, g, k) + q t, q). */
struct PerspectiveNet {
  std::array<double, 12> camera{}; /**< columns of M, then t */
  bool same_camera = false;        /**< as the perspective net before */
  std::int64_t step = 0;
  IntegerGrid inverse_depths;

  NurbsSurface::HomogeneousPoints
  decoded(const GrevilleGrid& greville) const;
};

using CodedNet = std::variant<ExactNet, GeneralNet, HeightNet, PerspectiveNet>;

/** \brief Every bit of the control points. */
ExactNet
exactNet(const NurbsSurface& surface);

/** \brief The cheapest class that holds the control points to the step; exact where
 * numbers leave the range of the lattice.
 * \param[in] surface surface to code
 * \param[in] greville abscissae of its knots
 * \param[in] coded_greville abscissae of the knots as they will be decoded
 * \param[in] step largest quantisation step, in the unit of the control points */
CodedNet
quantisedNet(const NurbsSurface& surface,
             const GrevilleGrid& greville,
             const GrevilleGrid& coded_greville,
             double step);

/** \brief Models of all control nets of one section. */
class NetCodec {
public:
  template <class Coder>
  void
  code(Coder& coder, CodedNet& net, const GrevilleGrid& greville);

private:
  template <class Coder>
  void
  codeNet(Coder& coder, ExactNet& net);
  template <class Coder>
  void
  codeNet(Coder& coder, GeneralNet& net);
  template <class Coder>
  void
  codeNet(Coder& coder, HeightNet& net);
  template <class Coder>
  void
  codeNet(Coder& coder, PerspectiveNet& net);

  template <class Coder>
  void
  codeStep(Coder& coder, std::int64_t& step);

  template <class Coder>
  void
  codeOrigin(Coder& coder, HeightNet& net);

  enum class Class { Exact, General, Height, Perspective };
  ChoiceModel<4, Class> class_;
  SignedModel step_;
  std::int64_t last_step_ = 0;
  DoubleSequenceModel exact_;
  IntegerGridCodec coordinate_;
  AdaptiveBit rational_;
  IntegerGridCodec weight_;
  SignedModel weight_step_;
  AdaptiveBit orthogonal_;
  DoubleModel scale_;
  UnsignedModel dropped_;
  SignedModel rotation_;
  SignedModel axis_;
  SignedModel origin_;
  Eigen::Vector3d last_origin_ = Eigen::Vector3d::Zero();
  AdaptiveBit flat_;
  IntegerGridCodec height_;
  AdaptiveBit same_camera_;
  DoubleModel camera_;
  std::array<double, 12> last_camera_{};
  IntegerGridCodec inverse_depth_;
};

extern template void
NetCodec::code(RangeEncoder&, CodedNet&, const GrevilleGrid&);
extern template void
NetCodec::code(RangeDecoder&, CodedNet&, const GrevilleGrid&);

} // namespace nurbs
} // namespace pcl
