#pragma once
#include <optional>
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/forces/section_load.h"
#include "fem/forces/turned_vector.h"
#include "fem/mesh/point_action.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// A load at its place in a state; there is none when the load has left the beam.
template <int D>
struct LoadedPoint {
  int element;
  double s;  ///< as the element counts it [m]
  PointShape<D> shape;
  PointField<D> rs;
  TurnedVector vector;  ///< the load without its factor
  double factor;        ///< product of the factor of time and State::load

  static std::optional<LoadedPoint> of(const LoadAtPlace& load, const MeshedBeams<D>& at, const State& state);

  /// Subtracts loaded_q' f from the dynamics, where f is the force conjugate to the field `loaded`.
  void add_force(const MeshedBeams<D>& at, const PointField<D>& loaded, const TurnedVector& f,
                 Eigen::Ref<Eigen::VectorXd> dynamics) const;
  ElementMatrix<D> stiffness(const PointField<D>& loaded, const TurnedVector& f, double weight) const;
};

/// A load at a place in a state: the field that it works on, its force, and its power.
template <int D>
struct LoadedField {
  Eigen::Matrix<double, D, 1> field, force;
  double power;  ///< [W]

  LoadedField(const LoadedPoint<D>& p, const PointField<D>& loaded, const TurnedVector& f,
              const MeshedBeams<D>& at, const State& state);
};

/// Work between two states [J]. A load that stays at its place does the work of its mean force over the
/// displacement, exact for a dead force. A load that `moves` does the mean power over the time. A state in
/// which the load has left the beam counts as zero.
template <int D>
double load_work(const std::optional<LoadedField<D>>& from, const std::optional<LoadedField<D>>& to,
                 bool moves, double time);

/// Contribution of a load to the tangent of one element.
template <int D>
struct LoadTangent {
  int element;
  ElementMatrix<D> matrix;
};

/// A force on a material point [N].
struct PointLoad : LoadAtPlace {
  static constexpr ForceOffers offers{
      .force = true, .work = true, .actions = true, .has_constant_inertia = true};
  static constexpr OnSection on_section = OnSection::force;  ///< hook on a beam with torsion
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <int D>
  std::optional<LoadTangent<D>> tangent(const MeshedBeams<D>& at, const State& state,
                                        const TangentWeights& w) const;
  /// Work between two states on one mesh [J].
  template <int D>
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Adds the force on the beam in a state.
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
