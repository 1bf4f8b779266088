// Supports that turn and clamps that slide, rotational connectors.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "fem/motion/rest/modes.h"
#include "nurbs/number_text.h"
#include "pipelines/run/mode_run.h"
#include "pipelines/run/speed_run.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

/// A straight beam along x from the origin, by its stiffnesses and mass per length.
std::string bar(double length, double EA, double EI, double mass, int elements,
                const std::string& more = "") {
  const double area = 1e-3, E = EA / area;
  return R"("nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [)" +
         text_of(length) + R"(, 0, 0]] }, "section": { "area": )" + text_of(area, 17) +
         R"(, "second_moment": )" + text_of(EI / E, 17) + R"( }, "material": { "youngs_modulus": )" +
         text_of(E, 17) + R"(, "density": )" + text_of(mass / area, 17) + R"( }, "elements": { "count": )" +
         std::to_string(elements) + " }" + more + " }], ";
}

/// A round shaft along x, with torsion.
std::string shaft(double length, double EA, double EI, double GJ, double mass, int elements) {
  const double area = 1e-3, E = EA / area, I = EI / E;
  return R"("nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "bar", "torsion": true, "axis": { "polyline": [[0, 0, 0], [)" +
         text_of(length) + R"(, 0, 0]] }, "section": { "area": )" + text_of(area, 17) +
         R"(, "second_moment": )" + text_of(I, 17) + R"(, "torsion_constant": )" + text_of(2 * I, 17) +
         R"( }, "material": { "youngs_modulus": )" + text_of(E, 17) + R"(, "shear_modulus": )" +
         text_of(GJ / (2 * I), 17) + R"(, "density": )" + text_of(mass / area, 17) +
         R"( }, "elements": { "count": )" + std::to_string(elements) + " } }], ";
}

std::string modes(int count) {
  return R"("analysis": { "type": "modes", "modes": { "count": )" + std::to_string(count) + " } }";
}

ModesReport modes_of(const std::string& text) {
  const CaseFileReport read = read_case_text("{ " + text + " }", "case");
  if (!read.value) throw std::runtime_error(read.diagnostics.front().message);
  const BuildReport built = build_model(*read.value);
  if (!built.value) throw std::runtime_error(built.diagnostics.front().message);
  const ModesOptions options = modes_options(read.value->analysis);
  ModesReport report = find_modes(std::make_shared<const BeamModel>(noted(built.value->model, options)),
                                  options, [] { return false; });
  if (report.rest.failure) throw std::runtime_error("the modes were not found");
  return report;
}

void add_frequencies(VerifyResult& result, const std::string& what, const std::string& text,
                     const std::vector<double>& exact, double tolerance) {
  const ModesReport found = modes_of(text);
  for (std::size_t i = 0; i < exact.size(); ++i)
    result.add(what + ", frequency " + std::to_string(i + 1) + " [Hz]", exact[i], "Euler-Bernoulli",
               found.modes.at(i).omega / (2 * pi), tolerance * exact[i]);
}

// ---- Clamps that turn ----

/// The clamp of a cantilever is turned a little; its vibration is linear.
VerifyResult turned_clamp() {
  constexpr double angle = 0.02, length = 2, end = 1;
  const RunRecord run = run_text(
      "{ " + bar(length, 1.5e8, 150, 1.2, 16) +
      R"("supports": [{ "name": "hub", "beam": "bar", "at": "start", "type": "clamped", "rotation": { "axis": [0, 0, 1], "table": [[0, 0], [0.5, )" +
      text_of(angle * 180 / pi, 17) +
      R"(]] } }], "analysis": { "type": "dynamic", "end_time": 1, "tolerance": 1e-7, "integrator": { "type": "radau" } }, "output": { "every": 0.1, "probes": [{ "name": "tip", "beam": "bar", "at": "end" }] } })");
  const RowCurve law({{0, 0}, {0.5, angle}}, RowJoin::smooth_at_rest);
  VerifyResult result;
  const std::string source = "Euler-Bernoulli by its modes";
  for (const auto& [t, across, moment] : {std::array{0.2, -0.010897299, 1.408174},
                                          {0.4, 0.002022818, -0.340286},
                                          {end, -0.010902463, 1.390679}}) {
    const auto frame = static_cast<std::size_t>(std::lround(t / 0.1));
    const double turned = law.at(t).value;
    const Eigen::Vector3d& tip = run.probe(frame);
    result.add("tip off the line of its clamp at " + text_of(t) + " s [m]", across, source,
               std::cos(turned) * tip.y() - std::sin(turned) * tip.x(), 1e-4 * std::abs(across) + 2e-6);
    const auto& measures = run.frames.at(frame).measures;
    result.add("moment of the drive at " + text_of(t) + " s [N m]", moment, source, measures.at(2).value,
               2e-3);
  }
  result.add("energy that departs [J]", 0, "work of the drive", run.report.energy_drift, 1e-5);
  return result;
}

/// Simo and Vu-Quoc's flexible arm, brought to 6 rad/s within 15 s.
VerifyResult spin_up() {
  constexpr double length = 10, speed = 6, ramp = 15;
  const RunRecord run = run_text(
      "{ " + bar(length, 2.8e7, 1.4e4, 1.2, 16) +
      R"("supports": [{ "name": "hub", "beam": "bar", "at": "start", "type": "clamped", "rotation": { "axis": [0, 0, 1], "speed": )" +
      text_of(speed) + R"(, "ramp": )" + text_of(ramp) +
      R"( } }], "analysis": { "type": "dynamic", "end_time": 18, "tolerance": 1e-6, "integrator": { "type": "radau" } }, "output": { "every": 0.05, "probes": [{ "name": "tip", "beam": "bar", "at": "end" }] } })");
  const AngleMotion law = AngleMotion::at_speed(speed, ramp);
  const auto in_turning_axes = [&](std::size_t frame) {
    const double a = law.at(run.frames.at(frame).time).angle;
    const Eigen::Vector3d& r = run.probe(frame);
    return Eigen::Vector2d(std::cos(a) * r.x() + std::sin(a) * r.y(),
                           std::cos(a) * r.y() - std::sin(a) * r.x());
  };
  VerifyResult result;
  const std::string source = "the elastica without stretch";
  for (const auto& [t, x, y] : {std::array{3., 9.9972709, -0.2172540},
                                {6., 9.9829837, -0.5435399},
                                {9., 9.9880125, -0.4601414},
                                {12., 9.9987302, -0.1508398},
                                {15., 9.9999999, 0.0012748}}) {
    const Eigen::Vector2d tip = in_turning_axes(static_cast<std::size_t>(std::lround(t / 0.05)));
    result.add("tip along the arm at " + text_of(t) + " s [m]", x, source, tip.x(), 1e-3);
    result.add("tip across at " + text_of(t) + " s [m]", y, source, tip.y(), 1e-3);
  }
  double most = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) most = std::min(most, in_turning_axes(i).y());
  result.add("tip across at most [m]", -0.5737507, source, most, 1e-3);
  for (const auto& [t, moment] : {std::pair{3., 110.7283}, {6., 289.9302}, {9., 288.3916}, {12., 108.3063}}) {
    const auto frame = static_cast<std::size_t>(std::lround(t / 0.05));
    result.add("moment of the drive at " + text_of(t) + " s [N m]", moment, source,
               run.frames.at(frame).measures.at(2).value, 1e-3 * 290);
  }
  return result;
}

/// What the arm comes to, in the frame of its hub.
VerifyResult spun_arm() {
  const RunRecord run = run_text(
      "{ " + bar(10, 2.8e7, 1.4e4, 1.2, 16) +
      R"("frame": { "rate": [0, 0, 6] }, "supports": [{ "name": "hub", "beam": "bar", "at": "start", "type": "clamped" }], "analysis": { "type": "static" }, "output": { "probes": [{ "name": "tip", "beam": "bar", "at": "end" }] } })");
  VerifyResult result;
  result.add("stretch of a bar that spins at 6 rad/s [m]", 5.142698462e-4, "its integral, Green's law",
             run.probe(run.frames.size() - 1).x() - 10, 5e-9);
  result.add("pull at the hub [N]", 2160.138852, "its integral", -run.frames.back().reactions.at(0).force.x(),
             1e-3);
  return result;
}

/// Greenhill's rod, twisted by its clamp that turns and slides.
VerifyResult twisted_shaft() {
  constexpr double length = 2, EI = 1, GJ = 0.8;
  VerifyResult result;
  for (const auto& [tension, exact] :
       {std::pair{0., 8.986818916}, {1., 9.134730089}, {10., 10.428856439}, {30., 13.113499753}}) {
    // omega^2 of its lowest vibration, which is 0 where it leaves its line.
    const auto square = [&, tension = tension](double moment) {
      const double degrees = moment * EI / GJ * 180 / pi, pull = tension * EI / (length * length);
      return std::pow(
          modes_of(
              shaft(length, 1e8, EI, GJ, 1, 24) +
              R"("supports": [{ "beam": "bar", "at": "start", "type": "clamped" }, { "beam": "bar", "at": "end", "type": "clamped", "direction": [1, 0, 0], "force": )" +
              text_of(pull, 17) + R"(, "rotation": { "axis": [1, 0, 0], "table": [[0, )" +
              text_of(degrees, 17) + "]] } }], " + modes(1))
              .modes.at(0)
              .omega,
          2);
    };
    // The root of a parabola through three values near it.
    const double a = 0.96 * exact, b = 0.98 * exact, c = 0.995 * exact;
    const double fa = square(a), fb = square(b), fc = square(c);
    const double root = a * fb * fc / ((fa - fb) * (fa - fc)) + b * fa * fc / ((fb - fa) * (fb - fc)) +
                        c * fa * fb / ((fc - fa) * (fc - fb));
    result.add("M L/EI where a rod of T L^2/EI = " + text_of(tension) + " leaves its line", exact,
               "tan x = x, and Greenhill's determinant", root, 1e-4 * exact);
  }
  return result;
}

// ---- Clamps that slide, connectors that turn ----

VerifyResult sliding_clamp() {
  VerifyResult result;
  add_frequencies(
      result, "clamped at both ends, one free across",
      bar(1.5, 1.2e8, 120, 0.8, 24) +
          R"("supports": [{ "beam": "bar", "at": "start", "type": "clamped" }, { "beam": "bar", "at": "end", "type": "clamped", "direction": [0, 1, 0] }], )" +
          modes(3),
      {4.845660860, 26.185552163, 64.661887740}, 1e-4);
  return result;
}

VerifyResult rotational_spring() {
  VerifyResult result;
  const std::string pinned = R"("supports": [{ "beam": "bar", "at": "start", "type": "pinned" })";
  const std::string spring =
      R"(], "connectors": [{ "name": "spring", "type": "rotational", "axis": [0, 0, 1], "from": { "point": [0, 0, 0] }, "to": { "beam": "bar", "at": "start" }, "stiffness": "60 N m/rad" }], )";
  const std::string beam = bar(1.5, 1.2e8, 120, 0.8, 24);
  add_frequencies(result, "on a pin with a spring, the end free", beam + pinned + spring + modes(3),
                  {1.197521792, 13.914624127, 43.902003963}, 1e-4);
  add_frequencies(result, "on a pin with a spring, the end pinned",
                  beam + pinned + R"(, { "beam": "bar", "at": "end", "type": "pinned" })" + spring + modes(3),
                  {9.121289590, 34.811451457, 77.576410116}, 1e-4);
  return result;
}

/// A shaft with a disc, a body that follows the section at its end.
VerifyResult disc_on_a_shaft() {
  VerifyResult result;
  // GJ = 35 N m^2 and 0.004 kg m; so stiff that it bends faster than it twists.
  add_frequencies(
      result, "torsion of a shaft with a disc",
      R"("nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "bar", "torsion": true, "axis": { "polyline": [[0, 0, 0], [0.9, 0, 0]] }, "section": { "area": 1e-3, "second_moment": 1e-6, "torsion_constant": 2e-6 }, "material": { "youngs_modulus": 1e12, "shear_modulus": 1.75e7, "density": 2000 }, "elements": { "count": 16 } }], "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }], "bodies": [{ "name": "disc", "mass": 1e-3, "roll_inertia": 0.03 }], "sliding_joints": [{ "body": "disc", "beam": "bar", "at": "end", "motion": { "speed": 0 }, "follows_section": true }], )" +
          modes(3),
      {5.618115617, 52.591518504, 104.249859264}, 1e-4);
  return result;
}

