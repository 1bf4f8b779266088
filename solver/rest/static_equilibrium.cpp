#include "solver/rest/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/rest/kinsol.h"
#include "solver/rest/stability.h"
#include "solver/system/arguments.h"
#include "solver/system/force_sizes.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

/// Limit for the change of a coordinate in one increment, over its scale.
constexpr double largest_change = 1;
constexpr double noticeable_change = 1e-6;   ///< a change above round-off
constexpr double settled_change = 0.05;      ///< change in a proximal step below which plain Newton is tried
constexpr double proximal_tolerance = 1e-6;  ///< for the scaled residual of a proximal step that moves
constexpr double first_increment = 0.1;
constexpr double smallest_increment = 1e-8;
constexpr int easy_iterations = 6;
constexpr int proximal_iterations = 15;
/// Departure from an unstable equilibrium, change of a coordinate over its scale.
constexpr double departing_change = 1e-2;

/// Cost of the judgement whether an equilibrium without an energy diverges, in Newton iterations.
constexpr int judgement_cost = 5;

/// One search: the state and load factor of the last equilibrium, and what was spent so far.
class EquilibriumSearch {
 public:
  /// What the search may spend after its first equilibrium that diverges (unstable, without an energy), in
  /// Newton iterations; nothing: such equilibria are accepted.
  using Allowance = std::optional<int>;

  EquilibriumSearch(const StaticEquilibrium& settings, const SecondOrderSystem& system, const State& start,
                    Allowance for_stability)
      : settings_(settings),
        for_stability_(for_stability),
        system_(system),
        scale_(system.coordinate_scale()),
        sizes_(system),
        state_(resting(system, start)),
        start_(state_),
        equations_(system, state_),
        kinsol_(equations_) {}

  StaticReport run() {
    const auto is_over = [&](FirstStep first) { return reach(1, first).converged || !steps_left(); };
    if (!is_over(FirstStep::full) && !is_over(FirstStep::bounded)) {
      const Outcome start = reach(0);
      const bool diverges = start.unstable() && diverged_;  // another search ended with it, if any did
      if (start.converged)
        follow_load();
      else if (!diverges)
        relax(1);
    }
    state_.load = report_.load_factor;
    if (!for_stability_ && report_.status == StaticStatus::converged) report_.diverges = final_diverges();
    if (report_.status != StaticStatus::converged && lost_in_round_off_)
      report_.status = StaticStatus::lost_in_round_off;
    return report_;
  }

  const State& state() const { return state_; }
  bool ended() const { return ended_; }
  /// Whether the search failed as it found only equilibria that diverge.
  bool wants_stability() const { return diverged_ && !ended_ && report_.status != StaticStatus::converged; }
  bool has_answer() const { return ended_ || report_.status == StaticStatus::converged; }
  int spent() const { return spent_; }

 private:
  struct Outcome {
    bool converged = false;
    bool singular_at_start = false;
    bool turns_back = false;  // the move is against the direction of the tangent
    int iterations = 0;
    double residual_norm = 0;
    Stability stability = {};  // of the equilibrium it converged to

    bool unstable() const { return stability.unstable_directions > 0; }
    bool branches() const { return unstable() && !turns_back; }
  };

  enum class FirstStep { full, bounded };

  /// Applies the load in increments from the equilibrium without load.
  void follow_load() {
    double increment = first_increment;
    while (report_.status != StaticStatus::converged && steps_left() && !ended_) {
      const double factor = load_after(increment);
      const Outcome outcome = reach(factor);
      if (outcome.converged) {
        if (outcome.iterations <= easy_iterations) increment *= 2;
      } else if (increment > smallest_after(outcome) && !outcome.singular_at_start) {
        increment /= 2;
      } else if (relax(diverged_ ? factor : load_after(std::max(increment, leap())))) {
        increment = first_increment;
      } else {
        return;
      }
    }
  }

