// Motion without a sliding body: frequencies, steady spin, the curved pendulum, a force that moves over a
// beam.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/references.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"
#include "pipelines/verification/verify_run.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

// ---- Frequencies ----

/// Angular frequencies of small vibrations about a state [rad/s], increasing; |omega^2| where round-off makes
/// it negative.
Eigen::VectorXd frequencies(const BeamSystem& system, const State& state) {
  const int n = system.coordinate_count();
  const auto tangent = [&](const TangentWeights& w) {
    return Eigen::MatrixXd(tangent_matrix(system, state, w));
  };
  const Eigen::MatrixXd M = tangent({.mass = 1}), K = tangent({.stiffness = 1});
  const Eigen::MatrixXd free = M.bottomLeftCorner(system.constraint_count(), n).fullPivLu().kernel();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      free.transpose() * K.topLeftCorner(n, n) * free, free.transpose() * M.topLeftCorner(n, n) * free,
      Eigen::EigenvaluesOnly);
  return modes.eigenvalues().cwiseAbs().cwiseSqrt();
}

/// The same about the drawn shape stretched by a factor.
Eigen::VectorXd frequencies(BeamModel model, double stretch = 1) {
  model.gravity.setZero();
  const BeamSystem system(noted(model), initial_plan(model));
  State state = drawn_state(system);
  state.q *= stretch;
  return frequencies(system, state);
}

using Supports = std::vector<std::pair<double, bool>>;

BeamModel bar_of_one_metre(const BeamProperties& properties, int elements, const Supports& supports) {
  return one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, properties, elements, supports);
}

VerifyResult straight_frequencies() {
  VerifyResult result;
  const BeamProperties bar = round_bar(0.005, 7200, 200e9);
  const double unit = std::sqrt(bar.bending_stiffness / bar.mass_per_length);
  const auto add = [&](const std::string& name, const Supports& supports, const std::vector<double>& roots) {
    const Eigen::VectorXd omega = frequencies(bar_of_one_metre(bar, 48, supports));
    for (std::size_t i = 0; i < roots.size(); ++i)
      result.add(name + " beta_" + std::to_string(i + 1) + " L, 48 elements", roots[i], "Euler-Bernoulli",
                 std::sqrt(omega[static_cast<Eigen::Index>(i)] / unit), 1e-6 * roots[i]);
  };
  const Supports clamped{{0, true}}, pinned{{0, false}, {1, false}};
  add("clamped-free", clamped, {1.87510407, 4.69409113, 7.85475744});
  add("pinned-pinned", pinned, {pi, 2 * pi, 3 * pi});
  ConvergenceTable table{"the third clamped-free frequency, relative", "elements", {}};
  for (const int elements : {8, 16, 32})
    table.rows.emplace_back(elements, std::abs(frequencies(bar_of_one_metre(bar, elements, clamped))[2] /
                                                   (unit * std::pow(7.85475743823761, 2)) -
                                               1));
  result.add(std::move(table), 4, 0.1, "cubic elements");

  // A string of 1 m drawn out by 1 %: T = EA lambda (lambda^2 - 1)/2, mass rho A/lambda per deformed length.
  const BeamProperties string{1e4, 1e-9, 0.1, 0, {}};
  const double lambda = 1.01, T = string.axial_stiffness * lambda * (lambda * lambda - 1) / 2;
  const double c = std::sqrt(T * lambda / string.mass_per_length);
  const Eigen::VectorXd omega = frequencies(bar_of_one_metre(string, 48, pinned), lambda);
  for (int n = 1; n <= 3; ++n)
    result.add("taut string omega_" + std::to_string(n) + " [rad/s], stretch 1.01, 48 elements",
               n * pi * c / lambda, "n pi c/L", omega[n - 1], 1e-6 * n * pi * c / lambda);
  return result;
}

BeamModel curved_pendulum(CurvatureMeasure curvature, int elements) {
  return one_beam(arc_cubics({0, 0.5, 0}, 0.5, -pi / 2, -pi / 6, 1), 2, round_bar(0.02, 6000, 2e6, curvature),
                  elements, {{0, false}});
}

/// Reference frequencies with their last digit.
struct Frequency {
  double omega, digit;
};

