// Ropes that run over pulleys, against the closed forms of their machines.

#include <cmath>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
constexpr double g = 9.81, EA = 2e7;

// A rope through `points`, straight when free, of `mass` kg/m, with what else a case has.
std::string rope_case(const std::string& points, double mass, const std::string& more, double end_time) {
  constexpr double area = 1e-4;
  return R"({ "nurbeam": 1, "beams": [{ "name": "rope", "axis": { "polyline": [)" + points +
         R"(] }, "stress_free": "straight", "section": { "area": 1e-4, "second_moment": 1e-18 },
      "material": { "density": )" +
         text_of(mass / area) + R"(, "youngs_modulus": )" + text_of(EA / area) +
         R"(, "stiffness_damping": 1e-3 }, "elements": { "max_length": 0.25 } }], )" + more +
         R"(, "analysis": { "initial": "equilibrium", "end_time": )" + text_of(end_time) +
         R"(, "step": 1e-3 }, "output": { "every": 0.5 } })";
}

std::string weight_at(const std::string& name, double mass, const std::string& end) {
  return R"({ "name": ")" + name + R"(", "mass": )" + text_of(mass) +
         R"(, "fastened": { "beam": "rope", "at": ")" + end + R"(" } })";
}

/// Atwood's machine with a heavy rope and pulleys that turn: the heavier side falls by
/// (dM/2 rho)(cosh w t - 1), w^2 = 2 rho g/(sum of all masses).
VerifyResult atwood() {
  constexpr double rho = 2, side = 5, between = 0.1, heavy = 8, light = 6;
  VerifyResult result;
  for (const double inertia : {0.0, 2.0}) {
    const auto pulley = [&](const char* name, double s) {
      return std::string(R"({ "name": ")") + name + R"(", "beam": "rope", "at": { "length": )" + text_of(s) +
             R"( }, "inertia": )" + text_of(inertia) + " }";
    };
    const RunRecord run = run_text(rope_case(
        "[0, 0, -5], [0, 0, 0], [0.1, 0, 0], [0.1, 0, -5]", rho,
        R"("bodies": [)" + weight_at("heavy", heavy, "end") + ", " + weight_at("light", light, "start") +
            R"(], "eyelets": [)" + pulley("left", side) + ", " + pulley("right", side + between) + "]",
        1.5));
    const double masses = heavy + light + rho * (2 * side + between) + 2 * inertia,
                 rate = std::sqrt(2 * rho * g / masses);
    for (const std::size_t i : {1U, 2U, 3U}) {
      const double t = run.frames.at(i).time, fall = (heavy - light) / (2 * rho) * (std::cosh(rate * t) - 1);
      result.add("fall of the heavier side at " + text_of(t) + " s with pulleys of " + text_of(2 * inertia) +
                     " kg [m]",
                 fall, "cosh of time", run.body(0).z() - run.body(i).z(), 1e-4 * fall);
    }
  }
  return result;
}

/// A pulley of 12 kg hangs in a light rope between a ceiling and an eyelet, beyond which 8 kg hang: these
/// fall at g (8 - 6)/(8 + 12/4 + J/4 + J'), with the inertias J of the pulley and J' of the eyelet.
VerifyResult movable_pulley() {
  constexpr double weight = 8, pulley = 12;
  VerifyResult result;
  for (const double turns : {0.0, 1.0}) {
    const double J = 2 * turns, J_top = 3 * turns;
    const RunRecord run = run_text(rope_case(
        "[0, 0, 0], [0.01, 0, -6], [0.02, 0, 0], [0.02, 0, -5]", 1e-5,
        R"("bodies": [)" + weight_at("weight", weight, "end") + R"(, { "name": "pulley", "mass": 12 }],
        "supports": [{ "beam": "rope", "at": "start", "type": "pinned" }],
        "eyelets": [{ "name": "block", "beam": "rope", "at": { "near": [0.01, 0, -6] }, "on": "pulley", "inertia": )" +
            text_of(J) +
            R"( }, { "name": "top", "beam": "rope", "at": { "near": [0.02, 0, 0] }, "inertia": )" +
            text_of(J_top) + " }]",
        0.5));
    const double a = g * (weight - pulley / 2) / (weight + pulley / 4 + J / 4 + J_top), fall = a * 0.25 / 2;
    result.add("fall of the weight with inertias of " + text_of(J + J_top) + " kg [m]", fall,
               "constant acceleration", run.body(0).z() - run.body(1).z(), 1e-4 * fall);
  }
  return result;
}

/// A winch lowers 10 kg by t^2/2 while 50 N hold the light rope's tail: it bears 50 N - m (g - a).
VerifyResult winch() {
  constexpr double weight = 10, tail = 50, a = 1;
  const RunRecord run = run_text(rope_case(
      "[0, 0, -5], [0, 0, 0], [4, 0, 0]", 1e-5,
      R"("bodies": [)" + weight_at("weight", weight, "start") +
          R"(], "supports": [{ "beam": "rope", "at": "end", "type": "guided", "direction": [1, 0, 0], "force": 50 }],
      "eyelets": [{ "name": "winch", "beam": "rope", "at": { "length": 5 },
                    "motion": { "table": [[0, 0], [1, 0.5], [2, 2]] } }])",
      2));
  VerifyResult result;
  result.add("way of the weight in 2 s [m]", 2, "as driven", run.body(0).z() - run.body(4).z(), 1e-4);
  result.add("force of the winch at 1 s [N]", tail - weight * (g - a), "Newton's law",
             run.frames.at(2).bodies.at(1).holding_force, 0.02);
  return result;
}

}  // namespace

std::vector<VerifyProblem> eyelet_problems() {
  return {{"eyelet-atwood", "material, Green, straight", atwood},
          {"eyelet-movable-pulley", "material, Green, straight", movable_pulley},
          {"eyelet-winch", "material, Green, straight", winch}};
}

}  // namespace nurbeam
