#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "fem/element/inertia.h"
#include "fem/element/quadrature.h"
#include "fem/material/assumed_axial.h"
#include "fem/material/point_law.h"

namespace nurbeam {

/// The numbers that give the assumed axial strain of an element, y = (I, eps_A, eps_B, l) with I = int eps
/// ds, and their gradient in q; eps_A and eps_B are the strains of the nodal slopes.
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
  /// Subtracts a uniform free strain from all sums: I - int eps_free ds, ...
  void take_out(double free_strain) {
    y[0] -= free_strain * y[3];
    y.segment<2>(1).array() -= free_strain;
    y_q.row(0) -= free_strain * y_q.row(3);
  }

  /// `free`: the strain that was subtracted.
  AssumedAxialEnergy energy(const BeamProperties& beam, double free) const {
    return assumed_axial_energy<GaussRule>(beam, y, free);
  }
  void add_force(const BeamProperties& beam, double free, ElementVector<D>& f) const {
    f += y_q.transpose() * energy(beam, free).gradient;
  }
  void add_tangent(const BeamProperties& beam, double free, double k, const ElementMatrix<D>& I_qq,
                   ElementMatrix<D>& K) const {
    const AssumedAxialEnergy U = energy(beam, free);
    K += k * (y_q.transpose() * U.hessian() * y_q + U.gradient[0] * I_qq);
    for (const int end : {0, 1})
      K.diagonal().template segment<D>(Layout::slope(end)).array() += k * U.gradient[1 + end];
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