VerifyResult arc_frequencies(CurvatureMeasure curvature, const std::vector<Frequency>& references) {
  VerifyResult result;
  const Eigen::VectorXd omega = frequencies(curved_pendulum(curvature, 32));
  result.add("pinned arc omega_0 [rad/s], 32 elements", 0, "it swings freely", omega[0], 1e-3);
  for (std::size_t i = 0; i < references.size(); ++i)
    result.add("pinned arc omega_" + std::to_string(i + 1) + " [rad/s], 32 elements", references[i].omega,
               "reference run, last digit", omega[static_cast<Eigen::Index>(i) + 1], references[i].digit);
  return result;
}

// ---- Steady spin ----

struct Spin {
  double extension, expected;  // [m]; at the speed it has come to
};

/// A bar of 1 m pinned at its start, set spinning without stretch; damping brings it to its steady length.
Spin steady_spin(double a) {
  const BeamProperties bar{1e4, 100, 1, 0.012, {}};
  BeamModel model = bar_of_one_metre(bar, 8, {{0, false}});
  model.gravity.setZero();
  const double wave_speed = std::sqrt(bar.axial_stiffness / bar.mass_per_length);
  const BeamSystem system(noted(model), initial_plan(model));
  State state = drawn_state(system);
  for (const MeshNode& node : system.mesh().nodes[0])
    for (const int place : {node.r, node.slope_left})
      state.v.segment<2>(place) = a * wave_speed * Eigen::Vector2d(-state.q[place + 1], state.q[place]);
  constexpr double step = 2e-4;
  if (make_accelerations_smooth(system, step, state) != ConsistencyStatus::done)
    throw std::runtime_error("singular mass");
  GeneralizedAlphaIntegrator integrator({.newton_tolerance = 1e-12}, system, state);
  for (int i = 0; i < 2500; ++i)
    if (integrator.advance(step).status != StepStatus::converged) throw std::runtime_error("a step failed");
  const State& end = integrator.state();
  const int tip = system.mesh().nodes[0].back().r;
  const Eigen::Vector2d r = end.q.segment<2>(tip), v = end.v.segment<2>(tip);
  const double alpha = (r.x() * v.y() - r.y() * v.x()) / r.squaredNorm() / wave_speed;
  return {r.norm() - 1, std::tan(alpha) / alpha - 1};
}

VerifyResult spin() {
  VerifyResult result;
  ConvergenceTable table{"the extension over tan(aL)/a - L", "aL", {}};
  for (const double a : {0.04, 0.02, 0.01}) {
    const Spin bar = steady_spin(a);
    table.rows.emplace_back(a, std::abs(bar.extension / bar.expected - 1));
    if (a == 0.01)
      result.add("extension [m], aL = 0.01, 8 elements", bar.expected, "tan(aL)/a - L", bar.extension,
                 1e-3 * bar.expected);
  }
  result.add(std::move(table), 2, 0.1, "small-strain theory misses the strain's square");
  return result;
}

// ---- The curved pendulum ----

using references::Swing;

RunRecord swing(CurvatureMeasure curvature, int elements, const std::vector<double>& times, double step) {
  const BeamModel model = curved_pendulum(curvature, elements);
  return run_model(model, times, step, 0.9, {{0, 0}, {0, model.beams[0].curve.length()}});
}

void add_swing(VerifyResult& result, const Snapshot& frame, const Swing& reference, const std::string& mesh) {
  const Eigen::Vector3d a = frame.probes[0].position, b = frame.probes[1].position;
  const std::string when = " [m], t = 0." + std::to_string(std::lround(10 * frame.time)) + " s, " + mesh;
  const std::string source = "two reference runs, 4e-6 m";
  result.add("AB" + when, reference.AB, source, (b - a).norm(), 4e-6);
  result.add("dy_B" + when, reference.fall, source, b.y() - 0.25, 4e-6);
  if (reference.length > 0)
    result.add("length" + when, reference.length, source, frame.beams[0].length, 4e-6);
}

VerifyResult pendulum(CurvatureMeasure curvature, const std::vector<Swing>& references) {
  VerifyResult result;
  const RunRecord run = swing(curvature, 32, {0.2, 0.4, 0.8}, 2e-4);
  for (std::size_t i = 0; i < references.size(); ++i)
    add_swing(result, run.frames[i], references[i], "32 elements");
  return result;
}