  /// Smallest increment after an attempt: if the branch itself becomes unstable, smaller increments will not
  /// help.
  double smallest_after(const Outcome& outcome) const {
    constexpr double largest = 1e-3, of_the_load = 1e-2;
    if (!outcome.branches()) return smallest_increment;
    return std::max(smallest_increment, std::min(largest, of_the_load * report_.load_factor));
  }
  /// Increment of the load to leap over the end of a branch, or to where it is clearly unstable, but not far.
  double leap() const {
    constexpr double longest = 1e-2, of_the_load = 0.1;
    return std::min(longest, of_the_load * report_.load_factor);
  }
  double load_after(double increment) const { return std::min(1.0, report_.load_factor + increment); }

  /// Newton's method at a load factor, from the last equilibrium to a stable one within the bound on the
  /// change, and on its branch. If the tangent is singular its direction has no meaning, and neither has the
  /// equilibrium found.
  Outcome reach(double factor, FirstStep first = FirstStep::full) {
    ++report_.load_steps;
    State trial = state_;
    const Vector way = heading(factor);
    Outcome outcome = newton(factor, trial, first);
    const double moved = change(trial, state_);
    outcome.turns_back = moved > noticeable_change && (trial.q - state_.q).cwiseQuotient(scale_).dot(way) < 0;
    if (outcome.branches() && change(trial, start_) <= settled_change) report_.leaves_start = true;
    outcome.converged = outcome.converged && !outcome.singular_at_start && !outcome.unstable() &&
                        moved <= largest_change && !outcome.turns_back;
    if (outcome.converged) accept(factor, trial, outcome);
    return outcome;
  }

  /// The move of the last equilibrium to a load factor by its tangent, in scaled coordinates; zero where the
  /// tangent is singular.
  Vector heading(double factor) {
    equations_.clear_proximity();
    equations_.set_load(report_.load_factor);
    const Vector x = equations_.scaled_unknowns(state_);
    Vector rows(equations_.size());
    if (!equations_.differentiate(x) || !kkt_solver_.factorise(equations_.tangent()))
      return Vector::Zero(scale_.size());
    equations_.set_load(factor);
    if (!equations_.evaluate(x, rows)) return Vector::Zero(scale_.size());
    const Vector move = -kkt_solver_.solve(rows).head(scale_.size());
    return move.allFinite() ? move : Vector::Zero(scale_.size());
  }

  /// Proximal steps at a load factor, from the last equilibrium, until plain Newton converges nearby to a
  /// stable equilibrium. An unstable one is left along its unstable direction.
  bool relax(double factor) {
    equations_.set_load(factor);
    State centre = state_;
    centre.load = factor;
    const double inertia = equations_.inertial_work(centre);
    if (!(inertia > 0)) return false;
    double proximity = 10 * sizes_.largest_force(centre) / inertia, tolerance = proximal_tolerance;
    std::optional<Vector> left;  // the unstable equilibrium
    while (steps_left()) {
      ++report_.load_steps;
      State trial = centre;
      const Outcome step = proximal_step(proximity, tolerance, trial);
      const double moved = change(trial, centre);
      // The energy falls from step to step, and never leads back to the unstable equilibrium.
      const bool back =
          left && change(trial.q, *left) < std::min(0.9 * change(centre.q, *left), settled_change);
      if (!step.converged || !(moved <= largest_change) || back) {
        proximity *= 10;
        continue;
      }
      centre = trial;
      if (settings_.ends_at && settings_.ends_at(centre)) {
        state_ = resting(system_, centre);
        ended_ = true;
        return false;
      }
      const Outcome settled = moved <= settled_change ? newton(factor, trial) : Outcome{};
      const double settling = change(trial, centre);
      if (settled.converged && !settled.unstable() && settling <= largest_change) {
        accept(factor, trial, settled);
        return true;
      }
      // Unstable equilibria are left one after the other, as parts pressed together hard have many; also the
      // one where the descent ends.
      const double passed = left ? change(trial.q, *left) : std::numeric_limits<double>::infinity();
      const bool arrived = settling <= departing_change / 10 && passed > departing_change / 10;
      if (settled.unstable() && settling <= settled_change && (passed > settled_change || arrived)) {
        left = trial.q;
        centre.q = trial.q + departure(settled.stability);
        continue;
      }
      // Soft parts beside large forces move only if these are closed well.
      if (step.iterations == 0) tolerance = std::max(tolerance / 100, settings_.tolerance);
      proximity *= step.iterations <= easy_iterations ? 0.2 : 0.5;
    }
    return false;
  }

