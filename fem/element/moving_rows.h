#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/jet.h"

namespace nurbeam {

/// Rows of the shape functions and their derivatives along s that forces need, and with two derivatives
/// wanted also those that tangents need; one column a shape function.
struct MovingRows {
  using Row = Eigen::Vector4d;
  struct Series {
    Row value;
    std::array<Row, 2> first;   ///< by the end positions a, b
    std::array<Row, 3> second;  ///< by aa, ab, bb; of r_s and r_ss for tangents only
  };
  Series r, rs, rss;
  std::array<Row, 4> r_third;  ///< of r, by aaa, aab, abb, bbb; for tangents only
  Row rsss;
  std::array<Row, 2> rsss_first;  ///< by a, b; for tangents only
  double kappa0 = 0;  ///< curvature of the drawing [1/m], and its derivatives by the end positions
  std::array<double, 2> kappa0_first{};
  std::array<double, 3> kappa0_second{};  ///< for tangents only

  void set_curvature(const Jet& series) {
    kappa0 = series.value();
    kappa0_first = {series.d(0), series.d(1)};
    kappa0_second = {series.d(0, 0), series.d(0, 1), series.d(1, 1)};
  }
};

}  // namespace nurbeam
