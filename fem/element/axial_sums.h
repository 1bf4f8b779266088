#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "fem/element/inertia.h"
#include "fem/element/quadrature.h"
#include "fem/material/assumed_axial.h"
#include "fem/material/point_law.h"

namespace nurbeam {

/// A rule as a matrix, one row an end.
inline Eigen::Matrix<double, 2, 5> matrix_of(const AssumedEnds<double>& ends) {
  Eigen::Matrix<double, 2, 5> rule;
  for (int i = 0; i < 5; ++i) rule.col(i) << ends.a[i], ends.b[i];
  return rule;
}

/// The numbers that give the assumed axial strain of an element, y = (I, eps_A, eps_B, l) with I = int eps
/// ds, and their gradient in q. eps_A and eps_B are the strains of the nodal slopes, until take_ends().
template <int D>
struct AxialSums {
  using Layout = ElementLayout<D>;
  static constexpr int n = Layout::size;

  Eigen::Vector4d y;
  Eigen::Matrix<double, 4, n> y_q;

  /// Sums with I = 0, to which the points are to be added.
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
  /// Takes the end values of the assumed strain by their rule. `moments`: e_0, e_1 and e_2 of the strain,
  /// with gradients by rows.
  void take_ends(const OwnSlopes& own, const Eigen::Vector3d& moments,
                 const Eigen::Matrix<double, 3, n>& moments_q) {
    const Eigen::Matrix<double, 2, 5> rule = matrix_of(assumed_ends(own));
    y.segment<2>(1) = (rule * (Eigen::Matrix<double, 5, 1>() << y[1], y[2], moments).finished()).eval();
    y_q.template middleRows<2>(1) =
        (rule * (Eigen::Matrix<double, 5, n>() << y_q.template middleRows<2>(1), moments_q).finished())
            .eval();
  }
  /// Subtracts a uniform free strain from all sums: I - int eps_free ds, ...
  void take_out(double free_strain) {
    y[0] -= free_strain * y[3];
    y.segment<2>(1).array() -= free_strain;
    y_q.row(0) -= free_strain * y_q.row(3);
  }

  /// `free`: the strain that was subtracted; `buckling`: see axial_means.
  AssumedAxialEnergy energy(const BeamProperties& beam, double free, double buckling) const {
    return assumed_axial_energy<GaussRule>(beam, y, free, buckling);
  }
  void add_force(const AssumedAxialEnergy& U, ElementVector<D>& f) const {
    f += y_q.transpose() * U.gradient;
  }
  /// `moments_qq`: second derivatives of e_0, e_1 and e_2 for a rule with own slopes, else null.
  void add_tangent(const AssumedAxialEnergy& U, double k, const ElementMatrix<D>& I_qq, const OwnSlopes& own,
                   const std::array<ElementMatrix<D>, 3>* moments_qq, ElementMatrix<D>& K) const {
    K += k * (y_q.transpose() * U.hessian() * y_q + U.gradient[0] * I_qq);
    const Eigen::Matrix<double, 5, 1> on =
        matrix_of(assumed_ends(own)).transpose() * U.gradient.template segment<2>(1);
    for (const int end : {0, 1}) K.diagonal().template segment<D>(Layout::slope(end)).array() += k * on[end];
    for (int i = 0; moments_qq && i < 3; ++i) K += (k * on[2 + i]) * (*moments_qq)[i];
  }
};

/// TensionDamping with its gradient in q.
template <int D>
struct TautViscosity {
  double value = 0;                                      ///< [N s]
  ElementVector<D> gradient = ElementVector<D>::Zero();  ///< in q

  TautViscosity() = default;
  /// `sums`: without the free strain `free`.
  TautViscosity(const BeamProperties& properties, const AxialSums<D>& sums, double free,
                std::optional<bool> taut) {
    const double I = sums.y[0], l = sums.y[3];
    if (!(properties.tension_damping > 0) || !taut.value_or(I > 0)) return;
    const TensionDamping<double> damping(properties, I / l, free, 1);
    value = damping.value;
    gradient = damping.by_strain / l * (sums.y_q.row(0) - I / l * sums.y_q.row(3)).transpose();
  }
};

}  // namespace nurbeam
