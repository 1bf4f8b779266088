// Bodies that slide against friction, the air and stops.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_run.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

constexpr double g_of_earth = 9.81;

/// A body on a rigid guide in a vertical plane.
BeamModel on_guide(const std::vector<RationalCubic>& axis, double mass, double speed = 0, double at = 0) {
  ModelBuilder builder(2, {0, -g_of_earth, 0});
  builder.add_guide(ReferenceCurve(axis, 2));
  builder.slide(builder.add_body("body", mass), 0, at, speed);
  return builder.build();
}

std::vector<RationalCubic> slope_down(double degrees, double length) {
  const double angle = degrees * pi / 180;
  return {line_cubic({0, 0, 0}, {length * std::cos(angle), -length * std::sin(angle), 0})};
}

double speed_in(const RunRecord& run, std::size_t i) {
  return run.frames.at(i).bodies.at(0).point.velocity.norm();
}

double first_time(const RunRecord& run, EventKind kind, std::size_t number = 0) {
  for (const RunEvent& event : run.report.events)
    if (event.kind == kind && number-- == 0) return event.time;
  return std::nan("");
}

double largest_drift(const RunRecord& run) {
  double most = 0;
  for (const Snapshot& frame : run.frames)
    most = std::max(most, std::abs(frame.energy.total - run.frames.front().energy.total));
  return most;
}

VerifyResult friction_on_a_slope() {
  VerifyResult result;
  BeamModel model = on_guide(slope_down(30, 40), 5);
  model.riders[0].friction = Friction{.coefficient = 0.2};
  const double a = g_of_earth * (0.5 - 0.2 * std::sqrt(0.75)), time = std::sqrt(20 / a);
  const RunRecord run = run_model(model, {0, time}, 0.01);
  result.add("mu = 0.2: place at t = 2.497715 s [m]", 10, "g (sin - mu cos) t^2/2", run.place(1), 1e-5);
  result.add("speed there [m/s]", a * time, "g (sin - mu cos) t", speed_in(run, 1), 1e-5);
  result.add("energy lost [J]", 0.2 * 5 * g_of_earth * std::sqrt(0.75) * 10, "mu m g cos s",
             run.frames[1].energy.dissipated, 1e-4);
  model.riders[0].friction->coefficient = 0.6;
  model.riders[0].s = 1;
  result.add("mu = 0.6: creep in 100 s [m]", 0, "it sticks", run_model(model, {0, 100}, 0.05).place(1) - 1,
             1e-12);
  return result;
}

/// d(phi, v)/dt of a body that slides down and up a circle, by Runge-Kutta with steps that end at v = 0.
struct SwingWithFriction {
  double R, mu, phi = 0, v = 0, t = 0;

  std::array<double, 2> rates(double at, double speed) const {
    const double normal = g_of_earth * std::sin(at) + speed * speed / R;
    return {speed / R, g_of_earth * std::cos(at) - mu * std::abs(normal)};
  }
  void step(double h) {
    const auto k1 = rates(phi, v), k2 = rates(phi + h / 2 * k1[0], v + h / 2 * k1[1]),
               k3 = rates(phi + h / 2 * k2[0], v + h / 2 * k2[1]), k4 = rates(phi + h * k3[0], v + h * k3[1]);
    phi += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]);
    v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]);
    t += h;
  }
  // To where f(*this), which grows, is 0.
  template <class F>
  void run_to(const F& f) {
    for (double h = 1e-4; h > 1e-14;) {
      SwingWithFriction next = *this;
      next.step(h);
      if (f(next) > 0)
        h /= 2;
      else
        *this = next;
    }
  }
};

VerifyResult friction_on_a_circle() {
  VerifyResult result;
  const double R = 3;
  BeamModel model = on_guide(arc_cubics({0, 0, 0}, R, pi, 2 * pi, 4), 5);
  model.riders[0].friction = Friction{.coefficient = 0.25};
  SwingWithFriction bottom{R, 0.25};
  bottom.run_to([](const SwingWithFriction& x) { return x.phi - pi / 2; });
  SwingWithFriction rest = bottom;
  rest.run_to([](const SwingWithFriction& x) { return -x.v; });
  ConvergenceTable table{"the place at the bottom's time [m]", "steps per second", {}};
  RunRecord run;
  for (const int steps : {250, 500, 1000}) {
    run = run_model(model, {0, bottom.t, 1.95}, 1.0 / steps);
    table.rows.emplace_back(steps, std::abs(run.place(1) - R * pi / 2));
  }
  const std::string source = "Runge-Kutta in the angle";
  result.add("mu = 0.25: place at t = 1.165316 s [m]", R * pi / 2, source, run.place(1), 3e-5);
  result.add("speed there [m/s]", bottom.v, source, speed_in(run, 1), 3e-5);
  result.add("time of the first rest [s]", rest.t, source, first_time(run, EventKind::slides), 2e-5);
  result.add("angle of the first rest [rad]", rest.phi, source,
             run.report.events.empty() ? std::nan("") : *run.report.events.front().s / R, 2e-5);
  result.add("drift of the total energy with its losses [J]", 0, "it is constant", largest_drift(run), 1e-3);
  result.add(std::move(table), 2, 0.1, "second order");
  return result;
}

