// Ropes that drums and spools pay out, on the ground, on a free body and in orbit, against the equations of
// their machines.

#include <cmath>
#include <numbers>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
constexpr double earth = 9.81;

// The solution of y' = f(t, y) at a time, by the classical method of Runge and Kutta in many steps.
template <class F>
Eigen::VectorXd integrated(const F& f, Eigen::VectorXd y, double end) {
  constexpr int steps = 20000;
  const double h = end / steps;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const Eigen::VectorXd a = f(t, y), b = f(t + h / 2, y + h / 2 * a), c = f(t + h / 2, y + h / 2 * b),
                          d = f(t + h, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

// A rope from the origin to `end`, of `mass` kg/m and EA in N, with what else a case has. A body of `load` kg
// is fastened to its end.
struct RopeOnReel {
  Eigen::Vector3d end;
  double mass, EA, load;
  std::string reel, more = {};
  double along = 0;  // [m/s]
  double element, end_time, step, every;
  bool from_equilibrium = false;

  std::string text() const {
    constexpr double area = 1e-4;
    return R"({ "nurbeam": 1, "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [)" +
           text_of(end.x()) + ", " + text_of(end.y()) + ", " + text_of(end.z()) +
           R"(]] }, "stress_free": "straight", "section": { "area": 1e-4, "second_moment": 1e-18 },
      "material": { "density": )" +
           text_of(mass / area) + R"(, "youngs_modulus": )" + text_of(EA / area) +
           R"(, "damping": 1e-4 }, "elements": { "max_length": )" + text_of(element) +
           R"( }, "initial": { "velocity": { "along": )" + text_of(along) + R"( } } }],
      "bodies": [{ "name": "load", "mass": )" +
           text_of(load) + R"(, "fastened": { "beam": "rope", "at": "end" } })" +
           (more.empty() ? "]" : more) + R"(, "reels": [{ "name": "reel", "beam": "rope", "end": "start", )" +
           reel + R"( }], "analysis": { "initial": ")" + (from_equilibrium ? "equilibrium" : "as-drawn") +
           R"(", "end_time": )" + text_of(end_time) + R"(, "step": )" + text_of(step) +
           R"( }, "output": { "every": )" + text_of(every) + " } }";
  }
};

// What a run of one reel measures of it.
double measured(const RunRecord& run, std::size_t frame, AtRing::Quantity quantity) {
  std::size_t i = 0;
  for (const RingQuantity& of : ring_quantities) {
    if (!of_reel(of.quantity)) continue;
    if (of.quantity == quantity) break;
    ++i;
  }
  return run.frames.at(frame).measures.at(i).value;
}

/// A winch hoists 300 kg on 40 m of rope of 2.5 kg/m: (m + rho L + J) v' = F - c v - (m + rho l) g, for the
/// length l that hangs of L in all, with the force 5200 N - 900 v of its motor and 120 kg of its drum.
VerifyResult reel_winch() {
  constexpr double m = 300, rho = 2.5, hangs = 40, stored = 20, J = 120, F = 5200, c = 900;
  const auto f = [](double, const Eigen::VectorXd& y) {
    const double a = (F - c * y[1] - (m + rho * y[0]) * earth) / (m + rho * (hangs + stored) + J);
    return Eigen::VectorXd(Eigen::Vector2d(-y[1], a));
  };
  const RunRecord run = run_text(
      RopeOnReel{.end = {0, 0, -hangs},
                 .mass = rho,
                 .EA = 2e10,
                 .load = m,
                 .reel = R"("stored": 20, "inertia": 120, "force": 5200, "friction": { "viscous": 900 })",
                 .element = 2,
                 .end_time = 6,
                 .step = 2e-3,
                 .every = 3,
                 .from_equilibrium = true}
          .text());
  VerifyResult result;
  for (const std::size_t i : {1U, 2U}) {
    const double t = run.frames.at(i).time;
    const Eigen::VectorXd y = integrated(f, Eigen::Vector2d(hangs, 0), t);
    result.add("raised in " + text_of(t) + " s [m]", hangs - y[0], "Newton's law",
               run.body(i).z() - run.body(0).z(), 1e-4 * (hangs - y[0]));
    const double tension = (m + rho * y[0]) * (earth + f(t, y)[1]);
    result.add("tension at the drum after " + text_of(t) + " s [N]", tension, "Newton's law",
               measured(run, i, AtRing::Quantity::axial_force), 1e-4 * tension);
  }
  result.add("energy lost from nowhere [J]", 0, "balance of energy",
             run.frames.at(2).energy.total - run.frames.at(0).energy.total, 1e-3);
  return result;
}

/// Rope of 2 kg/m is paid out at a steady 8 m/s with 50 kg at its end: its tension is the weight, and the
/// drum bears rho v^2 less.
VerifyResult steady_drum() {
  constexpr double rho = 2, v = 8, m = 50, first = 12;
  const RunRecord run = run_text(RopeOnReel{.end = {0, 0, -first},
                                            .mass = rho,
                                            .EA = 2e8,
                                            .load = m,
                                            .reel = R"("stored": 10, "motion": { "speed": 8 })",
                                            .along = v,
                                            .element = 1,
                                            .end_time = 1,
                                            .step = 1e-3,
                                            .every = 1}
                                     .text());
  VerifyResult result;
  const double tension = (m + rho * (first + v)) * earth;
  result.add("tension where it leaves the drum [N]", tension, "weight",
             measured(run, 1, AtRing::Quantity::axial_force), 1e-3 * tension);
  result.add("force on the drum, downwards [N]", tension - rho * v * v, "balance of momentum",
             -run.frames.at(1).bodies.at(1).joint_force.z(), 1e-3 * tension);
  return result;
}

/// 4 kg fall on a rope of 1.5 kg/m that is drawn from rest: (m + rho l) v' = (m + rho l) g - iota rho v^2.
VerifyResult spool() {
  constexpr double m = 4, rho = 1.5, out = 1, end = 1.5;
  VerifyResult result;
  for (const double iota : {0.5, 1.0, 2.5}) {
    const RunRecord run =
        run_text(RopeOnReel{.end = {0, 0, -out},
                            .mass = rho,
                            .EA = 2e7,
                            .load = m,
                            .reel = R"("stored": 20, "feed": "spool", "pickup": )" + text_of(iota),
                            .element = 0.25,
                            .end_time = end,
                            .step = 1e-3,
                            .every = end}
                     .text());
    const Eigen::VectorXd y = integrated(
        [&](double, const Eigen::VectorXd& x) {
          return Eigen::VectorXd(Eigen::Vector2d(x[1], g - iota * rho * x[1] * x[1] / (m + rho * x[0])));
        },
        Eigen::Vector2d(out, 0), end);
    result.add("rope out after 1.5 s with a pickup of " + text_of(iota) + " [m]", y[0], "Newton's law",
               measured(run, 1, AtRing::Quantity::out), 1e-4 * y[0]);
  }
  return result;
}

/// A pendulum of 100 kg on a light rope whose length grows or shrinks evenly: l th'' + 2 l' th' + g sin th =
/// 0.
VerifyResult reel_pendulum() {
  VerifyResult result;
  const auto swing = [&](double length, double rate, double degrees, double stored, double time) {
    const double first = degrees * std::numbers::pi / 180;
    const RunRecord run = run_text(RopeOnReel{
        .end = length * Eigen::Vector3d(std::sin(first), 0, -std::cos(first)),
        .mass = 1e-5,
        .EA = 2e8,
        .load = 100,
        .reel = R"("stored": )" + text_of(stored) + R"(, "motion": { "speed": )" + text_of(rate) + " }",
        .along = rate,
        .element = 1,
        .end_time = time,
        .step = 1e-3,
        .every = time}
                                       .text());
    const Eigen::VectorXd y = integrated(
        [&](double t, const Eigen::VectorXd& x) {
          const double l = length + rate * t;
          return Eigen::VectorXd(Eigen::Vector2d(x[1], -(2 * rate * x[1] + earth * std::sin(x[0])) / l));
        },
        Eigen::Vector2d(first, 0), time);
    const double there = std::atan2(run.body(1).x(), -run.body(1).z());
    result.add("angle at " + text_of(time) + " s, " + text_of(rate) + " m/s [degrees]",
               y[0] * 180 / std::numbers::pi, "equation of motion", there * 180 / std::numbers::pi, 5e-3);
  };
  swing(3, 0.6, 30, 10, 5);
  swing(7, -0.5, 6, 1, 8);
  return result;
}

/// A drum of 3 kg on a free body of 50 kg pays out 1.5 kg/m at 4 m/s at first, with 5 kg at the end.
VerifyResult free_carrier() {
  constexpr double M = 50, m = 5, rho = 1.5, J = 3, L = 40, first = 10, v = 4, end = 4;
  const RunRecord run =
      run_text(RopeOnReel{.end = {first, 0, 0},
                          .mass = rho,
                          .EA = 2e6,
                          .load = m,
                          .reel = R"("stored": 30, "inertia": 3, "on": "carrier")",
                          .more = R"(, { "name": "carrier", "mass": 50, "position": [0, 0, 0] }],
                                                       "gravity": [0, 0, 0])",
                          .along = v,
                          .element = 0.5,
                          .end_time = end,
                          .step = 1e-3,
                          .every = end}
                   .text());
  // Of the carrier X, and the length l that is out: all rope out moves at u + w, what is stored at u, with w
  // = l'.
  const auto f = [](double, const Eigen::VectorXd& y) {
    const double l = y[1], u = y[2], w = y[3], stored = L - l;
    Eigen::Matrix2d A;
    A << M + rho * stored + m + rho * l, m + rho * l, m + rho * l, rho * stored + J + m + rho * l;
    const Eigen::Vector2d change(rho * w * w, rho * w * u),
        by_length(0, -rho * u * u / 2 - rho * w * w / 2 + rho * (u + w) * (u + w) / 2);
    Eigen::VectorXd rates(4);
    rates << u, w, A.lu().solve(by_length - change);
    return rates;
  };
  const Eigen::VectorXd y = integrated(f, Eigen::Vector4d(0, first, 0, v), end);
  VerifyResult result;
  result.add("way of the carrier in 4 s [m]", y[0], "Lagrange's equations",
             run.frames.at(1).bodies.at(1).point.position.x(), 1e-4 * std::abs(y[0]));
  result.add("rope out after 4 s [m]", y[1], "Lagrange's equations", measured(run, 1, AtRing::Quantity::out),
             1e-4 * y[1]);
  return result;
}

