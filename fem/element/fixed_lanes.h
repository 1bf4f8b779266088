#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/point_pack.h"
#include "fem/element/quadrature.h"
#include "fem/material/assumed_axial.h"

namespace nurbeam {

/// Integrals over an element with fixed ends.
template <class E>
struct ElementSums {
  std::array<std::array<E, 4>, 4> mass;     ///< rho A int S_k S_l ds
  std::array<std::array<E, 4>, 4> stretch;  ///< int S'_k S'_l ds, G of AxialSums
  std::array<E, 4> load_factor;             ///< int S_k ds
  std::array<E, 5> strain0;                 ///< int eps_0 ds, eps_0 at both ends, e_3 and e_4 of eps_0
  E length;                                 ///< s_b - s_a [m]
  AssumedEnds<E> ends;                      ///< of the assumed axial strain
  E buckling_strain;                        ///< compressive, of a beam that buckles
  E fold_resistance;                        ///< factor on FoldResistance
};
using FixedSums = ElementSums<double>;

/// A matrix of FixedSums as an Eigen matrix.
inline Eigen::Map<const Eigen::Matrix4d> matrix_of(const std::array<std::array<double, 4>, 4>& numbers) {
  return Eigen::Map<const Eigen::Matrix4d>(numbers[0].data());
}

/// One number of each of eight elements, side by side; unset until it is assigned. It has two halves, as
/// compilers copy numbers wider than the registers of a processor through memory.
struct alignas(8 * sizeof(double)) ElementLanes {
  using Half = double __attribute__((vector_size(4 * sizeof(double))));
  Half half[2];

  double of(int lane) const { return reinterpret_cast<const double*>(half)[lane]; }
  void set(int lane, double number) { reinterpret_cast<double*>(half)[lane] = number; }
  void set_all(double number) { half[0] = half[1] = Half{} + number; }
};

/// The numbers of up to eight elements with fixed ends, each on one part of the drawing, computed once and
/// kept side by side: the only place of these numbers.
struct FixedLanes {
  static constexpr int lanes = 8, points = GaussRule::size;

  using Point = PointNumbers<ElementLanes>;
  std::array<Point, points> at = {};
  ElementSums<ElementLanes> sum = {};

  /// The sum over all numbers of an element in a lane, each times the number in a lane of others.
  double product(int lane, const FixedLanes& other, int lane_of_other) const;
  /// Puts the numbers of one element into a lane; the first element fills all lanes until others take them.
  void put(int lane, const FixedSums& sums, const PointPack& pack);
  /// The numbers of the element in a lane.
  FixedSums sums(int lane) const;
  PointPack pack(int lane) const;
};

}  // namespace nurbeam