VerifyResult drag_down_a_slope() {
  VerifyResult result;
  BeamModel model = on_guide(slope_down(12, 400), 90);
  model.riders[0].friction = Friction{.coefficient = 0.02};
  model.air.density = 1.225;
  model.bodies[0].drag_area = 0.8;
  const double alpha = 12 * pi / 180, k = 1.225 * 0.8 / (2 * 90);
  const double a = g_of_earth * (std::sin(alpha) - 0.02 * std::cos(alpha)), limit = std::sqrt(a / k);
  const double v = limit * std::sqrt(1 - std::exp(-2 * k * 300)), time = limit / a * std::atanh(v / limit);
  const RunRecord run = run_model(model, {0, time}, 0.01);
  result.add("place at t = 23.099223 s [m]", 300, "log cosh", run.place(1), 3e-3);
  result.add("speed there [m/s]", v, "tanh", speed_in(run, 1), 2e-4);
  result.add("drift of the total energy with its losses [J]", 0, "it is constant", largest_drift(run), 1e-2);
  return result;
}

VerifyResult hard_stop() {
  VerifyResult result;
  const double a = g_of_earth / 2, v = std::sqrt(4 * a), t = v / a;
  BeamModel model = on_guide(slope_down(30, 20), 5);
  model.stops.push_back({.rider = 0, .place = 2, .restitution = 0.6});
  const RunRecord run = run_model(model, {0, t + 0.6 * t, 4}, 2e-4);
  result.add("first impact [s]", t, "sqrt(2s/a)", first_time(run, EventKind::hits_stop), 1e-6);
  result.add("second impact [s]", 2.2 * t, "(1 + 2e) t1", first_time(run, EventKind::hits_stop, 1), 1e-6);
  result.add("third impact [s]", 2.92 * t, "(1 + 2e + 2e^2) t1", first_time(run, EventKind::hits_stop, 2),
             1e-6);
  result.add("rebound [m]", 0.72, "e^2 s", 2 - run.place(1), 1e-6);
  result.add("at rest [s]", 4 * t, "(1 + e)/(1 - e) t1", first_time(run, EventKind::rests_at_stop), 3e-5);

  model.riders[0].friction = Friction{.coefficient = 0.1};
  const double c = std::sqrt(0.75), down = g_of_earth * (0.5 - 0.1 * c), up = g_of_earth * (0.5 + 0.1 * c);
  const double v1 = std::sqrt(4 * down), t1 = v1 / down, u1 = 0.6 * v1, v2 = u1 * std::sqrt(down / up),
               t2 = t1 + u1 / up + v2 / down;
  const double rest = t1 + (u1 / up + v2 / down) / (1 - v2 / v1);
  const RunRecord rubbing = run_model(model, {0, 4}, 2e-4);
  result.add("with mu = 0.1: first impact [s]", t1, "sqrt(2s/a)", first_time(rubbing, EventKind::hits_stop),
             1e-5);
  result.add("second impact [s]", t2, "v/a up and down", first_time(rubbing, EventKind::hits_stop, 1), 1e-5);
  result.add("at rest [s]", rest, "the sum of all", first_time(rubbing, EventKind::rests_at_stop), 3e-5);
  return result;
}

// A damper for which steps of 10 ms are long, c h/m = 5: x = v (exp(-p t) - exp(-q t))/(q - p) until
// x'' = 0, p and q the roots of m q^2 - c q + k.
void add_stiff_damper(VerifyResult& result) {
  const double m = 80, k = 2e4, c = 4e4, v = 3, b = c / (2 * m), q = b + std::sqrt(b * b - k / m),
               p = k / m / q;
  BeamModel model = on_guide({line_cubic({0, 0, 0}, {20, 0, 0})}, m, v, 1);
  model.stops.push_back({.rider = 0, .place = 4, .buffer = Buffer{k, c}});
  const double deepest = std::log(q / p) / (q - p), away = 2 * deepest;
  const RunRecord run = run_model(model, {0, 1 + deepest, 1.5}, 0.01);
  result.add("pressed in at 0.0138 s, c h/m = 5 [m]",
             v * (std::exp(-p * deepest) - std::exp(-q * deepest)) / (q - p), "overdamped oscillation",
             run.place(1) - 4, 3e-5);
  result.add("speed away, c h/m = 5 [m/s]", v * (p * std::exp(-p * away) - q * std::exp(-q * away)) / (q - p),
             "overdamped oscillation", speed_in(run, 2), 1e-4);
  result.add("drift of the total energy with its losses, c h/m = 5 [J]", 0, "it is constant",
             largest_drift(run), 2e-2);
}