/// What flies freely in a frame on a circular orbit, by Hill's equations.
VerifyResult hill_flight() {
  constexpr double n = 2 * std::numbers::pi / 5400, x = 10, u = 0.1, t = 1000;
  const RunRecord run = run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "frame": { "rate": [0, 0, )" +
                                 text_of(n) +
                                 R"(], "gravity_gradient": { "radial": [1, 0, 0] } },
    "beams": [{ "name": "stick", "axis": { "polyline": [[10, -0.5, 0], [10, 0.5, 0]] },
      "section": { "area": 1e-4, "second_moment": 1e-9 }, "material": { "density": 1000, "youngs_modulus": 1e9 },
      "elements": { "count": 2 }, "initial": { "velocity": { "translation": [0.1, 0, 0] } } }],
    "analysis": { "initial": "as-drawn", "end_time": 1000, "step": 1 },
    "output": { "every": 1000, "probes": [{ "name": "middle", "beam": "stick", "at": { "fraction": 0.5 } }] } })");
  const double c = std::cos(n * t), s = std::sin(n * t);
  const Eigen::Vector3d at = run.frames.at(1).probes.at(0).position;
  VerifyResult result;
  result.add("x after 1000 s [m]", (4 - 3 * c) * x + s / n * u, "Hill's equations", at.x(), 1e-3);
  result.add("y after 1000 s [m]", 6 * (s - n * t) * x - 2 / n * (1 - c) * u, "Hill's equations", at.y(),
             1e-3);
  return result;
}

