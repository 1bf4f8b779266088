#pragma once
#include "fem/forces/force_offers.h"
#include "fem/forces/point_load.h"

namespace nurbeam {

/// Force conjugate to r_s of a moment m: m x r_s / |r_s|^2 (virtual work m . (r_s x d r_s)/|r_s|^2), and its
/// derivative in r_s.
TurnedVector moment_on_slope(const TurnedVector& m, const Eigen::Vector3d& rs);

/// A moment on a section [N m]; on a beam without torsion its part along the beam does nothing.
struct Moment : LoadAtPlace {
  static constexpr ForceOffers offers{
      .force = true, .work = true, .actions = true, .has_constant_inertia = true};
  static constexpr OnSection on_section = OnSection::moment;  ///< hook on a beam with torsion
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <int D>
  std::optional<LoadTangent<D>> tangent(const MeshedBeams<D>& at, const State& state,
                                        const TangentWeights& w) const;
  /// Work between two states on one mesh [J].
  template <int D>
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Adds the couple on the beam in a state.
  template <int D>
  void add_actions(const MeshedBeams<D>& at, const State& state, std::vector<PointAction>& actions) const;
  template <int D, class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if constexpr (D == 3)
      if (works_on_section(*this, on_section, at.structure)) {
        if (const auto load = SectionLoad::of(*this, on_section, at, state, true))
          sink.twist(load->element, -w.stiffness * load->gradient);
        return;
      }
    if (const auto added = tangent(at, state, w)) sink.element(added->element, added->matrix);
  }
};

}  // namespace nurbeam
