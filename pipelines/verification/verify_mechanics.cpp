// Tension as a number, damping, hanging bodies, droppers and sprung masses: against closed forms,
// boundary-value problems and ordinary differential equations that know no element.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "fem/motion/rest/modes.h"
#include "fem/system/initial_state.h"
#include "pipelines/verification/hanging_string.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_run.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using std::numbers::pi;
constexpr double standard_gravity = 9.81;

BeamProperties taut(double EA, double EI, double mass, double tension) {
  BeamProperties p(EA, EI, mass);
  p.free_strain.of_tension = -tension / EA;
  return p;
}

int add_line(ModelBuilder& builder, double length, const BeamProperties& properties, int elements) {
  return builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {length, 0, 0})}, 2), properties, {elements});
}

Snapshot at_rest(const BeamModel& model, const std::vector<ProbePlace>& probes) {
  std::optional<Snapshot> found;
  SimulationOptions options;
  options.statics = true;
  options.output_times = {0};
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { found = frame; };
  const SimulationReport report =
      simulate(noted(model, options), probes, at_problem_level(options), observer);
  if (report.failure || !found) throw std::runtime_error("no rest was found");
  return *found;
}

// ---- A string that vibrates ----

constexpr double string_length = 10, string_tension = 2000, string_mass = 0.5;

BeamModel vibrating_string(const BeamProperties& properties) {
  ModelBuilder builder(2);
  const int b = add_line(builder, string_length, properties, 20);
  return builder.pin(b, 0).pin(b, string_length).build();
}

// The middle of a string that is let go in the shape of its first mode, with an amplitude of 1e-6 of its
// length.
std::vector<double> decay(const BeamProperties& properties, double step, const std::vector<double>& times) {
  const double amplitude = 1e-6 * string_length;
  const BeamSystem system(noted(vibrating_string(properties)));
  State state = drawn_state(system);
  const Mesh& mesh = system.mesh();
  double middle = -1;
  for (const MeshNode& node : mesh.nodes[0]) {
    const double phase = pi * node.s / string_length;
    if (node.s > 0 && node.s < string_length) state.q[node.r + 1] += amplitude * std::sin(phase);
    state.q[node.slope_left + 1] += amplitude * pi / string_length * std::cos(phase);
    if (std::abs(node.s - string_length / 2) < 1e-9) middle = node.r + 1;
  }
  if (make_accelerations_consistent(system, state) != ConsistencyStatus::done)
    throw std::runtime_error("no accelerations");
  GeneralizedAlphaIntegrator integrator({.rho_infinity = 0.9}, system, state);
  std::vector<double> values;
  for (const double time : times) {
    while (integrator.state().t < time - step / 2)
      if (integrator.advance(step).status != StepStatus::converged) throw std::runtime_error("a step failed");
    values.push_back(integrator.state().q[static_cast<long>(middle)] / amplitude);
  }
  return values;
}

VerifyResult tension() {
  VerifyResult result;
  const double EA = 1e6, speed = std::sqrt(string_tension / string_mass), unit = pi * speed / string_length;
  const BeamProperties properties = taut(EA, 1e-9, string_mass, string_tension);
  const ModesReport modes =
      find_modes(std::make_shared<const BeamModel>(noted(vibrating_string(properties), ModesOptions{})),
                 {.count = 3}, [] { return false; });
  for (int n = 1; n <= 3; ++n)
    result.add("string under tension [rad/s], mode " + std::to_string(n), n * unit, "n pi c/L",
               modes.modes.at(n - 1).omega, 1e-5 * n * unit);
  const double step = 1e-4;
  const std::vector<double> times{0.1, 0.5, 1};
  BeamProperties lossy = properties;
  lossy.mass_damping = 2;
  const std::vector<double> by_mass = decay(lossy, step, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i], fast = std::sqrt(unit * unit - 1);
    result.add("its middle with mass damping [amplitudes], t = " + std::to_string(t).substr(0, 3) + " s",
               std::exp(-t) * (std::cos(fast * t) + std::sin(fast * t) / fast), "damped oscillator",
               by_mass[i], 2e-5);
  }
  const double beta = 0.004, rate = beta * unit * unit / 2, fast = std::sqrt(unit * unit - rate * rate);
  lossy = properties;
  lossy.damping = lossy.tension_damping = beta;
  const std::vector<double> by_stiffness = decay(lossy, step, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    result.add("its middle with stiffness damping [amplitudes], t = " + std::to_string(t).substr(0, 3) + " s",
               std::exp(-rate * t) * (std::cos(fast * t) + rate * std::sin(fast * t) / fast),
               "damped oscillator", by_stiffness[i], 2e-5);
  }
  return result;
}

