#pragma once
#include <vector>

#include "fem/forces/energy.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/point_action.h"
#include "fem/structure/hook_names.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The hooks that a force in a mesh offers, each with its function in brackets; the last three are facts.
struct ForceOffers {
  /// (add_force(at, state, dynamics)) inertia less forces; with (add_tangent(at, state, weights, sink)),
  /// which hands matrices to sink.element(index, K), for an element with torsion to sink.twist(index, K), or
  /// for its own dofs() to sink.own(K).
  bool force = false;
  bool per_length = false;  ///< (per_length(beam, t)) load that the elements carry
  bool energy = false;      ///< (add_energy(at, state, sum))
  bool momentum = false;    ///< (momentum(state))
  /// (add_momentum_in(mesh, state, p)) its generalised momentum, which a change of the mesh carries over
  bool carried_momentum = false;
  bool momentum_at_place = false;  ///< (add_momentum_of(velocity, p)), at a place s() of a beam()
  /// (spin(at, state)) spin of the body of a rider(), with (add_momentum(at, state, spin, p)).
  bool roll = false;
  /// (work(at, from, to)) work between two states on one mesh, without that of weight [J]
  bool work = false;
  /// (loss(at, from, to)) energy lost between two states, where add_energy gives no rate of it [J]
  bool loss = false;
  bool memory = false;   ///< (commit(at, state, memory)) sets its part of State::memory after a step
  bool actions = false;  ///< (add_actions(at, state, actions)) adds forces and couples on points of beams
  bool on_body = false;  ///< (on_body(at, body, state)) force on a body [N]
  bool on_element =
      false;  ///< (on_element(e, state)) the generalised force on an element of its beam with torsion
  bool damper = false;    ///< (is_damper(at)) whether the force ends transients
  bool friction = false;  ///< (friction(at, state)) friction of the body of a rider()
  bool connector =
      false;  ///< (connector()) its number, with length_and_force(at, state), and carries_one_sign(at)
  /// (rotational_connector()) its number, with angle_and_moment(at, state), and admissible(state)
  bool rotational = false;
  bool depends_on_multipliers = false;
  bool has_constant_inertia = false;  ///< constant inertia, and no force that depends on velocities
  bool is_body = false;               ///< inertia and weight of a body, and nothing else
};

namespace hooks {

NURBEAM_HOOK(add_force);
NURBEAM_HOOK(add_tangent);
NURBEAM_HOOK(add_energy);
NURBEAM_HOOK(momentum);
NURBEAM_HOOK(add_momentum_of);
NURBEAM_HOOK(add_momentum_in);
NURBEAM_HOOK(spin);
NURBEAM_HOOK(add_momentum);
NURBEAM_HOOK(loss);
NURBEAM_HOOK(commit);
NURBEAM_HOOK(add_actions);
NURBEAM_HOOK(on_element);
NURBEAM_HOOK(is_damper);
NURBEAM_HOOK(friction);
NURBEAM_HOOK(rotational_connector);

/// A sink that takes the matrices of tangents.
struct AnySink {
  template <class K>
  void element(int, const K&);
  template <class K>
  void own(const K&);
  template <class K>
  void twist(int, const K&);
};

}  // namespace hooks

