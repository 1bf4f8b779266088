#pragma once
#include <vector>

#include "fem/constraints/followed_section.h"
#include "fem/forces/energy.h"
#include "fem/forces/force_offers.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/point_action.h"

namespace nurbeam {

/// The inertia J of the roll of a sliding body with the section that it follows (FollowedNode,
/// FollowedPoint). T = J w^2/2, where w is the spin of the section at the body about its tangent t, not the
/// spin of the material there. The force is the moment d(J w t)/dt on the section.
///
/// The tangent matrix of a body on a point lacks third derivatives of the section by the places
/// (PlacedSection).
template <class Section>
class RollInertia {
 public:
  static constexpr ForceOffers offers{.force = true, .energy = true, .roll = true, .actions = true};
  RollInertia(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, int rider)
      : rider_(rider),
        inertia_(at.structure.body_of(at.structure.riders[rider]).roll_inertia),
        section_(at, drawn, rider),
        dofs_(section_.dofs().begin(), section_.dofs().end()) {}

  int rider() const { return rider_; }
  const std::vector<int>& dofs() const { return dofs_; }

  void add_force(const MeshedBeams<3>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<3>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    sink.own(tangent(at, state, w));
  }
  void add_energy(const MeshedBeams<3>& at, const State& state, SystemEnergy& sum) const {
    const double w = spin(at, state);
    sum.kinetic += inertia_ * w * w / 2;
  }
  /// Spin w [rad/s].
  double spin(const MeshedBeams<3>& at, const State& state) const;
  /// Adds the generalised momentum of a roll with this spin [rad/s].
  void add_momentum(const MeshedBeams<3>& at, const State& state, double spin,
                    Eigen::Ref<Eigen::VectorXd> p) const;
  /// Adds the couple on the beam where the body is carried as a point.
  void add_actions(const MeshedBeams<3>& at, const State& state, std::vector<PointAction>& actions) const;

 private:
  static constexpr int size = Section::size;
  using Matrix = Eigen::Matrix<double, size, size>;
  Matrix tangent(const MeshedBeams<3>& at, const State& state, const TangentWeights& w) const;
  template <class T>
  using Vector = Eigen::Matrix<T, size, 1>;
  template <class T>
  struct Motion {
    Vector<T> q, v, a;
  };
  Motion<double> motion(const MeshedBeams<3>& at, const State& state) const {
    return {section_.coordinates(at, state.q), gathered(section_.dofs(), state.v),
            gathered(section_.dofs(), state.a)};
  }
  // The moment d(J w t)/dt with w = d1' . d2.
  template <class T, class Here>
  Vector3<T> moment(const Here& here, const Motion<T>& x) const {
    using Rate = Dual<1, T>;
    using Second = Dual<1, Rate>;
    Vector<Second> moving;
    for (int i = 0; i < size; ++i)
      moving[i] = Second::variable(Rate::variable(x.q[i], 0, x.v[i]), 0, Rate::variable(x.v[i], 0, x.a[i]));
    const SectionTriad<Second> now = here.template triad<Second>(moving);
    Rate w = 0.0;
    for (int d = 0; d < 3; ++d) w += now.d1[d].d[0] * now.d2[d].value;
    Vector3<T> rate;
    for (int d = 0; d < 3; ++d) rate[d] = (inertia_ * (w * now.t[d].value)).d[0];
    return rate;
  }
  void add(const Vector<double>& f, Eigen::Ref<Eigen::VectorXd> to) const {
    for (int i = 0; i < size; ++i)
      if (dofs_[i] >= 0) to[dofs_[i]] += f[i];
  }

  int rider_;
  double inertia_;
  Section section_;
  std::vector<int> dofs_;
};

extern template class RollInertia<FollowedNode>;
extern template class RollInertia<FollowedPoint>;

/// Roll of a body that has left its beam: the spin stays as it was.
class FreeRoll {
 public:
  static constexpr ForceOffers offers{.energy = true};
  FreeRoll(double inertia, double spin) : energy_(inertia * spin * spin / 2) {}
  void add_energy(const MeshedBeams<3>&, const State&, SystemEnergy& sum) const { sum.kinetic += energy_; }

 private:
  double energy_;
};

/// Binds the roll inertia of all bodies that follow a section.
template <int D>
struct BodyRolls {
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if constexpr (D == 3)
      for (int j = 0; j < static_cast<int>(binding.at.structure.riders.size()); ++j)
        bind_roll(j, binding, add);
  }

 private:
  template <class Add>
  static void bind_roll(int j, const Binding<3>& binding, Add&& add) {
    const MeshedBeams<3>& at = binding.at;
    const Rider& rider = at.structure.riders[j];
    const double inertia = at.structure.body_of(rider).roll_inertia;
    if (!rider.follows_section || inertia == 0) return;
    if (at.mesh.plan.modes[j] == Carried::free)
      add(FreeRoll(inertia, at.mesh.plan.spin(j)));
    else if (at.mesh.plan.modes[j] == Carried::node)
      add(RollInertia<FollowedNode>(at, binding.drawn, j));
    else
      add(RollInertia<FollowedPoint>(at, binding.drawn, j));
  }
};

}  // namespace nurbeam
