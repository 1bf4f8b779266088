#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/jet.h"
#include "fem/element/moving_rows.h"
#include "fem/element/moving_sums.h"
#include "fem/material/assumed_axial.h"

namespace nurbeam {

/// The axial strain eps = (|r_s|^2 - 1)/2 at a point of an element with moving ends. `row`: of the shape
/// functions of r_s, with derivatives by the places; `rs_i`: those of r_s.
template <int D>
struct StrainAtPoint {
  using Vector = Eigen::Matrix<double, D, 1>;
  const MovingRows::Series& row;
  const Vector& rs;
  const std::array<Vector, 2>& rs_i;

  double value() const { return (rs.squaredNorm() - 1) / 2; }
};

/// A sum over points of the axial strain, each times a weight that changes with the places: value and
/// gradient. For damped elements also its rate at fixed material, and the gradient of this rate in the rates
/// of the coordinates.
template <int D>
struct StrainSum {
  using Vector = Eigen::Matrix<double, D, 1>;

  double value = 0, rate = 0;
  Gradient<D> gradient;
  std::array<double, 2> test_places{};

  void add(const StrainAtPoint<D>& at, const Jet& weight) {
    const double eps = at.value();
    value += weight.value() * eps;
    gradient.nodes.noalias() += (weight.value() * at.rs) * at.row.value.transpose();
    for (const int i : {0, 1})
      gradient.places[i] += weight.value() * at.rs.dot(at.rs_i[i]) + eps * weight.d(i);
  }
  /// `rs_rate`: the rate of r_s at fixed material; `tests`: its derivatives by the rates of the places.
  void add_rate(const StrainAtPoint<D>& at, double weight, const Vector& rs_rate,
                const std::array<Vector, 2>& tests) {
    rate += weight * at.rs.dot(rs_rate);
    for (const int i : {0, 1}) test_places[i] += weight * at.rs.dot(tests[i]);
  }
  /// The gradient of the rate in the rates of the coordinates.
  ElementVector<D> test() const { return Gradient<D>{gradient.nodes, test_places}.vector(); }
};

/// The rate of r_s at a point at fixed material, and its derivatives: by the nodes (one number a node) and by
/// the places, both weighted as TangentWeights are; by the rates of the places, `tests`, with their rows.
template <int D>
struct SlopeRate {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Vector& value;
  const MovingRows::Row& by_nodes;
  const std::array<Vector, 2>& by_places;
  std::array<Vector, 2> tests;
  std::array<MovingRows::Row, 2> test_rows;
  std::array<std::array<Vector, 2>, 2> tests_by_places;  ///< of test i by place j
};

/// StrainSum with second derivatives. `k`: the weight of stiffness.
template <int D>
struct StrainSumTangent {
  using Vector = Eigen::Matrix<double, D, 1>;

  StrainSum<D> sum;
  Gradient<D> rate_gradient;  ///< of the rate, with all rates weighted

  void add(const StrainAtPoint<D>& at, const Jet& weight) {
    sum.add(at, weight);
    const auto& [row, rs, rs_i] = at;
    const double A = weight.value(), eps = at.value();
    shared_.isotropic.noalias() += (A * row.value) * row.value.transpose();
    const std::array<double, 2> eps_i{rs.dot(rs_i[0]), rs.dot(rs_i[1])};
    for (const int i : {0, 1}) {
      auto& by_place = shared_.by_place[i];
      by_place.noalias() += (A * rs_i[i] + weight.d(i) * rs) * row.value.transpose();
      by_place.noalias() += (A * rs) * row.first[i].transpose();
    }
    for (const int i : {0, 1})
      for (const int j : {0, 1})
        places_(i, j) +=
            A * rs_i[i].dot(rs_i[j]) + weight.d(j) * eps_i[i] + weight.d(i) * eps_i[j] + weight.d(i, j) * eps;
  }
  /// Adds the part of r_s'' to the second derivatives; `second`: derivatives of r_s by the places.
  void add_second(const StrainAtPoint<D>& at, double weight, const std::array<Vector, 3>& second) {
    for (const int i : {0, 1})
      for (const int j : {0, 1}) places_(i, j) += weight * at.rs.dot(second[i + j]);
  }
  void add_rate(const StrainAtPoint<D>& at, const Jet& weight, const SlopeRate<D>& rate, double k) {
    const double A = weight.value();
    const auto& [row, rs, rs_i] = at;
    sum.add_rate(at, A, rate.value, rate.tests);
    rate_gradient.nodes.noalias() += (k * A) * rate.value * row.value.transpose();
    rate_gradient.nodes.noalias() += A * rs * rate.by_nodes.transpose();
    for (const int i : {0, 1}) {
      rate_gradient.places[i] += A * (k * rate.value.dot(rs_i[i]) + rs.dot(rate.by_places[i])) +
                                 (k * weight.d(i)) * rs.dot(rate.value);
      shared_.of_place[i].noalias() += A * rate.tests[i] * row.value.transpose();
      shared_.of_place[i].noalias() += A * rs * rate.test_rows[i].transpose();
      for (const int j : {0, 1})
        shared_.places(i, j) += A * (rs_i[j].dot(rate.tests[i]) + rs.dot(rate.tests_by_places[i][j])) +
                                weight.d(j) * rs.dot(rate.tests[i]);
    }
  }

  /// Second derivatives of the sum.
  ElementMatrix<D> hessian() const {
    PlaceSums<D> all = shared_;
    all.of_place = all.by_place;
    all.places = places_;
    return all.matrix();
  }
  /// Derivatives of StrainSum::test.
  ElementMatrix<D> test_gradient() const { return shared_.matrix(); }

 private:
  PlaceSums<D> shared_;  // of the test; isotropic and by_place are those of the Hessian too
  Eigen::Matrix2d places_ = Eigen::Matrix2d::Zero();  // of the Hessian
};

}  // namespace nurbeam