VerifyResult pendulum_accuracy() {
  VerifyResult result;
  const std::vector<double> times = even_times(1, 50);
  constexpr double step = 1e-4;
  const RunRecord fine = swing(CurvatureMeasure::spatial, 64, times, step);
  for (std::size_t i = 0; i < references::pendulum().size(); ++i)
    add_swing(result, fine.frames[std::vector<std::size_t>{10, 20, 40}[i]], references::pendulum()[i],
              "64 elements");
  // |AB| misses 2e-6 m with 32 elements, and 16 and 256 times as much with 16 and 8.
  ConvergenceTable table{"B [m], largest up to 1 s", "elements", {}};
  for (const auto& [elements, tolerance] : {std::pair{8, 5e-4}, {16, 3.2e-5}, {24, 0.0}, {32, 2e-6}}) {
    const RunRecord run = swing(CurvatureMeasure::spatial, elements, times, step);
    double distance = 0, AB = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::vector<ProbeRecord>&p = run.frames[i].probes, &q = fine.frames[i].probes;
      distance = std::max(distance, (p[1].position - q[1].position).norm());
      AB = std::max(
          AB, std::abs((p[1].position - p[0].position).norm() - (q[1].position - q[0].position).norm()));
    }
    if (elements > 8) table.rows.emplace_back(elements, distance);
    if (tolerance > 0)
      result.add("largest error of AB up to 1 s [m], " + std::to_string(elements) + " elements", 0,
                 "64 elements", AB, tolerance);
  }
  result.add(std::move(table), 4, 0.5, "cubic elements: about h^4");
  return result;
}

// ---- Moving force ----

VerifyResult moving_force() {
  VerifyResult result;
  const BeamProperties bar = round_bar(0.01, 7800, 210e9);
  const double L = 1, P = 1;
  constexpr int steps = 1000;
  for (const auto& [alpha, published] : {std::pair{0.25, 1.2576}, {0.5, 1.7054}, {1.0, 1.5481}}) {
    BeamModel model = bar_of_one_metre(bar, 16, {{0, false}, {L, false}});
    model.gravity.setZero();
    const double speed = alpha * pi / L * std::sqrt(bar.bending_stiffness / bar.mass_per_length);
    add_force(model, {0, -P, 0}, 0, speed);
    const RunRecord run =
        run_model(model, even_times(L / speed, steps), L / speed / steps, 0.9, {{0, L / 2}});
    double deepest = 0, farthest = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const double ratio = -run.probe(i).y() * 48 * bar.bending_stiffness / (P * L * L * L);
      deepest = std::max(deepest, ratio);
      farthest = std::max(farthest, std::abs(ratio - midspan_ratio(alpha, static_cast<double>(i) / steps)));
    }
    std::string name = ", alpha = " + std::to_string(alpha).substr(0, 4);
    result.add("largest midspan y over PL^3/48EI" + name, published, "Fryba", deepest, 1e-4);
    result.add("the same against the series" + name, largest_midspan_ratio(alpha), "Fryba's series", deepest,
               1e-4);
    result.add("farthest midspan y from the series" + name, 0, "Fryba's series", farthest, 1e-3);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> dynamics_problems() {
  constexpr auto spatial = CurvatureMeasure::spatial, material = CurvatureMeasure::material;
  return {
      {"frequencies", "material, Green, straight", straight_frequencies},
      {"frequencies-arc-spatial", "spatial, Green, as drawn",
       [] {
         return arc_frequencies(
             spatial, {{8.9996, 1e-4}, {31.633, 1e-3}, {62.390, 1e-3}, {70.677, 1e-3}, {117.66, 1e-2}});
       }},
      {"frequencies-arc-material", "material, Green, as drawn",
       [] {
         return arc_frequencies(material, {{8.988, 1e-3}, {31.597, 1e-3}, {62.297, 1e-3}, {70.822, 1e-3}});
       }},
      {"steady-spin", "material, Green, straight", spin},
      {"pendulum-spatial", "spatial, Green, as drawn",
       [] { return pendulum(spatial, references::pendulum()); }},
      {"pendulum-material", "material, Green, as drawn",
       [] { return pendulum(material, references::pendulum_with_material_curvature()); }},
      {"pendulum-accuracy", "spatial, Green, as drawn", pendulum_accuracy},
      {"moving-force", "material, Green, straight", moving_force},
  };
}

}  // namespace nurbeam