  /// The move off an unstable equilibrium along its unstable direction.
  Vector departure(const Stability& from) const {
    return departing_change / from.direction.lpNorm<Eigen::Infinity>() * from.direction.cwiseProduct(scale_);
  }

  /// Solves the equilibrium at `factor` from `trial`, in place; the equations are rescaled as the multipliers
  /// become known.
  ///
  /// Full Newton steps come first: where stiff members turn, a line search would follow them in tiny steps.
  Outcome newton(double factor, State& trial, FirstStep first = FirstStep::full) {
    trial.load = factor;
    equations_.set_load(factor);
    equations_.clear_proximity();
    equations_.rescale(trial, sizes_.largest_force(trial));
    auto quality = equations_.quality(equations_.scaled_unknowns(trial), settings_.tolerance);
    Outcome outcome{.converged = quality.residual_norm <= settings_.tolerance,
                    .residual_norm = quality.residual_norm};
    // Without loads as a measure, a residual at round-off is accepted: in a model that moves freely nothing
    // tells where a smaller one is.
    const bool is_loaded = sizes_.applied_force(trial) > 0;
    if (quality.acceptable && !is_loaded) outcome = {.converged = true};
    if (!outcome.converged) outcome.singular_at_start = !kkt_solver_.factorise(equations_.tangent());
    if (first == FirstStep::bounded) {
      const bool bounds = !outcome.converged && !outcome.singular_at_start && take_bounded_step(trial);
      // The attempt with full steps has given this result.
      if (!bounds) return {.residual_norm = outcome.residual_norm};
    }
    const auto improve_by = [&](int strategy, int iterations) {
      Vector x = equations_.scaled_unknowns(trial);
      const auto found = improved(x, quality.allowed, strategy, iterations, outcome);
      // Where a residual is mostly the round-off of large forces, the rest of a small force still counts.
      const bool settles = found.acceptable && !quality.acceptable;
      const bool better = settles || found.residual_norm <= outcome.residual_norm;
      if (better) trial = equations_.state_of(x);
      equations_.rescale(trial, sizes_.largest_force(trial));
      quality = equations_.quality(equations_.scaled_unknowns(trial), settings_.tolerance);
      outcome.residual_norm = quality.residual_norm;
      outcome.converged = quality.acceptable;
    };
    if (!outcome.converged) improve_by(KIN_NONE, settings_.max_iterations);
    if (!outcome.converged) improve_by(KIN_LINESEARCH, std::min(20, settings_.max_iterations));
    if (outcome.residual_norm > settings_.tolerance) {
      // Soft parts may be displaced as far as the round-off of large forces makes their own small forces
      // wrong.
      constexpr double of_the_way = 1e-2, of_the_scale = 1e-6;
      const double left = outcome.converged ? polish(trial) : 0;
      const bool is_lost = is_loaded && left > std::max(of_the_way * change(trial, start_), of_the_scale);
      outcome.converged = outcome.converged && !is_lost;
      lost_in_round_off_ = lost_in_round_off_ || is_lost;
      outcome.residual_norm =
          equations_.quality(equations_.scaled_unknowns(trial), settings_.tolerance).residual_norm;
    }
    if (outcome.converged) outcome.stability = stability_of(trial);
    report_.status = outcome.unstable()          ? StaticStatus::unstable
                     : outcome.singular_at_start ? StaticStatus::singular_matrix
                                                 : StaticStatus::not_converged;
    report_.residual_norm = outcome.residual_norm;
    return outcome;
  }