// ---- Modes of bodies ----

std::string body_modes(const std::string& text, int count) {
  return R"("nurbeam": 1, )" + text + ", " + modes(count);
}

/// A compound pendulum, and a gondola on two hangers, in its plane.
VerifyResult small_swings() {
  VerifyResult result;
  add_frequencies(
      result, "a pendulum on a pin",
      body_modes(
          R"("bodies": [{ "name": "pendulum", "mass": 12, "position": [0, 0, -0.7], "inertia": [1.1, 1.1, 1.1] }], "supports": [{ "body": "pendulum", "at": [0, 0, 0], "type": "pinned", "axis": [0, 1, 0] }])",
          1),
      {1 / 1.828661969}, 1e-8);
  const double z = std::sqrt(4 - 0.36);
  const auto rod = [&](const std::string& name, double x) {
    return R"({ "name": ")" + name + R"(", "type": "rod", "from": { "body": "gondola", "at": [)" +
           text_of(x) + ", 0, " + text_of(-z, 17) + R"(] }, "to": { "point": [)" + text_of(2 * x) +
           ", 0, 0] } }";
  };
  const ModesReport found =
      modes_of(body_modes(R"("bodies": [{ "name": "gondola", "mass": 100, "position": [0, 0, )" +
                              text_of(-z - 0.5, 17) + R"(], "inertia": [14, 20, 16] }], "connectors": [)" +
                              rod("left", -0.6) + ", " + rod("right", 0.6) + "]",
                          4));
  // The one that goes along x.
  const auto along = std::ranges::max_element(
      found.modes, {}, [](const Mode& mode) { return std::abs(mode.participation.x()); });
  result.add("a gondola on two hangers, in its plane [Hz]", 1 / 1.775627628, "Lagrange's equations",
             along->omega / (2 * pi), 1e-8);
  return result;
}

