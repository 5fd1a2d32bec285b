// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>
#include <pcl/surface/nurbs/obj_io.h>

#include <array>
#include <charconv>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kItemsPerLine = 12;

class ObjWriter {
public:
  explicit ObjWriter(const SurfaceModel& model)
  {
    text_ = "# B-spline surfaces of PCL-NURBS\n";
    for (const SurfacePatch& patch : model.patches)
      add(patch);
  }

  std::string
  takeText()
  {
    return std::move(text_);
  }

private:
  void
  add(const SurfacePatch& patch)
  {
    const int first_curve = curves_ + 1;
    for (const TrimLoop& loop : patch.geometry.loops())
      for (const NurbsCurve2& curve : loop.curves())
        add(curve);
    const NurbsSurface& surface = patch.geometry.surface();
    addPoints<3>("v", surface.homogeneousPoints());
    const int first_point = points_ + 1;
    points_ += surface.numControlPoints();
    text_ += "g label_" + std::to_string(patch.label) + "\ncstype rat bspline\ndeg " +
             std::to_string(surface.knotsU().degree()) + ' ' +
             std::to_string(surface.knotsV().degree()) + "\nsurf";
    addDomain(surface.knotsU());
    addDomain(surface.knotsV());
    items_ = 4;
    // OBJ counts u first, the kernel v.
    for (int j = 0; j < surface.numControlPointsV(); ++j)
      for (int i = 0; i < surface.numControlPointsU(); ++i)
        addItem(std::to_string(first_point + i * surface.numControlPointsV() + j));
    addKnots("\nparm u", surface.knotsU());
    addKnots("\nparm v", surface.knotsV());
    text_ += '\n';
    addLoops(patch.geometry.loops(), first_curve);
    text_ += "end\n";
  }

  void
  add(const NurbsCurve2& curve)
  {
    addPoints<2>("vp", curve.homogeneousPoints());
    text_ += "cstype rat bspline\ndeg " + std::to_string(curve.degree()) + "\ncurv2";
    items_ = 0;
    for (int i = 0; i < curve.numControlPoints(); ++i)
      addItem(std::to_string(++parameter_points_));
    addKnots("\nparm u", curve.knots());
    text_ += "\nend\n";
    ++curves_;
  }

  void
  addLoops(const std::vector<TrimLoop>& loops, int curve)
  {
    for (const TrimLoop& loop : loops) {
      text_ += loop.signedArea() < 0.0 ? "hole" : "trim";
      items_ = 0;
      for (const NurbsCurve2& part : loop.curves()) {
        addDomain(part.knots());
        addItem(std::to_string(curve++));
      }
      text_ += '\n';
    }
  }

  template <int Dim>
  void
  addPoints(const char* keyword,
            const Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>& homogeneous)
  {
    for (Eigen::Index i = 0; i < homogeneous.cols(); ++i) {
      text_ += keyword;
      for (int d = 0; d < Dim; ++d)
        addNumber(homogeneous(d, i) / homogeneous(Dim, i));
      addNumber(homogeneous(Dim, i));
      text_ += '\n';
    }
  }

  void
  addKnots(const char* keyword, const KnotVector& knots)
  {
    text_ += keyword;
    items_ = 0;
    for (double knot : knots.values()) {
      wrap();
      addNumber(knot);
    }
  }

  void
  addDomain(const KnotVector& knots)
  {
    addNumber(knots.domainMin());
    addNumber(knots.domainMax());
  }

  void
  addNumber(double value)
  {
    std::array<char, 32> digits; // enough for every double
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text_ += ' ';
    text_.append(digits.data(), end.ptr);
  }

  void
  addItem(const std::string& item)
  {
    wrap();
    text_ += ' ' + item;
  }

  /** Continue a long statement on the next line. */
  void
  wrap()
  {
    if (items_ > 0 && items_ % kItemsPerLine == 0)
      text_ += " \\\n";
    ++items_;
  }

  std::string text_;
  int points_ = 0;
  int parameter_points_ = 0;
  int curves_ = 0;
  int items_ = 0;
};

} // namespace

std::string
toObj(const SurfaceModel& model)
{
  return ObjWriter(model).takeText();
}

void
writeObjFile(const std::string& path, const SurfaceModel& model)
{
  writeFileAtomically(path, toObj(model));
}

} // namespace nurbs
} // namespace pcl
