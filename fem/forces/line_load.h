#pragma once
#include <Eigen/Core>

#include "fem/forces/force_offers.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/time_table.h"

namespace nurbeam {

/// A dead load along a whole beam.
struct LineLoad {
  static constexpr ForceOffers offers{.per_length = true, .work = true, .has_constant_inertia = true};

  int beam = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N/m] of reference arc length
  TimeTable time = {};                              ///< factor

  /// The load on a beam at time t, with State::load = 1 [N/m]: elements carry it.
  Eigen::Vector3d per_length(int on_beam, double t) const;
  /// Work between two states on one mesh [J]: the mean force over the displacement.
  template <int D>
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
};

}  // namespace nurbeam
