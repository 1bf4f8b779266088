#include "fem/motion/run/energy_account.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fem/motion/events/crossing.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

bool has_damped_beams(const BeamModel& model) {
  return std::any_of(
      model.beams.begin(), model.beams.end(), [](const Beam& beam) { return beam.properties.is_damped(); });
}

bool has_dampers(const BeamSystem& system) {
  return with_assembly(
      system,
      [&](const auto& a) {
        return std::any_of(
            a.forces().begin(), a.forces().end(),
            [&](const auto& force) {
              return std::visit(
                  [&](const auto& f) {
                    if constexpr (offers_of<decltype(f)>.damper) return f.is_damper(a.beams());
                    return false;
                  },
                  force);
            });
      });
}

// Whether energy may come from outside.
bool is_driven(const BeamModel& m) {
  return !m.forces.empty() || !m.air.wind.isZero() || has_prescribed_motions(m) ||
         std::any_of(
             m.riders.begin(), m.riders.end(),
             [](const Rider& rider) { return !rider.drive_force.empty(); }) ||
         std::any_of(
             m.beams.begin(), m.beams.end(),
             [](const Beam& beam) { return !beam.properties.free_strain.thermal.empty(); });
}

// Dissipation by the midpoint rule with the mean rates of the step, which a transient shorter than the step
// does not falsify. The middle is on the path, not on its chord, as a body that slides along a curve would
// leave it.
double dissipated_between(const BeamSystem& system, const State& from, const State& to) {
  State middle = from;
  const double h = to.t - from.t;
  middle.q = (from.q + to.q) / 2 + h / 8 * (from.v - to.v);
  middle.v = (to.q - from.q) / h;
  return h * energy(system, middle).dissipation;
}

// Work of the forces that the accelerations of a restart leave out of balance (make_accelerations_smooth),
// where damping ends it. The step does not follow these transients, and the trapezoidal rule takes half of
// them.
double unbalanced_work(const BeamSystem& system, const State& from, const State& to) {
  if (!has_damped_beams(system.model()) && !has_dampers(system)) return 0;
  Eigen::VectorXd dynamics(system.coordinate_count()), closed(system.constraint_count());
  system.residual(from, dynamics, closed);
  return dynamics.dot(to.q - from.q) / 2;
}

// Sum of energy(from, to) from each state on the way to the next.
template <class Energy>
double along(const StepPath& step, const Energy& energy) {
  double sum = 0;
  const State* from = &step.before;
  for (const State& to : step.within) sum += energy(*std::exchange(from, &to), to);
  return sum + energy(*from, step.after);
}

double lost_in_step(const BeamSystem& system, const StepPath& step, bool first) {
  const bool damped = has_damped_beams(system.model());
  const double lost = along(step, [&](const State& from, const State& to) {
    return (damped ? dissipated_between(system, from, to) : 0) + lost_energy(system, from, to);
  });
  const State& settled = step.within.empty() ? step.after : step.within.front();
  if (!first) return lost;
  // A transient gives no energy back either.
  return std::max(0.0, lost - unbalanced_work(system, step.before, settled));
}

// Integral of the polynomial through the values at the states after the start: for Radau's method by its
// weights. The value at the start is left out: it belongs to the interval before, and accelerations of
// prescribed motions may jump there.
template <class Rate>
double integral(const StepPath& step, const Rate& rate) {
  const double h = step.after.t - step.before.t;
  const auto count = static_cast<Eigen::Index>(step.within.size()) + 1;
  Eigen::MatrixXd powers(count, count);
  Eigen::VectorXd rates(count), means(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const State& state = i + 1 < count ? step.within[static_cast<std::size_t>(i)] : step.after;
    rates[i] = rate(state);
    for (Eigen::Index k = 0; k < count; ++k)
      powers(k, i) = std::pow((state.t - step.before.t) / h, static_cast<double>(k));
    means[i] = 1 / static_cast<double>(i + 1);
  }
  return h * powers.partialPivLu().solve(means).dot(rates);
}

// Work of loads by Simpson's rule: extrapolated from the sums over the halves and over the whole, which are
// of second order.
double load_work_by_halves(const BeamSystem& system, const State& from, const State& to) {
  const State middle = between(from, to, 0.5);
  const double halves = load_work(system, from, middle) + load_work(system, middle, to);
  return halves + (halves - load_work(system, from, to)) / 3;
}

double taken_in_step(const BeamSystem& system, const StepPath& step, const StepPath& forces) {
  const double by_loads = along(step, [&](const State& from, const State& to) {
    return step.is_cubic ? load_work_by_halves(system, from, to) : load_work(system, from, to);
  });
  if (!has_prescribed_motions(system.model()) || !(step.after.t > step.before.t)) return by_loads;
  if (step.within.empty()) return by_loads + motion_work(system, forces.before, forces.after);
  return by_loads + integral(forces, [&](const State& state) { return motion_power(system, state); });
}

// Energy added by events that the account does not include.
double given_by_events(const std::vector<RunEvent>& events) {
  double given = 0;
  for (const RunEvent& event : events)
    if (!is_booked(event.kind)) given += event.energy_after - event.energy_before;
  return given;
}