// ---- A beam that falls against its mass damping ----

VerifyResult drag_of_mass() {
  VerifyResult result;
  const double alpha = 0.5, t = 2;
  const auto fall = [&](double step) {
    ModelBuilder builder(2, {0, -standard_gravity, 0});
    BeamProperties p(1e6, 10, 2);
    p.mass_damping = alpha;
    add_line(builder, 2, p, 4);
    return run_model(builder.build(), {0, t}, step, 0.9, {{0, 1}});
  };
  const double speed = standard_gravity / alpha * (1 - std::exp(-alpha * t)),
               fallen = standard_gravity / alpha * t - speed / alpha;
  ConvergenceTable table{"place and speed of the fall [m], [m/s]", "steps", {}};
  for (const double step : {0.04, 0.02, 0.01}) {
    const RunRecord run = fall(step);
    const auto& end = run.frames.back().probes.at(0);
    table.rows.emplace_back(
        t / step, std::max(std::abs(end.position.y() + fallen), std::abs(end.velocity.y() + speed)));
  }
  const RunRecord run = fall(1e-3);
  const auto& end = run.frames.back().probes.at(0);
  result.add("speed [m/s], t = 2 s", speed, "linear drag", -end.velocity.y(), 3e-6);
  result.add("fallen [m]", fallen, "linear drag", -end.position.y(), 3e-6);
  result.add(std::move(table), 2, 0.1, "order of the method");
  return result;
}

// ---- A body held on a hanging rope, and where it rests ----

VerifyResult held_body() {
  VerifyResult result;
  const double span = 120, length = 121, EA = 1.5e7, w = 2.5 * standard_gravity,
               weight = 800 * standard_gravity;
  const auto rest = [&](double s, StaticPlace place) {
    ModelBuilder builder(2, {0, -standard_gravity, 0});
    const double drawn = s * span / length;
    const int b = add_line(builder, span, BeamProperties(EA, 1e-9, 2.5).with_free_stretch(length / span), 48);
    builder.pin(b, 0).pin(b, span);
    Rider& joint = builder.slide(builder.add_body("load", 800), b, drawn);
    joint.continuous_slope = false;
    joint.rest = place;
    const double near = 1e-6;
    return at_rest(builder.build(), {{b, drawn - near}, {b, drawn + near}, {b, 0}, {b, span}});
  };
  const auto string_with = [&](double s) {
    HangingString string{length, span, 0, EA, w};
    string.pulls = {{.s = s, .force_z = -weight}};
    return string.solve();
  };
  const std::string source = "boundary-value problem of the string";
  const HangingString::Solution held = string_with(30);
  const Snapshot at = rest(30, StaticPlace::held);
  const Vector3d& body = at.bodies[0].point.position;
  result.add("held body, x [m]", held.pulls[0].x, source, body.x(), 1e-4);
  result.add("held body, z [m]", held.pulls[0].z, source, body.y(), 1e-4);
  result.add("tension before it [N]", held.pulls[0].tension_before, source, at.probes[0].section.axial_force,
             1e-4 * held.horizontal);
  result.add("tension behind it [N]", held.pulls[0].tension_after, source, at.probes[1].section.axial_force,
             1e-4 * held.horizontal);
  result.add("tension at the start [N]", std::hypot(held.horizontal, held.vertical), source,
             at.probes[2].section.axial_force, 1e-4 * held.horizontal);
  const HangingString::Solution middle = string_with(length / 2);
  const Snapshot free = rest(30, StaticPlace::free);
  result.add("free body, s [m]", length / 2, "symmetry", free.bodies[0].s.value() * length / span, 1e-4);
  result.add("free body, z [m]", middle.pulls[0].z, source, free.bodies[0].point.position.y(), 1e-4);
  return result;
}

// ---- A body that falls into a rope ----

