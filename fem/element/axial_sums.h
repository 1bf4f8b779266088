#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/inertia.h"
#include "fem/material/assumed_axial.h"

namespace nurbeam {

/// What the assumed axial strain of an element is made of, y = (I, eps_A, eps_B, l) with I = int eps ds, and
/// its gradient in q; eps_A and eps_B are those of the nodal slopes.
template <int D>
struct AxialSums {
  using Layout = ElementLayout<D>;
  static constexpr int n = Layout::size;

  Eigen::Vector4d y;
  Eigen::Matrix<double, 4, n> y_q;

  /// With I = 0: the points are to be added.
  explicit AxialSums(const ElementVector<D>& q) {
    y.setZero();
    y_q.setZero();
    for (const int end : {0, 1}) {
      const auto slope = q.template segment<D>(Layout::slope(end));
      y[1 + end] = (slope.squaredNorm() - 1) / 2;
      y_q.template block<1, D>(1 + end, Layout::slope(end)) = slope.transpose();
      y_q(3, Layout::place(end)) = end == 0 ? -1 : 1;
    }
    y[3] = q[Layout::place(1)] - q[Layout::place(0)];
  }

  void add_point(const PointField<D>& rs, double weight, const ElementVector<D>& weight_q) {
    const double eps = (rs.value.squaredNorm() - 1) / 2;
    y[0] += weight * eps;
    y_q.row(0) += weight * rs.value.transpose() * rs.gradient + eps * weight_q.transpose();
  }
  /// I_qq of one point.
  static void add_hessian(const PointField<D>& rs, double weight, const ElementVector<D>& weight_q,
                          const ElementNodes<D>& e, ElementMatrix<D>& I_qq) {
    const ElementVector<D> eps_q = rs.gradient.transpose() * rs.value;
    I_qq += weight * rs.gradient.transpose() * rs.gradient + eps_q * weight_q.transpose() +
            weight_q * eps_q.transpose();
    rs.add_hessian(rs.value, weight, e, I_qq);
  }

  /// Takes a uniform strain that carries no force out of all of them: I - int eps_free ds, ...
  void take_out(double free_strain) {
    y[0] -= free_strain * y[3];
    y.segment<2>(1).array() -= free_strain;
    y_q.row(0) -= free_strain * y_q.row(3);
  }

  void add_force(double EA, ElementVector<D>& f) const {
    f += y_q.transpose() * AssumedAxialEnergy(EA, y).gradient;
  }
  void add_tangent(double EA, double k, const ElementMatrix<D>& I_qq, ElementMatrix<D>& K) const {
    const AssumedAxialEnergy U(EA, y);
    K += k * (y_q.transpose() * U.hessian() * y_q + U.gradient[0] * I_qq);
    for (const int end : {0, 1})
      K.diagonal().template segment<D>(Layout::slope(end)).array() += k * U.gradient[1 + end];
  }
};

/// Rates x' of x = (I, eps_A, eps_B) at fixed material, their gradients Z in the velocities (test vectors,
/// too) and what the tangent of their stress needs.
template <int D>
class AxialRates {
 public:
  static constexpr int n = ElementLayout<D>::size;
  using Motion = typename PointInertia<D>::Motion;

  explicit AxialRates(const Motion& motion) : motion_(motion) {
    rate_.setZero();
    Z_.setZero();
    rate_q_.setZero();
    Z_q_.fill(ElementMatrix<D>::Zero());
  }

  /// Adds to x'_i, i = 0, 1, 2, what a point s with that weight contributes: eps' = r_s . (dr_s/dt - r_ss
  /// ds/dt). An end is a point of weight 1.
  void add(int i, const PointField<D>& rs, const PointField<D>& rss, const Jet& s, const Jet& weight) {
    using Layout = ElementLayout<D>;
    ElementVector<D> s_q = ElementVector<D>::Zero(), w_q = ElementVector<D>::Zero();
    double s_rate = 0;
    for (const int end : {0, 1}) {
      s_q[Layout::place(end)] = s.d(end);
      w_q[Layout::place(end)] = weight.d(end);
      s_rate += s.d(end) * motion_.w[end];
    }
    const double w = weight.value();
    const auto& [e, e_rate, e_second, places, place_rates] = motion_;
    const auto zeta = (rs.rate(e, e_rate, places) - rss.value * s_rate).eval();
    const auto zeta_q = (rs.rate_gradient(e, e_rate, places) - s_rate * rss.gradient).eval();
    const ElementVector<D> test = rs.gradient.transpose() * rs.value - s_q * rss.value.dot(rs.value);
    const double eps_rate = rs.value.dot(zeta);
    rate_[i] += w * eps_rate;
    Z_.row(i) += w * test.transpose();
    rate_q_.row(i) +=
        eps_rate * w_q.transpose() + w * (zeta.transpose() * rs.gradient + rs.value.transpose() * zeta_q);
    Z_q_[i] +=
        test * w_q.transpose() +
        w * (rs.gradient.transpose() * rs.gradient -
             s_q * (rss.gradient.transpose() * rs.value + rs.gradient.transpose() * rss.value).transpose());
    rs.add_hessian(rs.value, w, e, Z_q_[i]);
  }

  void add_force(double viscosity, double l, ElementVector<D>& f) const {
    f += Z_.transpose() * AssumedAxialDamping(viscosity, l, rate_).stress;
  }
  void add_tangent(double viscosity, double l, const TangentWeights& t, ElementMatrix<D>& K) const {
    const AssumedAxialDamping damping(viscosity, l, rate_);
    if (t.damping != 0) K += t.damping * Z_.transpose() * damping.by_rate * Z_;
    if (t.stiffness == 0) return;
    Eigen::Matrix<double, 3, n> stress_q = damping.by_rate * rate_q_;
    stress_q.col(ElementLayout<D>::place(0)) -= damping.by_length;
    stress_q.col(ElementLayout<D>::place(1)) += damping.by_length;
    K += t.stiffness * Z_.transpose() * stress_q;
    for (int i = 0; i < 3; ++i) K += (t.stiffness * damping.stress[i]) * Z_q_[i];
  }
  double power(double viscosity, double l) const {
    return rate_.dot(AssumedAxialDamping(viscosity, l, rate_).stress);
  }

 private:
  const Motion& motion_;
  Eigen::Vector3d rate_;
  Eigen::Matrix<double, 3, n> Z_, rate_q_;
  std::array<ElementMatrix<D>, 3> Z_q_;
};

}  // namespace nurbeam
