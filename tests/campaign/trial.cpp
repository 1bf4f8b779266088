#include "tests/campaign/trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <variant>
#include <vector>

#include "fem/motion/events/kinks.h"
#include "fem/motion/rest/resting_place.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "nurbs/gauss_panels.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/model/build_model.h"
#include "solver/system/consistent.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam::campaign {

namespace {

using Eigen::Vector3d;
constexpr double most_imbalance = 1e-8;

// Whether sharp kinks or clamps of a beam may leave its bending to layers that the mesh does not show.
bool has_sharp_places(const BeamModel& model, int b) {
  const auto is_sharp = [](const HomeNode& node) {
    return node.kind == NodeKind::kink || node.sharp || node.sharp_clamp;
  };
  return std::any_of(model.beams[b].home.begin(), model.beams[b].home.end(), is_sharp) ||
         std::any_of(model.riders.begin(), model.riders.end(), [&](const Rider& rider) {
           return rider.beam == b && (rider.sharp || !rider.continuous_slope);
         });
}

double sum(double value) { return value; }
double sum(const Eigen::Vector4d& samples) { return samples.sum(); }
bool is_empty(double value) { return std::isnan(value); }
bool is_empty(const Eigen::Vector4d& samples) { return samples.array().isNaN().all(); }

// What is left of section forces to be finite: bending may be empty as a whole beside a sharp place.
template <class Section>
double finite_part(const Section& section, bool may_be_empty) {
  const double always = sum(section.axial_force) + sum(section.torque);
  if (may_be_empty && is_empty(section.bending_moment) && is_empty(section.shear_force)) return always;
  return always + sum(section.bending_moment) + sum(section.shear_force);
}

// The name of a quantity that is not finite; empty where all are.
std::string not_finite(const BeamModel& model, const std::vector<Probe>& probes, const Snapshot& frame) {
  std::string name;
  const auto look = [&](const char* what, double value) {
    if (name.empty() && !std::isfinite(value)) name = what + (" at t = " + std::to_string(frame.time));
  };
  const EnergyRecord& e = frame.energy;
  look("an energy", e.total + e.kinetic + e.input + e.dissipated);
  for (std::size_t i = 0; i < frame.probes.size(); ++i) {
    const ProbeRecord& p = frame.probes[i];
    look("a probe's motion", p.position.sum() + p.velocity.sum() + p.displacement.sum());
    look("a probe's section force", finite_part(p.section, has_sharp_places(model, probes[i].beam)));
  }
  for (const BodyRecord& b : frame.bodies) {
    look("a body's motion", b.point.position.sum() + b.point.velocity.sum());
    look("a joint's force", b.joint_force.sum());
    look("a holding force", b.holding_force);
  }
  for (std::size_t b = 0; b < frame.beams.size(); ++b)
    for (const ElementRecord& element : frame.beams[b].elements) {
      look("a shape", element.control_points.sum() + element.velocity.sum());
      look("a section force", finite_part(element, has_sharp_places(model, static_cast<int>(b))));
    }
  for (const ReactionRecord& r : frame.reactions)
    look("a reaction", r.force.sum() + r.couple.sum() + r.position.sum());
  return name;
}

// ---- Balance of forces ----

/// d(momentum)/dt at fixed force, and what round-off leaves of it.
struct MomentumRate {
  Vector3d value;
  double noise;
};

/// By central differences along q', v'.
MomentumRate momentum_rate(const BeamSystem& system, const State& state) {
  const auto at = [&](double h) {
    State moved = state;
    moved.q += h * state.v + h * h / 2 * state.a;
    moved.v += h * state.a;
    return momentum(system, moved);
  };
  // Momentum is linear in v and nearly so in q: the step only has to be short of what turns sections round.
  const double fastest = state.v.cwiseQuotient(system.coordinate_scale()).lpNorm<Eigen::Infinity>();
  const double turn = std::sqrt(state.a.cwiseQuotient(system.coordinate_scale()).lpNorm<Eigen::Infinity>());
  const double h = 1e-3 / std::max({fastest, turn, 1e-3});
  const auto slope = [&](double step) -> Vector3d { return (at(step) - at(-step)) / (2 * step); };
  constexpr double digits = 1e-15;
  return {(4 * slope(h / 2) - slope(h)) / 3, digits * momentum(system, state).norm() / h};
}

struct Loads {
  Vector3d sum = Vector3d::Zero();
  double largest = 0;
  void add(const Vector3d& force) {
    sum += force;
    largest = std::max(largest, force.norm());
  }
};

/// What the damping of mass does to all beams.
Vector3d mass_damping_force(const BeamSystem& system, const State& state) {
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < static_cast<int>(system.mesh().spans.size()); ++i) {
    const MeshSpan& span = system.mesh().spans[i];
    const BeamProperties& beam = system.model().beams[span.beam].properties;
    if (beam.mass_damping == 0) continue;
    const double a = span.start(state.q), b = span.end(state.q);  // of rings on one turn
    for (int d = 0; d < 3; ++d)
      force[d] -= beam.mass_damping * beam.mass_per_length *
                  gauss([&](double s) { return material_point_in(system, state, i, s).velocity[d]; }, a, b);
  }
  return force;
}

