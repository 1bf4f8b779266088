#include "fem/element/chart_place.h"

namespace nurbeam {

ChartPlace place_of(const ReferenceCurve& curve, int segment, double s) {
  const int j = segment < 0 ? curve.segment_at(s) : segment;
  const double u = curve.parameter(j, s);
  const ChartGeometry g = curve.geometry(j, u);
  const double i = 1 / g.stretch[0], i3 = i * i * i, J1 = g.stretch[1];
  const std::array<double, 4> u_along{u, i, -J1 * i3,
                                      (3 * J1 * J1 - g.stretch[0] * g.stretch[2]) * i3 * i * i};
  const auto k = along(g.curvature, u_along);
  if (segment < 0) return {{s, 1, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}, {k[0], k[1], k[2]}};
  return {u_along, g.stretch, g.weight, {k[0], k[1], k[2]}};
}

std::array<double, 4> along(const std::array<double, 4>& f, const std::array<double, 4>& u) {
  return {f[0], f[1] * u[1], f[2] * u[1] * u[1] + f[1] * u[2],
          f[3] * u[1] * u[1] * u[1] + 3 * f[2] * u[1] * u[2] + f[1] * u[3]};
}

Jet curvature_at(const std::array<double, 3>& kappa0, const Jet& s) {
  const auto& [k0, k1, k2] = kappa0;
  const double a = s.d(0), b = s.d(1);
  return Jet(Jet::Coefficients{k0, a * k1, b * k1, a * a * k2 / 2, a * b * k2, b * b * k2 / 2});
}

Eigen::RowVector4d hermite_at(double u, double weight, double u_a, double l) {
  const double xi = (u - u_a) / l, xi2 = xi * xi, xi3 = xi2 * xi;
  return Eigen::RowVector4d(1 - 3 * xi2 + 2 * xi3, l * (xi - 2 * xi2 + xi3), 3 * xi2 - 2 * xi3,
                            l * (xi3 - xi2)) /
         weight;
}

Eigen::Matrix<double, 5, 4> hermite_along(const ChartPlace& p, double u_a, double l) {
  const double xi = (p.u[0] - u_a) / l, xi2 = xi * xi, xi3 = xi2 * xi, i = 1 / l;
  Eigen::Matrix<double, 5, 4> f;  // functions and derivatives by u
  f.row(0) << 1 - 3 * xi2 + 2 * xi3, l * (xi - 2 * xi2 + xi3), 3 * xi2 - 2 * xi3, l * (xi3 - xi2);
  f.row(1) << 6 * i * (xi2 - xi), 1 - 4 * xi + 3 * xi2, 6 * i * (xi - xi2), 3 * xi2 - 2 * xi;
  f.row(2) << i * i * (12 * xi - 6), i * (6 * xi - 4), i * i * (6 - 12 * xi), i * (6 * xi - 2);
  f.row(3) << 12 * i * i * i, 6 * i * i, -12 * i * i * i, 6 * i * i;
  f.row(4).setZero();
  const double iW = 1 / p.W[0], W1 = p.W[1], W2 = p.W[2], W3 = p.W[3];
  f.row(0) *= iW;
  f.row(1) = (f.row(1) - W1 * f.row(0)) * iW;
  f.row(2) = (f.row(2) - 2 * W1 * f.row(1) - W2 * f.row(0)) * iW;
  f.row(3) = (f.row(3) - 3 * W1 * f.row(2) - 3 * W2 * f.row(1) - W3 * f.row(0)) * iW;
  f.row(4) = (-4 * W1 * f.row(3) - 6 * W2 * f.row(2) - 4 * W3 * f.row(1)) * iW;
  const auto& [J, J1, J2, J3] = p.J;
  const double iJ = 1 / J, iJ2 = iJ * iJ;
  f.row(1) *= iJ;
  f.row(2) = (f.row(2) - J1 * f.row(1)) * iJ2;
  f.row(3) = (f.row(3) - J2 * f.row(1) - 3 * J1 * J * f.row(2)) * iJ2 * iJ;
  f.row(4) = (f.row(4) - J3 * f.row(1) - (4 * J * J2 + 3 * J1 * J1) * f.row(2) - 6 * J * J * J1 * f.row(3)) *
             iJ2 * iJ2;
  return f;
}

}  // namespace nurbeam
