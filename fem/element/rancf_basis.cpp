#include "fem/element/rancf_basis.h"

namespace nurbeam {

NodalCoordinates to_rancf(const RationalCubic& cubic, double l) {
  NodalCoordinates e;
  const Eigen::Vector3d P0 = cubic.control_point(0), P3 = cubic.control_point(3);
  e.col(0) = P0;
  e.col(1) = 3 * cubic.weight(1) / (l * cubic.weight(0)) * (cubic.control_point(1) - P0);
  e.col(2) = P3;
  e.col(3) = 3 * cubic.weight(2) / (l * cubic.weight(3)) * (P3 - cubic.control_point(2));
  return e;
}

RationalCubic to_bezier(const NodalCoordinates& e, const Eigen::Vector4d& w, double l) {
  Eigen::Matrix4d points;
  points.row(3) = w.transpose();
  points.col(0).head<3>() = w[0] * e.col(0);
  points.col(1).head<3>() = w[1] * e.col(0) + l * w[0] / 3 * e.col(1);
  points.col(2).head<3>() = w[2] * e.col(2) - l * w[3] / 3 * e.col(3);
  points.col(3).head<3>() = w[3] * e.col(2);
  return RationalCubic(points);
}

namespace {

// u(s) and its first three s-derivatives from the stretch J = ds/du.
std::array<double, 4> inverse_derivatives(double u, const std::array<double, 4>& J) {
  const double i = 1 / J[0], i3 = i * i * i;
  return {u, i, -J[1] * i3, (3 * J[1] * J[1] - J[0] * J[2]) * i3 * i * i};
}

std::array<double, 4> shifted(const std::array<double, 4>& f) { return {f[1], f[2], f[3], 0}; }

template <class T>
struct ChartPoint {
  T u, J, Ju, Juu;     // stretch and its u-derivatives
  T W, Wu, Wuu, Wuuu;  // weight and its u-derivatives
  T kappa0;
};

// Drawn curvature as a function of s, from its u-derivatives.
template <class T>
T curvature_along(const ChartGeometry& g, const T& s) {
  const auto& [k, k1, k2, unused] = g.curvature;
  const double J = g.stretch[0], ks = k1 / J;
  return compose({k, ks, (k2 - ks * g.stretch[1]) / (J * J), 0}, s);
}

template <class T>
ChartPoint<T> segment_point(const ReferenceCurve& curve, int segment, const T& s) {
  const double u0 = curve.parameter(segment, value(s));
  const ChartGeometry g = curve.geometry(segment, u0);
  const T u = compose(inverse_derivatives(u0, g.stretch), s);
  const auto J1 = shifted(g.stretch), W1 = shifted(g.weight);
  return {u,
          compose(g.stretch, u),
          compose(J1, u),
          compose(shifted(J1), u),
          compose(g.weight, u),
          compose(W1, u),
          compose(shifted(W1), u),
          T(g.weight[3]),
          compose(g.curvature, u)};
}

template <class T>
ChartPoint<T> arc_length_point(const ReferenceCurve& curve, const T& s) {
  const int j = curve.segment_at(value(s));
  const ChartGeometry g = curve.geometry(j, curve.parameter(j, value(s)));
  return {s, T(1), T(0), T(0), T(1), T(0), T(0), T(0), curvature_along(g, s)};
}

template <class T>
ChartPoint<T> chart_point(const ReferenceCurve& curve, const Chart& chart, const T& s) {
  return chart.segment < 0 ? arc_length_point(curve, s) : segment_point(curve, chart.segment, s);
}

// The paper's weights: W(xi) and its first three u-derivatives, u = u_A + xi l.
template <class T>
void set_constant_weights(const std::array<double, 4>& w, const T& xi, const T& l, ChartPoint<T>& p) {
  const double d1[3] = {3 * (w[1] - w[0]), 3 * (w[2] - w[1]), 3 * (w[3] - w[2])};
  const double d2[2] = {2 * (d1[1] - d1[0]), 2 * (d1[2] - d1[1])};
  const double d3 = d2[1] - d2[0];
  p.W = w[0] + xi * (d1[0] + xi * (d2[0] / 2 + xi * (d3 / 6)));
  p.Wu = (d1[0] + xi * (d2[0] + xi * (d3 / 2))) / l;
  p.Wuu = (d2[0] + xi * d3) / (l * l);
  p.Wuuu = d3 / (l * l * l);
}

}  // namespace

template <class T>
ElementBasis<T>::ElementBasis(const ReferenceCurve& curve, const Chart& chart, const T& s_a, const T& s_b)
    : curve_(&curve), chart_(chart), a_(end(s_a)), b_(end(s_b)) {
  if (!chart_.constant_weights) return;
  const auto& w = *chart_.constant_weights;
  const T l = b_.u - a_.u;
  a_.W = w[0];
  a_.Wu = 3 * (w[1] - w[0]) / l;
  b_.W = w[3];
  b_.Wu = 3 * (w[3] - w[2]) / l;
}

template <class T>
typename ElementBasis<T>::End ElementBasis<T>::end(const T& s) const {
  const ChartPoint<T> p = chart_point(*curve_, chart_, s);
  return {p.u, p.J, p.W, p.Wu};
}

template <class T>
std::array<T, 4> ElementBasis<T>::weights() const {
  if (chart_.constant_weights) {
    const auto& w = *chart_.constant_weights;
    return {T(w[0]), T(w[1]), T(w[2]), T(w[3])};
  }
  const T third = length() / 3;
  return {a_.W, a_.W + third * a_.Wu, b_.W - third * b_.Wu, b_.W};
}

template <class T>
ShapeFunctions<T> ElementBasis<T>::at(const T& s) const {
  ChartPoint<T> p = chart_point(*curve_, chart_, s);
  const T l = b_.u - a_.u;
  const T xi = (p.u - a_.u) / l;
  if (chart_.constant_weights) set_constant_weights(*chart_.constant_weights, xi, l, p);

  const T i1 = 1.0 / l, i2 = i1 * i1, i3 = i2 * i1;
  // Hermite functions and their xi-derivatives.
  const T xi2 = xi * xi, xi3 = xi2 * xi;
  const std::array<T, 4> h{1.0 - 3.0 * xi2 + 2.0 * xi3, xi - 2.0 * xi2 + xi3, 3.0 * xi2 - 2.0 * xi3,
                           xi3 - xi2};
  const std::array<T, 4> h1{6.0 * (xi2 - xi), 1.0 - 4.0 * xi + 3.0 * xi2, 6.0 * (xi - xi2),
                            3.0 * xi2 - 2.0 * xi};
  const std::array<T, 4> h2{12.0 * xi - 6.0, 6.0 * xi - 4.0, 6.0 - 12.0 * xi, 6.0 * xi - 2.0};
  const std::array<double, 4> h3{12, 6, -12, 6};

  const T value_a = a_.W, slope_a = l * a_.Wu, gradient_a = l * a_.J * a_.W;
  const T value_b = b_.W, slope_b = l * b_.Wu, gradient_b = l * b_.J * b_.W;
  const auto numerators = [&](const auto& f) -> std::array<T, 4> {
    return {f[0] * value_a + f[1] * slope_a, f[1] * gradient_a, f[2] * value_b + f[3] * slope_b,
            f[3] * gradient_b};
  };
  const auto n = numerators(h), n1 = numerators(h1), n2 = numerators(h2), n3 = numerators(h3);

  const T iW = 1.0 / p.W, iJ = 1.0 / p.J;
  ShapeFunctions<T> shape;
  shape.kappa0 = p.kappa0;
  for (int k = 0; k < 4; ++k) {
    const T S = n[k] * iW;
    const T Su = (n1[k] * i1 - p.Wu * S) * iW;
    const T Suu = (n2[k] * i2 - 2.0 * p.Wu * Su - p.Wuu * S) * iW;
    const T Suuu = (n3[k] * i3 - 3.0 * p.Wu * Suu - 3.0 * p.Wuu * Su - p.Wuuu * S) * iW;
    shape.value[k] = S;
    shape.d1[k] = Su * iJ;
    shape.d2[k] = (Suu - p.Ju * shape.d1[k]) * iJ * iJ;
    shape.d3[k] = (Suuu - p.Juu * shape.d1[k] - 3.0 * p.Ju * p.J * shape.d2[k]) * iJ * iJ * iJ;
  }
  return shape;
}

template class ElementBasis<double>;
template class ElementBasis<Jet>;
template class ElementBasis<Dual<2>>;
template class ElementBasis<Dual<2, Dual<2>>>;

}  // namespace nurbeam
