#pragma once
#include <optional>
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/forces/section_load.h"
#include "fem/forces/turned_vector.h"
#include "fem/mesh/point_action.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// Where such a load is at a moment: nothing is there when it has left the beam.
template <int D>
struct LoadedPoint {
  int element;
  double s;  ///< as the element counts it [m]
  PointShape<D> shape;
  PointField<D> rs;
  TurnedVector vector;  ///< without its factor
  double factor;        ///< of time and of State::load

  static std::optional<LoadedPoint> of(const LoadAtPlace& load, const MeshedBeams<D>& at, const State& state);

  /// The force f conjugate to the field `loaded` on the dynamics: less loaded_q' f.
  void add_force(const MeshedBeams<D>& at, const PointField<D>& loaded, const TurnedVector& f,
                 Eigen::Ref<Eigen::VectorXd> dynamics) const;
  ElementMatrix<D> stiffness(const PointField<D>& loaded, const TurnedVector& f, double weight) const;
};

/// What a load at a place does at a moment: its force, the field it works on there, and its power.
template <int D>
struct LoadedField {
  Eigen::Matrix<double, D, 1> field, force;
  double power;  ///< [W]

  LoadedField(const LoadedPoint<D>& p, const PointField<D>& loaded, const TurnedVector& f,
              const MeshedBeams<D>& at, const State& state);
};

/// Work between two states [J]: the mean force on the way, which is exact for a dead force that stays at its
/// place, or the mean power over the time where it `moves`. Nothing at a moment at which the load is not
/// there.
template <int D>
double load_work(const std::optional<LoadedField<D>>& from, const std::optional<LoadedField<D>>& to,
                 bool moves, double time);

/// What a load adds to the tangent of one element.
template <int D>
struct LoadTangent {
  int element;
  ElementMatrix<D> matrix;
};

/// A force on a material point [N].
struct PointLoad : LoadAtPlace {
  static constexpr ForceOffers offers{
      .force = true, .work = true, .actions = true, .has_constant_inertia = true};
  static constexpr OnSection on_section = OnSection::force;  ///< of a beam with torsion
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <int D>
  std::optional<LoadTangent<D>> tangent(const MeshedBeams<D>& at, const State& state,
                                        const TangentWeights& w) const;
  /// Done between two states on one mesh [J].
  template <int D>
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Adds what it does to the beam at a moment.
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