/// A disc at the end of a shaft that spins at 300 rad/s.
VerifyResult rotor() {
  VerifyResult result;
  const auto disc = [](const std::string& more) {
    return shaft(0.6, 1e9, 2000, 1e6, 1.5, 12) +
           R"("supports": [{ "beam": "bar", "at": "start", "type": "clamped" }], "bodies": [{ "name": "disc", "mass": 8, "position": [0.6, 0, 0], "inertia": [0.09, 0.05, 0.05])" +
           more +
           R"( }], "joints": [{ "between": [{ "body": "disc" }, { "beam": "bar", "at": "end" }], "type": "rigid" }], )" +
           modes(4);
  };
  const std::string spins = R"(, "rotor": { "axis": [1, 0, 0], "inertia": 0.09, "speed": 300 })";
  add_frequencies(result, "disc at 300 rad/s, backward and forward", disc(spins),
                  {7.487497650, 10.617806667, 52.033355974, 129.313701257}, 1e-4);
  add_frequencies(result, "disc at rest", disc(""), {9.083658580, 9.083658580, 80.632243978, 80.632243978},
                  1e-4);
  const ModesReport found = modes_of(disc(spins));
  for (std::size_t i = 0; i < 4; ++i)
    result.add("whirl of mode " + std::to_string(i + 1), i % 2 == 0 ? -1 : 1, "the gyroscopic moment",
               found.modes.at(i).whirl, 0.5);
  return result;
}