VerifyResult rope_that_slackens() {
  VerifyResult result;
  const double m = 10, k = 4000, speed = 1.5, omega = std::sqrt(k / m), sag = m * standard_gravity / k;
  const double taut_time = 2 * (pi - std::atan(speed / omega / sag)) / omega,
               free_time = 2 * speed / standard_gravity;
  const double period = taut_time + free_time;
  const auto exact = [&](double t) {
    const double phase = std::fmod(t, period), free = phase - taut_time;
    if (free < 0) return -sag * (1 - std::cos(omega * phase)) - speed / omega * std::sin(omega * phase);
    return speed * free - standard_gravity * free * free / 2;
  };
  const auto fall = [&](double step, const std::vector<double>& times) {
    ModelBuilder builder(2, {0, -standard_gravity, 0});
    const int b = add_line(builder, 1, BeamProperties(1e6, 10, 2), 2);  // a model has a beam
    builder.clamp(b, 0);
    const int body = builder.add_body("load", m, {0, -1, 0}, {0, -speed, 0});
    builder.connect(Grip::on_body(body), Grip::at_point({0, 0, 0}), ConnectorType::tension_only, k);
    return run_model(builder.build(), times, step);
  };
  const std::vector<double> times = even_times(2 * period, 400);
  const RunRecord run = fall(1e-4, times);
  double largest = 0, pull = 0, drift = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    largest = std::max(largest, std::abs(run.body(i).y() + 1 - exact(times[i])));
    pull = std::max(pull, run.frames[i].connectors[0].force);
    drift = std::max(drift, std::abs(run.frames[i].energy.total - run.frames[0].energy.total));
  }
  result.add("error over two periods [m]", 0, "free fall and oscillator in turn", largest, 1e-6);
  result.add("greatest tension [N]", k * (sag + std::hypot(sag, speed / omega)), "oscillator", pull, 0.05);
  result.add("drift of the energy [J]", 0, "no losses", drift, 1e-4);
  const RunRecord after = fall(1e-4, {0, period});
  result.add("its speed after a period [m/s]", -speed, "periodic",
             after.frames.back().bodies[0].point.velocity.y(), 1e-4);
  return result;
}

// ---- A string on droppers ----

VerifyResult droppers() {
  VerifyResult result;
  const double length = 30, S = 20e3, EA = 1.8e7, mass = 1.35, k = 1e5;
  const std::vector<double> places{7.5, 15, 22.5};
  for (const double lift : {0.0, 150.0, 300.0}) {
    HangingString string{length, length, S, EA, mass * standard_gravity};
    ModelBuilder builder(2, {0, -standard_gravity, 0});
    const int b = add_line(builder, length, taut(EA, 1e-9, mass, S), 40);
    builder.pin(b, 0).pin(b, length);
    for (const double s : places) {
      string.pulls.push_back(
          {.s = s, .force_z = s == 15 ? lift : 0, .stiffness = k, .free_length = 1, .x = s, .z = 1});
      builder.connect(Grip::on_beam(b, s), Grip::at_point({s, 1, 0}), ConnectorType::tension_only, k);
    }
    if (lift > 0) builder.force(b, 15, {0, lift, 0});
    const HangingString::Solution exact = string.solve();
    const Snapshot rest = at_rest(builder.build(), {{b, 15}});
    const std::string with = ", " + std::to_string(static_cast<int>(lift)) + " N up at the middle";
    for (std::size_t i = 0; i < places.size(); ++i)
      result.add("dropper " + std::to_string(i + 1) + " [N]" + with, exact.pulls[i].spring,
                 "boundary-value problem of the string", rest.connectors[i].force, 0.01);
    result.add("middle, z [m]" + with, exact.pulls[1].z, "boundary-value problem of the string",
               rest.probes[0].position.y(), 1e-6);
  }
  return result;
}

// ---- A sprung mass that crosses a bridge ----

struct Bridge {
  double length = 25, E = 2.87e9, I = 2.90, mass = 2303, vehicle = 5750, k = 1595e3, speed = 100 / 3.6;
};

struct AtCrossing {
  double middle, vehicle, acceleration;
};

// Against the beam's own equilibrium, by modes and Runge and Kutta.
std::vector<AtCrossing> crossing_by_modes(const Bridge& of, const std::vector<double>& times) {
  constexpr int modes = 60;
  using State60 = Eigen::Matrix<double, 2 * modes + 2, 1>;
  const double modal = 2 / (of.mass * of.length);
  const auto shape = [&](int n, double x) { return std::sin((n + 1) * pi * x / of.length); };
  const auto sprung = [&](const State60& y, double t) {
    double w = 0;
    for (int n = 0; n < modes; ++n) w += y[n] * shape(n, of.speed * t);
    return -of.k * (y[2 * modes] - w) / of.vehicle;
  };
  const auto rate = [&](double t, const State60& y) {
    State60 f;
    const double a = sprung(y, t), force = -of.vehicle * (standard_gravity + a);
    for (int n = 0; n < modes; ++n) {
      const double omega = std::pow((n + 1) * pi / of.length, 2) * std::sqrt(of.E * of.I / of.mass);
      f[n] = y[modes + n];
      f[modes + n] = modal * force * shape(n, of.speed * t) - omega * omega * y[n];
    }
    f[2 * modes] = y[2 * modes + 1];
    f[2 * modes + 1] = a;
    return f;
  };
  State60 y = State60::Zero();
  double t = 0;
  std::vector<AtCrossing> result;
  for (const double time : times) {
    const int steps = static_cast<int>(std::ceil((time - t) / 2.5e-5));
    const double h = steps > 0 ? (time - t) / steps : 0;
    for (int i = 0; i < steps; ++i, t += h) {
      const State60 k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1),
                    k3 = rate(t + h / 2, y + h / 2 * k2), k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    t = time;
    double middle = 0;
    for (int n = 0; n < modes; ++n) middle += y[n] * shape(n, of.length / 2);
    result.push_back({middle, y[2 * modes], sprung(y, t)});
  }
  return result;
}