// Whether a prescribed motion of rigid bodies begins: the first step out of rest has an error in proportion
// to its speed, however short it is, where the motion begins with a high power of time.
bool leaves_rest(const BeamModel& model, const State& before) {
  return before.v.isZero(0) && has_prescribed_motions(model) &&
         std::ranges::any_of(
             model.bodies, [](const Body& body) { return body.rigid.has_value(); });
}

}  // namespace

bool has_prescribed_motions(const BeamModel& model) {
  return std::any_of(
             model.riders.begin(), model.riders.end(),
             [](const Rider& rider) { return rider.motion.has_value(); }) ||
         std::any_of(model.constraints.begin(), model.constraints.end(), is_moved);
}

void EnergyAccount::begin(const BeamSystem& system, const State& state) {
  start_ = energy(system, state).mechanical() + dissipated_ - input_;
}

void EnergyAccount::add_step(const BeamSystem& system, const StepPath& step, bool first,
                             const StepPath& forces) {
  if (step.after.t > step.before.t) dissipated_ += lost_in_step(system, step, first);
  if (is_driven(system.model())) input_ += taken_in_step(system, step, forces);
}

bool EnergyAccount::creates_energy(const BeamSystem& system, const StepPath& step, bool first,
                                   const SimulationReport& report) {
  constexpr double most = 0.05, round_off = 1e-10;
  if (leaves_rest(system.model(), step.before)) return false;
  const bool known = !first && known_.first == step.before.t;
  const SystemEnergy old = known ? known_.second : energy(system, step.before);
  const SystemEnergy now = energy(system, step.after);
  known_ = {step.after.t, now};
  double gained = now.mechanical() - old.mechanical();
  gained += lost_in_step(system, step, first);
  if (is_driven(system.model())) gained -= taken_in_step(system, step, step);
  const double strain = old.strain(), fallen = std::abs(now.gravity - old.gravity);
  const double scale = std::max({report.peak_kinetic_energy, old.kinetic, now.kinetic, strain, fallen});
  return gained > most * scale + round_off * (scale + std::abs(old.gravity)) + report.energy_noise;
}

void EnergyAccount::enter(Snapshot& snapshot) const {
  snapshot.energy.dissipated = dissipated_;
  snapshot.energy.input = input_;
  snapshot.energy.total += dissipated_ - input_;
}

void EnergyAccount::record(const Snapshot& snapshot, SimulationReport& report) {
  const double drift = snapshot.energy.total - start_;
  report.energy_drift = std::max(report.energy_drift, std::abs(drift));
  report.integration_error =
      std::max(report.integration_error, std::abs(drift - given_by_events(report.events)));
  const double kinetic = snapshot.energy.kinetic - snapshot.energy.adrift;
  report.peak_kinetic_energy = std::max(report.peak_kinetic_energy, kinetic);
  report.strain_energy.add(snapshot.energy.axial + snapshot.energy.bending + snapshot.energy.spring);
  const bool falls = std::ranges::any_of(snapshot.bodies, &BodyRecord::adrift);
  if (!falls) report.gravity_energy.add(snapshot.energy.gravity);
}

std::optional<double> EnergyAccount::from_nowhere(const BeamSystem& system, const State& state,
                                                  const SimulationReport& report, double slight) const {
  const SystemEnergy now = energy(system, state);
  const double created = now.mechanical() + dissipated_ - input_ - start_ - given_by_events(report.events);
  EnergyRange strain = report.strain_energy, gravity = report.gravity_energy;
  strain.add(now.strain());
  gravity.add(now.gravity);
  const double moves = std::max({report.peak_kinetic_energy, now.kinetic, strain.width(), gravity.width()});
  constexpr double round_off = 1e-12;
  const double passed = round_off * (std::abs(input_) + std::abs(dissipated_));
  if (std::isfinite(created) && created <= std::max(slight, moves + report.energy_round_off() + passed))
    return {};
  return created;
}

double slight_bending(const BeamModel& model) {
  constexpr double angle = 0.1;
  double energy = 0;
  for (const Beam& beam : model.beams)
    if (!beam.rigid) energy += beam.properties.bent_energy(angle, beam.curve.length());
  return energy;
}

double energy_noise(const BeamModel& model) {
  constexpr double round_off = 1e-11, of_heat = 1e-3;
  double noise = 0, longest = 0;
  for (const Beam& beam : model.beams) {
    longest = std::max(longest, beam.curve.length());
    double strain = round_off;
    for (const auto& [time, expansion] : beam.properties.free_strain.thermal)
      strain = std::max(strain, of_heat * std::abs(expansion));
    noise += beam.properties.small_strain_energy(strain) * beam.curve.length();
  }
  for (const Body& body : model.bodies) noise += round_off * body.mass * model.gravity.norm() * longest;
  return noise;
}

bool changes_energy(const BeamModel& model, const SystemEnergy& now, const RunEvent& event,
                    const SimulationReport& report, double most) {
  constexpr double round_off = 1e-10;
  const Beam& beam = model.beams[event.beam];
  if (beam.merge != MergeRule::standard || beam.properties.axial_strain == AxialStrain::pointwise)
    return false;
  const double jump = event.energy_after - event.energy_before;
  const double moves = std::max(now.kinetic, now.strain());
  const double allowed = most * moves + round_off * (moves + std::abs(now.gravity)) + report.energy_noise;
  return !(std::abs(jump) <= allowed);
}

}  // namespace nurbeam