/// A disc at the end of a light shaft: where it turns at Omega, an imbalance moves it as
///   det(K - Omega^2 diag(m, J - s Jp)) = 0, s = 1 forwards and -1 backwards,
/// with the stiffness K of the shaft's end in displacement and slope.
VerifyResult critical_speeds() {
  constexpr double length = 0.6, EI = 2000, mass = 8, across = 0.09, along = 0.05;
  const CaseFileReport read = read_case_text(
      "{ " + shaft(length, 1e9, EI, 1e6, 1e-5, 8) +
          R"("supports": [{ "beam": "bar", "at": "start", "type": "clamped" }], "bodies": [{ "name": "disc", "mass": )" +
          text_of(mass) + R"(, "position": [0.6, 0, 0], "inertia": [0.05, 0.09, 0.09],
          "rotor": { "axis": [1, 0, 0], "inertia": 0.05, "speed": 1 } }],
          "joints": [{ "between": [{ "body": "disc" }, { "beam": "bar", "at": "end" }], "type": "rigid" }],
          "analysis": { "type": "modes", "modes": { "count": 4, "speeds": [0, 20, 100, 300, 700] } } })",
      "case");
  if (!read.value) throw std::runtime_error(read.diagnostics.front().message);
  const BuildReport built = build_model(*read.value);
  if (!built.value) throw std::runtime_error(built.diagnostics.front().message);
  (void)noted(built.value->model, modes_options(read.value->analysis));
  SimulationReport report;
  Findings findings("case");
  const std::optional<SpeedTable> found = modes_over_speed(
      *read.value, *built.value, [] { return false; }, report, findings);
  if (!found) throw std::runtime_error("the modes were not found");
  const double k = 12 * EI / std::pow(length, 3), c = 6 * EI / (length * length), r = 4 * EI / length;
  VerifyResult result;
  for (const auto& [sign, name] : {std::pair{1, "forward "}, {-1, "backward "}}) {
    const double J = across - sign * along, b = mass * r + J * k;
    const double root = std::sqrt(b * b - 4 * mass * J * (k * r - c * c));
    for (const int number : {1, 2}) {
      const std::string line = name + std::to_string(number);
      const auto there = std::ranges::find(found->critical, line, &CriticalSpeed::line);
      const double exact = std::sqrt((b + (number == 1 ? -root : root)) / (2 * mass * J));
      result.add("critical speed of " + line + " [rad/s]", exact, "massless shaft",
                 there == found->critical.end() ? 0 : there->speed, 1e-5 * exact);
    }
  }
  return result;
}