/// A light tether is paid out from a satellite on a circular orbit, at 1 m/s from 200 m on the local
/// vertical: l th'' + 2 l' (th' + n) + 3 n^2 l sin th cos th = 0.
VerifyResult tether() {
  constexpr double n = 2 * std::numbers::pi / 5400, length = 200, rate = 1, end = 1500;
  const RunRecord run =
      run_text(RopeOnReel{.end = {length, 0, 0},
                          .mass = 1e-5,
                          .EA = 2e4,
                          .load = 50,
                          .reel = R"("stored": 3000, "motion": { "speed": 1 })",
                          .more = R"(], "gravity": [0, 0, 0], "frame": { "rate": [0, 0, )" + text_of(n) +
                                  R"(], "gravity_gradient": { "radial": [1, 0, 0] } })",
                          .along = rate,
                          .element = 100,
                          .end_time = end,
                          .step = 0.5,
                          .every = 500}
                   .text());
  const auto f = [](double t, const Eigen::VectorXd& y) {
    const double l = length + rate * t;
    return Eigen::VectorXd(
        Eigen::Vector2d(y[1], -2 * rate / l * (y[1] + n) - 3 * n * n * std::sin(y[0]) * std::cos(y[0])));
  };
  VerifyResult result;
  for (const std::size_t i : {1U, 3U}) {
    const double t = run.frames.at(i).time;
    const Eigen::VectorXd y = integrated(f, Eigen::Vector2d::Zero(), t);
    const double there = std::atan2(run.body(i).y(), run.body(i).x());
    result.add("angle after " + text_of(t) + " s [degrees]", y[0] * 180 / std::numbers::pi,
               "equation of motion", there * 180 / std::numbers::pi, 5e-3);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> reel_problems() {
  return {{"reel-winch", "material, Green, straight", reel_winch},
          {"reel-steady", "material, Green, straight", steady_drum},
          {"reel-spool", "material, Green, straight", spool},
          {"reel-pendulum", "material, Green, straight", reel_pendulum},
          {"reel-free-carrier", "material, Green, straight", free_carrier},
          {"frame-free-flight", "material, Green, straight", hill_flight},
          {"frame-tether", "material, Green, straight", tether}};
}

}  // namespace nurbeam