/// Whether a force has exactly the hooks that it offers, in dimension D: a misspelt hook does not compile.
template <class F, int D>
consteval bool keeps_offers() {
  using namespace hooks;
  constexpr ForceOffers o = F::offers;
  constexpr bool has_force =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, Eigen::VectorXd& y) {
    f.add_force(at, x, y);
  }
  || requires(const F& f, const MeshedBeams<D>& at, const State& x, Eigen::VectorXd& y) {
    f.template add_force<D>(at, x, y);
  };
  constexpr bool has_tangent =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, const TangentWeights& w, AnySink sink) {
    f.add_tangent(at, x, w, sink);
  }
  || requires(const F& f, const MeshedBeams<D>& at, const State& x, const TangentWeights& w, AnySink sink) {
    f.template add_tangent<D>(at, x, w, sink);
  };
  constexpr bool has_energy =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, SystemEnergy& sum) {
    f.add_energy(at, x, sum);
  };
  constexpr bool has_work = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    double(f.work(at, x, x));
  }
  || requires(const F& f, const MeshedBeams<D>& at, const State& x) { double(f.template work<D>(at, x, x)); };
  constexpr bool has_loss = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    double(f.loss(at, x, x));
  };
  constexpr bool has_commit =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, Eigen::VectorXd& memory) {
    f.commit(at, x, memory);
  };
  constexpr bool has_actions =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, std::vector<PointAction>& all) {
    f.add_actions(at, x, all);
  }
  || requires(const F& f, const MeshedBeams<D>& at, const State& x, std::vector<PointAction>& all) {
    f.template add_actions<D>(at, x, all);
  };
  constexpr bool has_on_body = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    f.on_body(at, 0, x);
  };
  constexpr bool has_on_element = requires(const F& f, const MeshElement<3>& e, const State& x) {
    f.on_element(e, x);
  };
  constexpr bool has_momentum = requires(const F& f, const State& x) { f.momentum(x); };
  constexpr bool has_place = requires(const F& f, const Eigen::Vector3d& v, Eigen::VectorXd& p) {
    f.add_momentum_of(v, p);
    int(f.beam());
    double(f.s());
  };
  constexpr bool has_carried = requires(const F& f, const Mesh& mesh, const State& x, Eigen::VectorXd& p) {
    f.add_momentum_in(mesh, x, p);
  };
  constexpr bool has_roll =
      requires(const F& f, const MeshedBeams<D>& at, const State& x, Eigen::VectorXd& p) {
    int(f.rider());
    double(f.spin(at, x));
    f.add_momentum(at, x, 0.0, p);
  };
  constexpr bool has_damper = requires(const F& f, const MeshedBeams<D>& at) { bool(f.is_damper(at)); };
  constexpr bool has_friction = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    f.friction(at, x);
    int(f.rider());
  };
  constexpr bool has_connector = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    int(f.connector());
    f.length_and_force(at, x);
    bool(f.carries_one_sign(at));
  };
  constexpr bool has_rotational = requires(const F& f, const MeshedBeams<D>& at, const State& x) {
    int(f.rotational_connector());
    f.angle_and_moment(at, x);
    bool(f.admissible(x));
  };
  return keeps_word(o.force, names_add_force<F>, has_force) &&
         keeps_word(o.force, names_add_tangent<F>, has_tangent) &&
         keeps_word(o.energy, names_add_energy<F>, has_energy) &&
         keeps_word(o.work, names_work<F>, has_work) && keeps_word(o.loss, names_loss<F>, has_loss) &&
         keeps_word(o.memory, names_commit<F>, has_commit) &&
         keeps_word(o.actions, names_add_actions<F>, has_actions) &&
         keeps_word(o.on_body, names_on_body<F>, has_on_body) &&
         keeps_word(o.on_element, names_on_element<F>, has_on_element) &&
         keeps_word(o.carried_momentum, names_add_momentum_in<F>, has_carried) &&
         keeps_word(o.momentum, names_momentum<F>, has_momentum) &&
         keeps_word(o.momentum_at_place, names_add_momentum_of<F>, has_place) &&
         keeps_word(o.roll, names_spin<F>, has_roll) && keeps_word(o.roll, names_add_momentum<F>, has_roll) &&
         keeps_word(o.damper, names_is_damper<F>, has_damper) &&
         keeps_word(o.friction, names_friction<F>, has_friction) &&
         keeps_word(o.rotational, names_rotational_connector<F>, has_rotational) &&
         keeps_word(o.connector, names_connector<F>, has_connector);
}

}  // namespace nurbeam