VerifyResult bridge() {
  VerifyResult result;
  const Bridge of;
  const std::vector<double> times{0, 0.3711, 0.45};
  ModelBuilder builder(2, {0, -standard_gravity, 0});
  const BeamProperties p(1e9 * of.I, of.E * of.I, of.mass);
  const int b = add_line(builder, of.length, p, 30);
  builder.pin(b, 0).guide(b, of.length, {1, 0, 0});
  const int wheel = builder.add_body("wheel", 1e-3);
  builder.slide(wheel, b, 0).motion = TimeTable{{0, 0}, {of.length / of.speed, of.length}};
  const int vehicle = builder.add_body("vehicle", of.vehicle, {0, 2, 0}, {of.speed, 0, 0});
  Connector& spring =
      builder.connect(Grip::on_body(wheel), Grip::on_body(vehicle), ConnectorType::spring, of.k);
  spring.direction = Vector3d(0, 1, 0);
  spring.length = 2 + of.vehicle * standard_gravity / of.k;
  Connector& along = builder.connect(Grip::on_body(wheel), Grip::on_body(vehicle), ConnectorType::rod);
  along.direction = Vector3d(1, 0, 0);
  along.length = 0;
  // The bridge is level in its own equilibrium: as if its weight were carried.
  BeamModel model = builder.build();
  add_line_load(model, {0, of.mass * standard_gravity, 0});
  const RunRecord run = run_model(model, times, 2e-4, 0.9, {{b, of.length / 2}});
  const std::vector<Snapshot>& frames = run.frames;
  const std::vector<AtCrossing> exact = crossing_by_modes(of, times);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::string when = ", t = " + std::to_string(times[i]).substr(0, 6) + " s";
    result.add("midspan [m]" + when, exact[i].middle, "60 modes, Runge-Kutta",
               frames[i].probes[0].position.y() - frames[0].probes[0].position.y(), 2e-6);
    result.add("vehicle [m]" + when, exact[i].vehicle, "60 modes, Runge-Kutta",
               frames[i].bodies[1].point.position.y() - frames[0].bodies[1].point.position.y(), 2e-6);
  }
  // Its spring's force is what accelerates it.
  const std::vector<double> all_times = even_times(of.length / of.speed - 1e-3, 360);
  const auto order = [](const AtCrossing& one, const AtCrossing& other) {
    return one.acceleration < other.acceleration;
  };
  const std::vector<AtCrossing> along_the_way = crossing_by_modes(of, all_times);
  const auto [least, greatest] = std::minmax_element(along_the_way.begin(), along_the_way.end(), order);
  double lowest = 0, highest = 0;
  for (const Snapshot& frame : run_model(model, all_times, 2e-4, 0.9).frames) {
    const double acceleration = -frame.connectors[0].force / of.vehicle - standard_gravity;
    lowest = std::min(lowest, acceleration);
    highest = std::max(highest, acceleration);
  }
  result.add("vehicle, least acceleration [m/s^2]", least->acceleration, "60 modes, Runge-Kutta", lowest,
             2e-4);
  result.add("vehicle, greatest acceleration [m/s^2]", greatest->acceleration, "60 modes, Runge-Kutta",
             highest, 2e-4);
  return result;
}

}  // namespace

std::vector<VerifyProblem> mechanics_problems() {
  const std::string drawn = "material, Green, as drawn";
  return {{"tension", drawn, tension},
          {"mass-damping", drawn, drag_of_mass},
          {"held-body", "material, Green, straight", held_body},
          {"slack-rope", drawn, rope_that_slackens},
          {"droppers", drawn, droppers},
          {"sprung-mass", drawn, bridge}};
}

}  // namespace nurbeam
