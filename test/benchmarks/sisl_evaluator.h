// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#ifdef PCL_NURBS_HAVE_SISL

#include "../support/sisl_surface.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {
namespace bench {

using test::SislSurface;
using test::toSisl;

/** \brief SISL reports errors by negative states. */
inline void
checkSisl(int state, const char* routine)
{
  if (state < 0)
    throw std::runtime_error(std::string(routine) +
                             " failed: " + std::to_string(state));
}

/** \brief Evaluation by s1421, which keeps the last knot span as its hint. */
class SislEvaluator {
public:
  explicit SislEvaluator(SislSurface surface) : surface_(std::move(surface)) {}

  /** \brief Point and derivatives up to the total order \a order, by rising order. */
  template <int order>
  Eigen::Matrix<double, 3, (order + 1) * (order + 2) / 2>
  evaluate(double u, double v)
  {
    Eigen::Matrix<double, 3, (order + 1) * (order + 2) / 2> values;
    double parameter[2] = {u, v};
    double normal[3];
    int state = 0;
    s1421(surface_.get(),
          order,
          parameter,
          &span_u_,
          &span_v_,
          values.data(),
          normal,
          &state);
    checkSisl(state, "s1421");
    return values;
  }

private:
  SislSurface surface_;
  int span_u_ = 0;
  int span_v_ = 0;
};

} // namespace bench
} // namespace nurbs
} // namespace pcl

#endif
