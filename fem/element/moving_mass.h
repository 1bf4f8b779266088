#pragma once
#include <array>

#include "fem/element/moving_rows.h"
#include "fem/element/moving_sums.h"

namespace nurbeam {

/// The mass matrix of an element with moving ends, summed over its points. dv/d(dq/dt) has the shape
/// functions, and the derivatives of r by the places at fixed material.
template <int D>
class MassSum {
 public:
  /// Mass per length in [kg/m]; `q`: coordinates of the element.
  MassSum(double mass_per_length, const ElementVector<D>& q)
      : rho_(mass_per_length), nodes_(ElementLayout<D>::nodes(q)) {}

  /// Adds a point. `r`: row of a point that stays, with first derivatives; `length`: its weight in the
  /// integral [m].
  void add(const MovingRows::Series& r, double length) {
    using Vector = Eigen::Matrix<double, D, 1>;
    const double m = rho_ * length;
    const std::array<Vector, 2> by_place{nodes_ * r.first[0], nodes_ * r.first[1]};
    sums_.isotropic.noalias() += (m * r.value) * r.value.transpose();
    for (const int i : {0, 1}) {
      sums_.by_place[i].noalias() += (m * by_place[i]) * r.value.transpose();
      for (const int j : {0, 1}) sums_.places(i, j) += m * by_place[i].dot(by_place[j]);
    }
  }

  ElementMatrix<D> total() {
    sums_.of_place = sums_.by_place;
    return sums_.matrix();
  }

 private:
  double rho_;
  ElementNodes<D> nodes_;
  PlaceSums<D> sums_;
};

}  // namespace nurbeam