/// What points in space give through connectors.
Vector3d force_of_points(const BeamSystem& system, const State& state) {
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < static_cast<int>(system.model().connectors.size()); ++i) {
    const Connector& connector = system.model().connectors[i];
    const Vector3d d = grip_place(system, state, connector.ends[1], "an end") -
                       grip_place(system, state, connector.ends[0], "an end");
    const Vector3d n = connector.direction ? *connector.direction : Vector3d(d.normalized());
    const double pull = length_and_force(system, state, i).second;
    if (connector.ends[1].is_point()) force += pull * n;
    if (connector.ends[0].is_point()) force -= pull * n;
  }
  return force;
}

/// Of the air on a body [N].
Vector3d air_drag(const BeamSystem& system, const State& state, int body) {
  const BeamModel& model = system.model();
  const Vector3d w = model.air.wind - vector_at(system, state.v, system.mesh().bodies[body]);
  return state.load * model.air.density / 2 * model.bodies[body].drag_area * w.norm() * w;
}

/// Whether what a constraint gives comes from outside of beams and bodies.
bool is_held_by_space(const Constraint& constraint) {
  const auto* joint = std::get_if<BodyJoint>(&constraint);
  return std::holds_alternative<Support>(constraint) || std::holds_alternative<HeldBody>(constraint) ||
         (joint && joint->to.is_point());
}

/// Weight, loads and reactions at a moment.
Loads external_forces(const BeamSystem& system, const State& state) {
  Loads loads;
  const BeamModel& model = system.model();
  for (const Beam& beam : model.beams)
    loads.add(beam.properties.mass_per_length * beam.curve.length() * model.gravity);
  for (const Body& body : model.bodies) loads.add(body.mass * model.gravity);
  // Residual without inertia, at rest and without multipliers, in the directions of translation: less the
  // loads, whatever they are; weight is known already.
  State free = state;
  free.v.setZero();
  free.a.setZero();
  free.lambda.setZero();
  Eigen::VectorXd rows(system.coordinate_count()), none(system.constraint_count());
  system.residual(free, rows, none);
  Vector3d of_rows = Vector3d::Zero();
  std::set<int> added;  // a body that slides on a node is that node
  const auto add = [&](int first) {
    if (!added.insert(first).second) return;
    for (int d = 0; d < system.dimension(); ++d) of_rows[d] -= rows[first + d];
  };
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) add(node.r);
  for (const int r : system.mesh().bodies) add(r);
  loads.add(of_rows - loads.sum);
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body)
    loads.add(air_drag(system, state, body) - air_drag(system, free, body));
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j)
    if (model.beam_of(model.riders[j]).rigid) loads.add(joint_force(system, state, j));
  loads.add(mass_damping_force(system, state));
  if (model.field) loads.add(state.load * model.field->by_velocity() * momentum(system, state));
  loads.add(force_of_points(system, state) - force_of_points(system, free));
  double length = 0;
  for (const Beam& beam : model.beams) length += beam.curve.length();
  for (int i = 0; i < static_cast<int>(model.constraints.size()); ++i) {
    const auto [force, couple] = reaction(system, state, state.lambda, i);
    if (length > 0) loads.largest = std::max(loads.largest, couple.norm() / length);  // as a pair of forces
    if (is_held_by_space(model.constraints[i]))
      loads.add(force);
    else
      loads.largest = std::max(loads.largest, force.norm());  // between beams
  }
  return loads;
}

/// What round-off of positions leaves of the inertia after a step of that length.
double inertia_noise(const BeamSystem& system, const State& state, double step) {
  constexpr double digits = 1e-15;
  double mass = 0;
  for (const Beam& beam : system.model().beams) mass += beam.properties.mass_per_length * beam.curve.length();
  for (const Body& body : system.model().bodies) mass += body.mass;
  return mass * digits * state.q.lpNorm<Eigen::Infinity>() / (step * step);
}

