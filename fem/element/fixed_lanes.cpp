#include "fem/element/fixed_lanes.h"

#include <algorithm>

namespace nurbeam {

// FixedLanes consists of numbers only, so that it can be read as an array.
double FixedLanes::product(int lane, const FixedLanes& other, int lane_of_other) const {
  constexpr int size = sizeof(FixedLanes) / sizeof(ElementLanes);
  const auto *own = reinterpret_cast<const ElementLanes*>(this),
             *of_other = reinterpret_cast<const ElementLanes*>(&other);
  double product = 0;
  for (int i = 0; i < size; ++i) product += own[i].of(lane) * of_other[i].of(lane_of_other);
  return product;
}

// The first element fills all lanes.
void FixedLanes::put(int lane, const FixedSums& sums, const PointPack& pack) {
  const auto set = [&](ElementLanes& numbers, double number) {
    if (lane == 0)
      numbers.set_all(number);
    else
      numbers.set(lane, number);
  };
  for (int g = 0; g < points; ++g) {
    for (int k = 0; k < 4; ++k) {
      set(at[g].S1[k], pack.S1[k][g]);
      set(at[g].S2[k], pack.S2[k][g]);
    }
    set(at[g].weight, pack.weight[g]);
    set(at[g].kappa0, pack.kappa0[g]);
    set(at[g].eps0, pack.eps0[g]);
    for (int k = 0; k < 4; ++k) set(at[g].in_strain[k], pack.in_strain[k][g]);
  }
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) {
      set(sum.mass[k][l], sums.mass[k][l]);
      set(sum.stretch[k][l], sums.stretch[k][l]);
    }
    set(sum.load_factor[k], sums.load_factor[k]);
  }
  for (int k = 0; k < 5; ++k) set(sum.strain0[k], sums.strain0[k]);
  set(sum.length, sums.length);
  set(sum.buckling_strain, sums.buckling_strain);
  set(sum.fold_resistance, sums.fold_resistance);
  for (int k = 0; k < 5; ++k) {
    set(sum.ends.a[k], sums.ends.a[k]);
    set(sum.ends.b[k], sums.ends.b[k]);
  }
}

FixedSums FixedLanes::sums(int lane) const {
  FixedSums sums;
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) {
      sums.mass[k][l] = sum.mass[k][l].of(lane);
      sums.stretch[k][l] = sum.stretch[k][l].of(lane);
    }
    sums.load_factor[k] = sum.load_factor[k].of(lane);
  }
  for (int k = 0; k < 5; ++k) sums.strain0[k] = sum.strain0[k].of(lane);
  sums.length = sum.length.of(lane);
  sums.buckling_strain = sum.buckling_strain.of(lane);
  sums.fold_resistance = sum.fold_resistance.of(lane);
  for (int k = 0; k < 5; ++k) {
    sums.ends.a[k] = sum.ends.a[k].of(lane);
    sums.ends.b[k] = sum.ends.b[k].of(lane);
  }
  return sums;
}

// The numbers of a lane as a pack. Lanes beyond the points repeat the last one without weight.
PointPack FixedLanes::pack(int lane) const {
  PointPack pack;
  for (int i = 0; i < Lanes::SizeAtCompileTime; ++i) {
    const Point& point = at[std::min(i, points - 1)];
    for (int k = 0; k < 4; ++k) {
      pack.S1[k][i] = point.S1[k].of(lane);
      pack.S2[k][i] = point.S2[k].of(lane);
    }
    pack.weight[i] = i < points ? point.weight.of(lane) : 0;
    pack.kappa0[i] = point.kappa0.of(lane);
    pack.eps0[i] = point.eps0.of(lane);
    for (int k = 0; k < 4; ++k) pack.in_strain[k][i] = i < points ? point.in_strain[k].of(lane) : 0;
  }
  return pack;
}

}  // namespace nurbeam
