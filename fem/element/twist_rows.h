#pragma once
#include <array>

#include "fem/element/twist_element.h"

/// From the coordinates of an element with torsion to the n of them that count (twist::Row), and back.
namespace nurbeam::twist {

template <int n>
Eigen::Matrix<double, n, 1> reduced_of(const TwistLayout::Coordinates& q) {
  Eigen::Matrix<double, n, 1> x;
  x.template head<reduced>() << q.segment<3>(TwistLayout::r(1)) - q.segment<3>(TwistLayout::r(0)),
      q.segment<3>(TwistLayout::slope(0)), q.segment<3>(TwistLayout::slope(1)), q.tail<3>();
  if constexpr (n > reduced) x.template tail<2>() = q.segment<2>(TwistLayout::place(0));
  return x;
}

/// The rows of the element's coordinates that a reduced row becomes, and with which sign.
struct Spread {
  int row;
  double sign;
};
inline std::array<Spread, 2> spread(int i) {
  if (i < slope_a) return {{{TwistLayout::r(1) + i, 1}, {TwistLayout::r(0) + i, -1}}};
  if (i < slope_b) return {{{TwistLayout::slope(0) + i - slope_a, 1}, {0, 0}}};
  if (i < angle_a) return {{{TwistLayout::slope(1) + i - slope_b, 1}, {0, 0}}};
  if (i < place_a) return {{{TwistLayout::angle(0) + i - angle_a, 1}, {0, 0}}};
  return {{{TwistLayout::place(i - place_a), 1}, {0, 0}}};
}

template <int n>
TwistLayout::Coordinates spread_out(const Eigen::Matrix<double, n, 1>& x) {
  TwistLayout::Coordinates q = TwistLayout::Coordinates::Zero();
  for (int i = 0; i < n; ++i)
    for (const auto& [row, sign] : spread(i)) q[row] += sign * x[i];
  return q;
}

template <int n>
TwistLayout::Matrix spread_out(const Eigen::Matrix<double, n, n>& x) {
  TwistLayout::Matrix K = TwistLayout::Matrix::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (const auto& [row, sign] : spread(i))
        for (const auto& [column, other_sign] : spread(j)) K(row, column) += sign * other_sign * x(i, j);
  return K;
}

}  // namespace nurbeam::twist