VerifyResult buffer() {
  VerifyResult result;
  const double m = 80, k = 2e4, c = 800, v = 3, b = c / (2 * m), w = std::sqrt(k / m - b * b);
  BeamModel model = on_guide({line_cubic({0, 0, 0}, {20, 0, 0})}, m, v, 1);
  model.stops.push_back({.rider = 0, .place = 4, .buffer = Buffer{k, c}});
  const double deepest = std::atan2(w, b) / w;
  // The force k x + c dx/dt = v exp(-b t) (c cos(w t) + (k - b c)/w sin(w t)) ends at the first root.
  const double away = (pi - std::atan2(c, (k - b * c) / w)) / w;
  const double back = v * std::exp(-b * away) * (std::cos(w * away) - b / w * std::sin(w * away));
  const RunRecord run = run_model(model, {0, 1 + deepest, 1.5}, 2.5e-4);
  result.add("pressed in at 0.0832697 s [m]", v / w * std::exp(-b * deepest) * std::sin(w * deepest),
             "damped oscillation", run.place(1) - 4, 1e-6);
  result.add("away after [s]", away, "damped oscillation", first_time(run, EventKind::leaves_stop) - 1, 1e-6);
  result.add("speed away [m/s]", -back, "damped oscillation", speed_in(run, 2), 1e-5);
  result.add("drift of the total energy with its losses [J]", 0, "it is constant", largest_drift(run), 1e-2);
  add_stiff_damper(result);
  return result;
}

/// A body at rest on a hanging rope, at the end of its slide: the tensions on both sides of it and the angle
/// between them, from the reactions and the rope's own weight.
struct Kink {
  double T1, T2, theta;

  Kink(const Snapshot& frame, double weight_per_s, double length) {
    const double s = frame.bodies.at(0).s.value(), H = std::abs(frame.reactions.at(0).force.x());
    const double V1 = frame.reactions.at(0).force.y() - weight_per_s * s,
                 V2 = frame.reactions.at(1).force.y() - weight_per_s * (length - s);
    T1 = std::hypot(H, V1);
    T2 = std::hypot(H, V2);
    theta = std::atan2(V1, H) + std::atan2(V2, H);
  }
};

VerifyResult friction_at_a_kink() {
  VerifyResult result;
  const double X = 20, stretch = 1.05, mu = 0.15;
  for (const auto law : {Friction::Law::capstan, Friction::Law::coulomb}) {
    ModelBuilder builder(2, {0, -g_of_earth, 0});
    const BeamProperties rope = BeamProperties(3e6, 12, 0.25).with_free_stretch(stretch);
    builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {X, 0, 0})}, 2).straightened(), rope, {24});
    builder.pin(0, 0).pin(0, X);
    Rider& joint = builder.slide(builder.add_body("body", 60), 0, 4);
    joint.continuous_slope = false;
    joint.friction = Friction{.coefficient = mu, .law = law};
    SimulationOptions options;
    options.statics = true;
    std::vector<Snapshot> frames;
    SimulationObserver observer;
    observer.snapshot = [&](const Snapshot& frame) { frames.push_back(frame); };
    const SimulationReport report =
        simulate(noted(builder.build(), options), {}, at_problem_level(options), observer);
    if (report.status != SimulationStatus::done) throw std::runtime_error("no state at rest");
    const Kink kink(frames.at(0), rope.mass_per_length * g_of_earth, X);
    if (law == Friction::Law::capstan)
      result.add("log(T1/T2) over the angle", mu, "the capstan", std::log(kink.T1 / kink.T2) / kink.theta,
                 1e-4);
    else
      result.add("(T1 - T2)/(T1 + T2) over tan(theta/2)", mu, "Coulomb across the bisector",
                 (kink.T1 - kink.T2) / (kink.T1 + kink.T2) / std::tan(kink.theta / 2), 1e-4);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> resistance_problems() {
  const std::string rigid = "rigid guide";
  return {{"friction-slope", rigid, friction_on_a_slope},
          {"friction-circle", rigid, friction_on_a_circle},
          {"friction-drag", rigid, drag_down_a_slope},
          {"friction-kink", "material, Green, straight", friction_at_a_kink},
          {"stop-hard", rigid, hard_stop},
          {"stop-buffer", rigid, buffer}};
}

}  // namespace nurbeam