  /// Newton's first step, bounded, where it leads out of the model. A straight wire's step does, as the wire
  /// is soft only while it is straight. The step goes as far as the forces along it lead; after it, full
  /// steps know the stiffness. Returns whether there was such a step.
  bool take_bounded_step(State& trial) {
    const int n = equations_.coordinates();
    const Vector x = equations_.scaled_unknowns(trial);
    Vector rows(equations_.size());
    if (!equations_.evaluate(x, rows)) return false;
    const Vector step = -kkt_solver_.solve(rows);
    const double length = step.head(n).lpNorm<Eigen::Infinity>();
    if (!step.allFinite() || !(length > largest_change)) return false;
    const auto leads_on = [&](double part) {
      return equations_.evaluate(x + part * step, rows) && rows.head(n).dot(step.head(n)) < 0;
    };
    double high = largest_change / length, low = high;
    constexpr int most_tenths = 12, most_halvings = 12;
    for (int i = 0; i < most_tenths && !leads_on(low); ++i) low = (high = low) / 10;
    if (low == high) return false;
    for (int i = 0; i < most_halvings; ++i) {
      const double middle = std::sqrt(low * high);
      (leads_on(middle) ? low : high) = middle;
    }
    trial = equations_.state_of(x + low * step);
    return true;
  }

  /// The stability of the equilibrium whose tangent the equations have.
  Stability stability_of(const State& equilibrium) {
    const int n = equations_.coordinates();
    report_.diverges = false;
    if (const auto by_energy = stability(equations_.tangent(), n)) return *by_energy;
    if (!for_stability_) return {};
    const Stability found = divergence(equilibrium);
    if (found.unstable_directions > 0 && !std::exchange(diverged_, true)) spent_ = 0;
    report_.diverges = found.unstable_directions > 0;
    return found;
  }
  Stability divergence(const State& equilibrium) {
    const Eigen::SparseMatrix<double> tangent = equations_.tangent();
    return nurbeam::divergence(tangent, equations_.coordinates(), [&] {
      spent_ += judgement_cost;  // asked for where the symmetric part does not settle it
      return equations_.inertia(equilibrium);
    });
  }
  /// Whether the last equilibrium diverges, where equilibria on the way were not asked for that.
  bool final_diverges() {
    equations_.clear_proximity();
    equations_.set_load(report_.load_factor);
    const Vector x = equations_.scaled_unknowns(state_);
    Vector rows(equations_.size());
    if (!equations_.evaluate(x, rows) || !equations_.differentiate(x) ||
        is_symmetric(equations_.tangent(), equations_.coordinates()))
      return false;
    return divergence(state_).unstable_directions > 0;
  }

  /// Newton's corrections of a converged state, as long as they shrink. Returns the largest last correction,
  /// in scaled coordinates, which is round-off; 0 where the tangent is singular.
  double polish(State& trial) {
    constexpr int most_corrections = 8;
    Vector x = equations_.scaled_unknowns(trial), rows(equations_.size());
    double last = std::numeric_limits<double>::infinity(), left = 0;
    for (int i = 0; i < most_corrections; ++i) {
      if (!equations_.evaluate(x, rows) || !equations_.differentiate(x)) return left;
      const EquilibratedKkt kkt(equations_.tangent(), equations_.coordinates());
      if (!kkt.regular()) return left;
      const Vector correction = kkt.solve(rows);
      left = correction.head(equations_.coordinates()).lpNorm<Eigen::Infinity>();
      if (!(left < last / 2)) break;
      x -= correction;
      last = left;
      trial = equations_.state_of(x);
    }
    return left;
  }

  /// Solves M(q)(q - q_k) proximity - f + G'lambda = 0 from q_k = trial.q, in place.
  Outcome proximal_step(double proximity, double tolerance, State& trial) {
    equations_.rescale(trial, sizes_.largest_force(trial));
    equations_.set_proximity(proximity, trial.q);
    Vector x = equations_.scaled_unknowns(trial);
    Outcome outcome;
    improve(x, Vector::Constant(x.size(), tolerance), KIN_NONE, proximal_iterations, outcome);
    outcome.converged = equations_.quality(x, tolerance).acceptable;
    trial = equations_.state_of(x);
    equations_.clear_proximity();
    return outcome;
  }