/// Wilberforce's pendulum about its drawing: a body under a light coil. Beside a body of 1e5 times the mass
/// of that of the reference the coil is light.
VerifyResult wilberforce() {
  constexpr double radius = 0.03, rise = 0.012, wire = 0.002;
  constexpr int turns = 8, count = 40;  // points a turn
  std::string points;
  for (int i = 0; i <= turns * count; ++i) {
    const double a = 2 * pi * i / count;
    points += (i == 0 ? "[" : ", [") + text_of(radius * std::cos(a), 17) + ", " +
              text_of(radius * std::sin(a), 17) + ", " + text_of(-rise * i / count, 17) + "]";
  }
  const double I = pi * std::pow(wire, 4) / 4;
  const std::string end = text_of(-rise * turns, 17);
  std::vector<double> slower = {6.708576945,  7.031338226,  13.607180638,
                                17.005288164, 26.078435243, 35.259140230};
  for (double& frequency : slower) frequency /= std::sqrt(1e5);
  VerifyResult result;
  add_frequencies(
      result, "a body on a coil",
      R"("nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "coil", "torsion": true, "axis": { "through": [)" +
          points + R"(] }, "section": { "area": )" + text_of(pi * wire * wire, 17) +
          R"(, "second_moment": )" + text_of(I, 17) + R"(, "torsion_constant": )" + text_of(2 * I, 17) +
          R"( }, "material": { "youngs_modulus": 2.06e11, "shear_modulus": 7.9e10, "density": 7850 }, "elements": { "count": 320 } }], "supports": [{ "beam": "coil", "at": "start", "type": "clamped" }], "bodies": [{ "name": "bob", "mass": 2e4, "position": [0, 0, )" +
          end + R"(], "inertia": [10, 20, 15] }], "joints": [{ "between": [{ "body": "bob", "at": [)" +
          text_of(radius, 17) + ", 0, " + end +
          R"(] }, { "beam": "coil", "at": "end" }], "type": "rigid" }], )" + modes(6),
      slower, 1e-4);
  return result;
}

// ---- Frames that turn ----

/// An arm that spins, and sees its vibrations from its hub: flap out of the plane, lag in it.
VerifyResult arm_that_spins() {
  VerifyResult result;
  std::string arm = bar(2, 1.5e8, 150, 1.2, 24, R"(, "torsion": false)");
  arm.replace(arm.find("[0, 0, 0]"), 9, "[0, 0, 1e-9]");  // in space
  add_frequencies(
      result, "arm at 40 rad/s, lag and flap",
      arm +
          R"("frame": { "rate": [0, 0, 40] }, "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }], )" +
          modes(4),
      {2.599175230, 6.876349710, 17.779516500, 18.884906160}, 1e-4);
  return result;
}

/// A round shaft that spins, seen from itself.
VerifyResult shaft_that_spins() {
  VerifyResult result;
  add_frequencies(
      result, "shaft at 300 rad/s, backward and forward",
      bar(0.6, 2e9, 2000, 1.5, 24, R"(, "torsion": false)") +
          R"("frame": { "rate": [300, 0, 0] }, "supports": [{ "beam": "bar", "at": "start", "type": "pinned" }, { "beam": "bar", "at": "end", "type": "pinned" }], )" +
          modes(2),
      {111.579551, 207.072517}, 1e-4);
  return result;
}

}  // namespace

std::vector<VerifyProblem> turning_problems() {
  const std::string measures = "material, Green, as drawn";
  return {{"bodies-T1", measures, turned_clamp},
          {"bodies-T2", measures, spin_up},
          {"bodies-T3", measures, spun_arm},
          {"bodies-T4", measures + ", torsion", twisted_shaft},
          {"bodies-T7", measures, sliding_clamp},
          {"bodies-B6", measures, rotational_spring},
          {"bodies-B3", measures + ", torsion", disc_on_a_shaft},
          {"bodies-R4", "rigid bodies", small_swings},
          {"bodies-B5", measures + ", torsion", rotor},
          {"critical-speeds", measures + ", torsion", critical_speeds},
          {"bodies-B7", measures + ", torsion", wilberforce},
          {"bodies-T5", measures, arm_that_spins},
          {"bodies-T6", measures, shaft_that_spins}};
}

}  // namespace nurbeam