/// `noise`: of the accelerations [N].
double imbalance(const BeamSystem& system, const State& state, double noise = 0) {
  const Loads loads = external_forces(system, state);
  const auto [inertia, of_rate] = momentum_rate(system, state);
  // Where nothing acts forces are what round-off leaves of strains: those of a millionth are compared.
  double largest = std::max(loads.largest, inertia.norm());
  for (const Beam& beam : system.model().beams)
    largest = std::max(largest, 1e-6 * beam.properties.axial_stiffness);
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j)
    largest = std::max(largest, joint_force(system, state, j).norm());
  return largest > 0 ? std::max(0.0, (inertia - loads.sum).norm() - of_rate - noise) / largest : 0;
}

bool same_mesh(const MeshPlan& a, const MeshPlan& b) {
  if (a.modes != b.modes || a.places != b.places || a.section_charts.size() != b.section_charts.size())
    return false;
  for (std::size_t i = 0; i < a.beams.size(); ++i)
    if (a.beams[i].present != b.beams[i].present) return false;
  for (std::size_t i = 0; i < a.section_charts.size(); ++i)
    if (a.section_charts[i].charts != b.section_charts[i].charts) return false;
  return true;
}

// ---- One run ----

struct Trial {
  SimulationReport report;
  std::string not_finite = {};
  double imbalance = 0, imbalance_time = 0;
  std::size_t frames = 0;
};

SimulationOptions options_of(const CaseAnalysis& a, int refinement) {
  SimulationOptions options;
  options.statics = a.type == CaseAnalysis::Type::statics;
  options.start_from_equilibrium = a.start_from_equilibrium;
  options.end_time = a.end_time;
  options.length_control = a.length_control;
  options.integrator = a.integrator;
  const double finer = std::pow(2, refinement);
  if (a.step) options.step = *a.step / finer;
  if (auto* method = std::get_if<GeneralizedAlpha>(&options.integrator); method && method->tolerance > 0)
    method->tolerance /= std::pow(finer, 3);
  if (auto* method = std::get_if<Radau>(&options.integrator)) method->tolerance /= std::pow(finer, 4);
  constexpr int frames = 20;
  for (int i = 0; !options.statics && i <= frames; ++i)
    options.output_times.push_back(i * a.end_time / frames);
  return options;
}

/// `balanced`: forces are looked at after every step.
Trial run(const BuiltModel& built, const SimulationOptions& options, bool balanced, long step_limit) {
  Trial trial;
  const auto model = std::make_shared<const BeamModel>(built.model);
  std::vector<ProbePlace> probes;
  for (const Probe& probe : built.probes) probes.push_back({probe.beam, probe.s});
  long steps = 0;
  const bool with_accelerations = std::holds_alternative<GeneralizedAlpha>(options.integrator) ||
                                  std::holds_alternative<Radau>(options.integrator);
  SimulationObserver observer;
  std::optional<MeshPlan> plan;
  std::size_t events = 0;
  double longest_step = 0;
  const auto start = std::chrono::steady_clock::now();
  bool left = false;
  observer.interrupted = [&] {
    left = steps > step_limit || std::chrono::steady_clock::now() - start > std::chrono::seconds(20);
    return left;
  };
  observer.snapshot = [&](const Snapshot& frame) {
    if (trial.not_finite.empty()) trial.not_finite = not_finite(*model, built.probes, frame);
    ++trial.frames;
  };
  observer.checkpoint_due = [&] {  // after every step
    ++steps;
    return balanced && with_accelerations && steps % 4 == 0;
  };
  observer.checkpoint = [&](const Checkpoint& point) {
    const bool goes_on = plan && same_mesh(*plan, point.plan) && events == point.report.events.size();
    plan = point.plan;
    events = point.report.events.size();
    // Right after a change of the mesh, where it may be left, or a jump of a prescribed speed accelerations
    // are means over the next step.
    if (!goes_on || point.restarted || left || !with_accelerations || point.steps.empty()) return;
    if (!motion_kinks(*model, point.state.t).empty()) return;
    // Where a run is about to fail its steps shorten until round-off, over their square, is what accelerates.
    const double step = point.steps.back().size;
    longest_step = std::max(longest_step, step);
    if (step < 1e-4 * longest_step) return;
    const BeamSystem system(model, point.plan);
    const double found = imbalance(system, point.state, inertia_noise(system, point.state, step));
    if (!(found <= trial.imbalance)) {
      trial.imbalance = found;
      trial.imbalance_time = point.state.t;
    }
  };
  trial.report = simulate(model, probes, options, observer);
  if (options.statics && trial.report.status == SimulationStatus::done) {
    MeshedState at = MeshedState::drawn(model);
    if (!find_rest(at, options.length_control, {}).failure) trial.imbalance = imbalance(*at.system, at.state);
  }
  return trial;
}