  /// Improves x as improve() does. Now and then it checks whether the remainder is the round-off of forces
  /// that have come up on the way.
  ScaledEquations::Quality improved(Vector& x, const Vector& allowed, int strategy, int iterations,
                                    Outcome& outcome) {
    constexpr int some = 10;
    ScaledEquations::Quality found{.allowed = allowed};
    for (int left = iterations; left > 0 && !found.acceptable; left -= some) {
      const int before = outcome.iterations;
      improve(x, found.allowed, strategy, std::min(some, left), outcome);
      found = equations_.quality(x, settings_.tolerance);
      if (outcome.iterations - before < some || !std::isfinite(found.residual_norm)) break;
    }
    return found;
  }

  void improve(Vector& x, const Vector& allowed, int strategy, int max_iterations, Outcome& outcome) {
    const int iterations = kinsol_.improve(x, allowed, strategy, max_iterations);
    outcome.iterations += iterations;
    report_.newton_iterations += iterations;
    spent_ += iterations;
  }

  double change(const Vector& a, const Vector& b) const {
    return (a - b).cwiseQuotient(scale_).lpNorm<Eigen::Infinity>();
  }
  double change(const State& a, const State& b) const { return change(a.q, b.q); }

  void accept(double factor, const State& equilibrium, const Outcome& outcome) {
    state_ = resting(system_, equilibrium);
    report_.load_factor = factor;
    report_.residual_norm = outcome.residual_norm;
    report_.status = factor == 1 ? StaticStatus::converged : StaticStatus::not_converged;
    lost_in_round_off_ = false;
    ended_ = factor != 1 && settings_.ends_at && settings_.ends_at(state_);
  }

  bool steps_left() const {
    constexpr int share = 2;  // divisor that leaves steps for another search
    if (!diverged_) return report_.load_steps < settings_.max_load_steps;
    return report_.load_steps < settings_.max_load_steps / share && spent_ < *for_stability_;
  }

  const StaticEquilibrium& settings_;
  const Allowance for_stability_;
  const SecondOrderSystem& system_;
  Vector scale_;
  const ForceSizes sizes_;
  State state_;
  const State start_;
  StaticReport report_;
  bool lost_in_round_off_ = false;  // since the last equilibrium
  bool ended_ = false;              // whether settings_.ends_at has ended the search
  bool diverged_ = false;           // an equilibrium on the way diverges
  int spent_ = 0;  // in Newton iterations; since the first equilibrium that diverges, if there is one
  ScaledEquations equations_;
  Kinsol kinsol_;
  KktSolver kkt_solver_;
};

/// What may be spent on a stable equilibrium where one that diverges is found for `cost`, in Newton
/// iterations.
int allowance_for_stability(bool is_found, int cost) {
  constexpr int times = 10, least = 500;
  return is_found ? std::max(least, times * cost) : std::numeric_limits<int>::max();
}

}  // namespace

StaticReport find_static_equilibrium(const StaticEquilibrium& settings, const SecondOrderSystem& system,
                                     State& state) {
  constexpr const char* method = "static equilibrium";
  require(settings.tolerance > 0, method, "tolerance ", settings.tolerance, " is not positive");
  require(settings.max_iterations > 0, method, "max_iterations ", settings.max_iterations,
          " is not positive");
  require_size(method, "q", state.q.size(), system.coordinate_count());
  EquilibriumSearch first(settings, system, state, 0);
  const StaticReport report = first.run();
  if (!first.wants_stability()) {
    state = first.state();
    return report;
  }
  EquilibriumSearch any(settings, system, state, std::nullopt);
  const StaticReport diverging = any.run();
  EquilibriumSearch stable(settings, system, state, allowance_for_stability(any.has_answer(), any.spent()));
  const StaticReport found = stable.run();
  const bool is_stable = stable.has_answer() || !any.has_answer();
  state = is_stable ? stable.state() : any.state();
  StaticReport answer = is_stable ? found : diverging;
  answer.newton_iterations = report.newton_iterations + diverging.newton_iterations + found.newton_iterations;
  return answer;
}

}  // namespace nurbeam
