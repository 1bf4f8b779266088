#pragma once
#include <optional>
#include <utility>

#include "fem/constraints/constraint_terms.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/mesh/point_action.h"
#include "fem/structure/hook_names.h"

namespace nurbeam {

/// The hooks that a constraint in a mesh offers besides rows, dofs() and terms(at, state, y), each with its
/// function in brackets.
struct ConstraintOffers {
  bool linear = false;  ///< the constraint has no Hessian
  /// (rate(t), acceleration(t)) dg/dt and d2g/dt2 at fixed q; or, where they depend on the state, (rate(at,
  /// state), acceleration(at, state)) dg/dt and d2g/dt2 + 2 d2g/dt dq v at fixed q and v
  bool rates = false;
  bool constant =
      false;  ///< (is_constant()) whether the gradient is equal in all states; linear ones need not say
  bool curvature = false;  ///< (curvature(at, state, v)) v . d2g/dq2 v, cheaper than by the Hessian
  /// (force(y) or force(state, y)) force on the beam, or the body, for its multipliers; without this hook it
  /// is -y
  bool force = false;
  bool couple = false;   ///< (couple(at, state, y)) couple on the beam, in place of a force
  bool action = false;   ///< (action(at, state, y)) force and couple on a point of a beam, if there is one
  bool on_body = false;  ///< (on_body(body, state, y)) force on a body [N]
  /// (work(from, to, y_from, y_to), or work(at, from, ...)) work between two states on one mesh [J]
  bool work = false;
  /// (drive(at, state, y)) moment about its axis by which a prescribed rotation turns on what is held [N m]
  bool drive = false;
  bool body = false;  ///< (body()) first coordinate of a body that follows the constraint's other coordinates
  bool place = false;      ///< (place()) coordinate of the place that the constraint holds
  bool stop = false;       ///< (closed_stop()) number of the stop that the constraint keeps closed
  bool connector = false;  ///< (connector()) number of the rod, with length_and_force(state, y)
};

namespace hooks {

NURBEAM_HOOK(rate);
NURBEAM_HOOK(acceleration);
NURBEAM_HOOK(is_constant);
NURBEAM_HOOK(curvature);
NURBEAM_HOOK(force);
NURBEAM_HOOK(couple);
NURBEAM_HOOK(action);
NURBEAM_HOOK(body);
NURBEAM_HOOK(place);
NURBEAM_HOOK(closed_stop);
NURBEAM_HOOK(drive);

}  // namespace hooks

/// Whether a constraint has exactly the hooks that it offers, in dimension D: a misspelt hook does not
/// compile.
template <class C, int D>
consteval bool keeps_constraint_offers() {
  using namespace hooks;
  using Y = typename ConstraintTerms<D>::Multipliers;
  using Rows = Eigen::VectorXd;
  constexpr ConstraintOffers o = C::offers;
  constexpr bool has_rate = requires(const C& c) { c.rate(0.0); }
  || requires(const C& c, const MeshedBeams<D>& at, const State& x) { c.rate(at, x); };
  constexpr bool has_acceleration = requires(const C& c) { c.acceleration(0.0); }
  || requires(const C& c, const MeshedBeams<D>& at, const State& x) { c.acceleration(at, x); };
  constexpr bool has_curvature = requires(const C& c, const MeshedBeams<D>& at, const State& x,
                                          const Eigen::Matrix<double, ConstraintTerms<D>::size, 1>& v) {
    c.curvature(at, x, v);
  };
  constexpr bool has_force = requires(const C& c, const Rows& y) { Eigen::Vector3d(c.force(y)); }
  || requires(const C& c, const State& x, const Rows& y) { Eigen::Vector3d(c.force(x, y)); };
  constexpr bool has_couple = requires(const C& c, const MeshedBeams<D>& at, const State& x, const Rows& y) {
    Eigen::Vector3d(c.couple(at, x, y));
  };
  constexpr bool has_action = requires(const C& c, const MeshedBeams<D>& at, const State& x, const Y& y) {
    std::optional<PointAction>(c.action(at, x, y));
  };
  constexpr bool has_on_body = requires(const C& c, const State& x, const Rows& y) { c.on_body(0, x, y); };
  constexpr bool has_work = requires(const C& c, const State& x, const Rows& y) {
    double(c.work(x, x, y, y));
  }
  || requires(const C& c, const MeshedBeams<D>& at, const State& x, const Rows& y) {
    double(c.work(at, x, x, y, y));
  };
  constexpr bool has_connector = requires(const C& c, const State& x, const Rows& y) {
    int(c.connector());
    std::pair<double, double>(c.length_and_force(x, y));
  };
  return keeps_word(o.rates, names_rate<C>, has_rate) &&
         keeps_word(o.rates, names_acceleration<C>, has_acceleration) &&
         keeps_word(
             o.constant, names_is_constant<C>, requires(const C& c) { bool(c.is_constant()); }) &&
         keeps_word(o.curvature, names_curvature<C>, has_curvature) &&
         keeps_word(o.force, names_force<C>, has_force) &&
         keeps_word(o.couple, names_couple<C>, has_couple) &&
         keeps_word(o.action, names_action<C>, has_action) &&
         keeps_word(o.on_body, names_on_body<C>, has_on_body) &&
         keeps_word(o.work, names_work<C>, has_work) &&
         keeps_word(
             o.drive, names_drive<C>,
             requires(const C& c, const MeshedBeams<D>& at, const State& x, const Rows& y) {
               double(c.drive(at, x, y));
             }) &&
         keeps_word(
             o.body, names_body<C>, requires(const C& c) { int(c.body()); }) &&
         keeps_word(
             o.place, names_place<C>, requires(const C& c) { int(c.place()); }) &&
         keeps_word(
             o.stop, names_closed_stop<C>, requires(const C& c) { int(c.closed_stop()); }) &&
         keeps_word(o.connector, names_connector<C>, has_connector);
}

/// dg/dt at fixed q, and d2g/dt2 + 2 d2g/dt dq v, of a constraint that offers rates.
template <int D, class C>
auto rate_of(const C& c, const MeshedBeams<D>& at, const State& state) {
  if constexpr (requires { c.rate(at, state); })
    return c.rate(at, state);
  else
    return c.rate(state.t);
}
template <int D, class C>
auto acceleration_of(const C& c, const MeshedBeams<D>& at, const State& state) {
  if constexpr (requires { c.acceleration(at, state); })
    return c.acceleration(at, state);
  else
    return c.acceleration(state.t);
}

}  // namespace nurbeam