double energy_change(const SimulationReport& report) {
  return std::max(report.energy_drift, report.integration_error);
}

/// What a run that is not warned of may change the energy by.
double noticed(const SimulationReport& report) {
  return std::max(0.05 * report.energy_scale(), report.energy_round_off());
}

// A drift that does not fall with the step, or that nothing warns of.
std::string energy_complaint(const BuiltModel& built, const CaseAnalysis& analysis,
                             const SimulationReport& first, long most_steps) {
  constexpr double small = 1e-3, order_seen = 1.8;
  const auto is_small = [&](const SimulationReport& report) {
    return energy_change(report) <= std::max(small * report.energy_scale(), report.energy_round_off());
  };
  if (is_small(first)) return {};
  if (energy_change(first) > noticed(first)) return {};  // the run says so itself
  double last = energy_change(first);
  std::string seen = std::to_string(last / first.energy_scale());
  for (int refinement = 2; refinement <= 12;
       refinement += 2) {  // waves are damped until a step resolves them
    const Trial finer = run(built, options_of(analysis, refinement), false, most_steps << refinement);
    if (finer.report.status != SimulationStatus::done) return {};
    const double change = energy_change(finer.report);
    seen += ", " + std::to_string(change / finer.report.energy_scale());
    if (is_small(finer.report) || change < last / order_seen) return {};
    last = change;
  }
  return "energy changes by " + seen + " of what moves, with a quarter of the step each";
}

// A step that settles moves velocities behind its balance of forces, and dampers feel that: by little, and a
// run whose steps do not settle keeps the balance.
bool is_of_settling(const BuiltModel& built, SimulationOptions options, double imbalance, long step_limit) {
  constexpr double little = 1e-5;
  auto* method = std::get_if<GeneralizedAlpha>(&options.integrator);
  if (!method || !method->settles || !(imbalance <= little)) return false;
  method->settles = false;
  return run(built, options, true, step_limit).imbalance <= most_imbalance;
}

std::string first_words(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  for (int i = 0; i < 6 && words >> word; ++i)
    if (word.find_first_of("0123456789\"") == std::string::npos) result += (result.empty() ? "" : " ") + word;
  return result;
}

std::string all_of(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += d.where + ": " + d.message + "; ";
  return text;
}

}  // namespace

Verdict try_case(const std::filesystem::path& file, long most_steps) {
  const auto start = std::chrono::steady_clock::now();
  Verdict verdict;
  const auto finish = [&](std::string outcome, std::string complaint = {}) {
    verdict.outcome = std::move(outcome);
    verdict.complaint = std::move(complaint);
    verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return verdict;
  };
  const CaseFileReport read = read_case_file(file);
  if (!read.value)
    return finish("refused: " + first_words(all_of(read.diagnostics)),
                  "not a case: " + all_of(read.diagnostics));
  const BuildReport built = build_model(*read.value);
  if (!built.value)
    return finish("refused", all_of(built.diagnostics).empty() ? "refused without a word" : "");
  const SimulationOptions options = options_of(read.value->analysis, 0);
  const Trial trial = run(*built.value, options, true, most_steps);
  const SimulationReport& report = trial.report;
  verdict.imbalance = trial.imbalance;
  if (report.energy_scale() > 0) verdict.drift = energy_change(report) / report.energy_scale();
  // A run that says that it goes wrong may leave anything in its frames.
  const bool warned = energy_change(report) > noticed(report);
  if (!trial.not_finite.empty() && !warned) return finish("done", "not finite: " + trial.not_finite);
  if (!(trial.imbalance <= most_imbalance) && !warned &&
      !is_of_settling(*built.value, options, trial.imbalance, most_steps))
    return finish("done", "reactions, loads and inertia miss each other by " +
                              std::to_string(trial.imbalance * 1e9) +
                              "e-9 of the largest force at t = " + std::to_string(trial.imbalance_time));
  if (report.status == SimulationStatus::interrupted) return finish("too many steps or seconds");
  if (report.status == SimulationStatus::not_converged) {
    const std::string text = outcome_text(report, built.value->model);
    return finish(first_words(text), text.empty() || text == "done" ? "it ended without a word" : "");
  }
  if (trial.frames == 0) return finish("done", "there is no frame");
  return finish("done", energy_complaint(*built.value, read.value->analysis, report, most_steps));
}

Verdict try_case(const Json& c, long most_steps) {
  const test::TemporaryDirectory directory;
  return try_case(directory.write("case.json", c.dump()), most_steps);
}

}  // namespace nurbeam::campaign
