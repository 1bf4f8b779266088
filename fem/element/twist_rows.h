#pragma once
#include <array>

#include "fem/element/twist_element.h"

/// Maps between the coordinates of an element with torsion and the n coordinates that count (twist::Row).
namespace nurbeam::twist {

template <int n>
Eigen::Matrix<double, n, 1> reduced_of(const TwistLayout::Coordinates& q) {
  Eigen::Matrix<double, n, 1> x;
  x.template head<reduced>() << q.segment<3>(TwistLayout::r(1)) - q.segment<3>(TwistLayout::r(0)),
      q.segment<3>(TwistLayout::slope(0)), q.segment<3>(TwistLayout::slope(1)), q.tail<3>();
  if constexpr (n > reduced) x.template tail<2>() = q.segment<2>(TwistLayout::place(0));
  return x;
}

/// The row of the element's coordinates for each reduced row. The chord is r_B - r_A, so that the row of r_A
/// is subtracted from its row.
inline constexpr std::array<int, reduced + 2> element_row = [] {
  using Layout = TwistLayout;
  std::array<int, reduced + 2> rows{};
  for (int d = 0; d < 3; ++d) {
    rows[chord + d] = Layout::r(1) + d;
    rows[slope_a + d] = Layout::slope(0) + d;
    rows[slope_b + d] = Layout::slope(1) + d;
  }
  for (const int end : {0, 1}) {
    rows[angle_of(end)] = Layout::angle(end);
    rows[place_a + end] = Layout::place(end);
  }
  rows[bubble] = Layout::bubble;
  return rows;
}();

template <int n>
TwistLayout::Coordinates spread_out(const Eigen::Matrix<double, n, 1>& x) {
  TwistLayout::Coordinates q = TwistLayout::Coordinates::Zero();
  for (int i = 0; i < n; ++i) q[element_row[i]] = x[i];
  q.segment<3>(TwistLayout::r(0)) = -x.template segment<3>(chord);
  return q;
}

template <int n>
TwistLayout::Matrix spread_out(const Eigen::Matrix<double, n, n>& x) {
  TwistLayout::Matrix K = TwistLayout::Matrix::Zero();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) K(element_row[i], element_row[j]) = x(i, j);
  K.middleRows<3>(TwistLayout::r(0)) = -K.middleRows<3>(TwistLayout::r(1));
  K.middleCols<3>(TwistLayout::r(0)) = -K.middleCols<3>(TwistLayout::r(1));
  return K;
}

}  // namespace nurbeam::twist
