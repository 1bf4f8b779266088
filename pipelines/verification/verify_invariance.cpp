// What must not change: energy, momentum, the answer in another frame, with a joint that does not slide, on a
// mesh with one more node.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/element/quadrature.h"
#include "fem/motion/remesh/transfer.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_examples.h"
#include "pipelines/verification/verify_run.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

// ---- Energy ----

/// Largest departure of the total energy from its start until the first event on the way, over the peak
/// kinetic energy until then.
double relative_drift(const BeamModel& model, double end, double step) {
  const long count = std::lround(end / step);
  step = end / static_cast<double>(count);
  const RunRecord run = run_model(model, even_times(end, count), step, 1);
  for (const RunEvent& event : run.report.events)
    if (event.time > 0) end = std::min(end, event.time - step / 2);
  double drift = 0, kinetic = 0;
  for (const Snapshot& frame : run.frames) {
    if (frame.time > end) break;
    drift = std::max(drift, std::abs(frame.energy.total - run.frames[0].energy.total));
    kinetic = std::max(kinetic, frame.energy.kinetic);
  }
  return drift / kinetic;
}

VerifyResult energy_drift(const BeamModel& model, double end, const std::vector<double>& steps) {
  VerifyResult result;
  ConvergenceTable table{"the energy over its peak kinetic part, before the first event", "step [s]", {}};
  for (const double step : steps) table.rows.emplace_back(step, relative_drift(model, end, step));
  result.add("energy drift over peak kinetic energy, finest step", 0, "nothing dissipates",
             table.rows.back().second, 1e-6);
  result.add(std::move(table), 2, 0.2, "generalized-alpha, rho = 1");
  return result;
}

BeamModel pendulum(int elements) {
  return one_beam(arc_cubics({0, 0.5, 0}, 0.5, -pi / 2, -pi / 6, 1), 2, round_bar(0.02, 6000, 2e6), elements,
                  {{0, false}});
}

// ---- Rigid motion ----

/// Example 1 turned and moved as a whole.
BeamModel moved_falling_beam(int dimension, const Eigen::Matrix3d& R, const Eigen::Vector3d& shift) {
  const BeamModel plain = falling_beam(12);
  BeamModel model = one_beam({line_cubic(shift, R * Eigen::Vector3d::UnitX() + shift)}, dimension,
                             plain.beams[0].properties, 12, {{0, true}});
  model.gravity = R * plain.gravity;
  add_slider(model, plain.bodies[0].mass, plain.riders[0].s);
  return model;
}

VerifyResult rigid_motion() {
  VerifyResult result;
  const std::vector<double> times = even_times(0.4, 8);
  const auto run = [&](const BeamModel& model) { return run_model(model, times, 5e-4, 0.9, {{0, 1}}); };
  const RunRecord plain = run(falling_beam(12));
  const Eigen::Vector3d shift(3, -2, 0);
  const auto add = [&](const std::string& name, int dimension, const Eigen::Matrix3d& R,
                       const Eigen::Vector3d& by) {
    const RunRecord moved = run(moved_falling_beam(dimension, R, by));
    double body = 0, tip = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      body = std::max(body, (moved.body(i) - R * plain.body(i) - by).norm());
      tip = std::max(tip, (moved.probe(i) - R * plain.probe(i) - by).norm());
    }
    result.add("example 1 " + name + ": farthest body [m]", 0, "the unmoved run", body, 1e-9);
    result.add("example 1 " + name + ": farthest tip [m]", 0, "the unmoved run", tip, 1e-9);
  };
  add("turned by 0.7 in its plane and moved", 2,
      Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix(), shift);
  add("turned by 2 in space and moved", 3,
      Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      shift + Eigen::Vector3d::UnitZ());
  return result;
}

// ---- A joint that does not slide ----

VerifyResult frozen_sliding() {
  VerifyResult result;
  const BeamModel plain = pendulum(8);
  const std::vector<double> times = even_times(0.5, 10);
  const double L = plain.beams[0].curve.length();
  const auto run = [&](const BeamModel& model) { return run_model(model, times, 5e-4, 0.9, {{0, L}}); };
  BeamModel frozen = plain;
  add_slider(frozen, 1e-12, 0.375 * L);
  frozen.riders[0].motion = TimeTable{{0, 0.375 * L}};
  const RunRecord without = run(plain), with = run(frozen);
  double tip = 0, place = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    tip = std::max(tip, (with.probe(i) - without.probe(i)).norm());
    place = std::max(place, std::abs(with.place(i) - 0.375 * L));
  }
  result.add("farthest tip of the pendulum [m], body of 1e-12 kg held in place", 0, "the run without a joint",
             tip, 1e-9);
  result.add("largest |s - s_0| [m]", 0, "prescribed", place, 1e-12);
  return result;
}

// ---- Momentum over a merge ----

VerifyResult merge_momentum() {
  // A beam that nothing holds, bent by a body that runs along it.
  BeamModel model = one_beam(arc_cubics({0, 1, 0}, 1, -pi / 2, 0, 1), 2, round_bar(0.02, 2000, 2e7), 12, {});
  model.gravity.setZero();
  add_slider(model, 1, 0.2);
  model.riders[0].speed = 4;
  const RunRecord run = run_model(model, {0, 0.25}, 2e-4);
  double jump = 0;
  int merges = 0;
  for (const RunEvent& event : run.report.events) {
    if (event.kind != EventKind::merge) continue;
    ++merges;
    jump = std::max(jump, (event.momentum_after - event.momentum_before).norm());
  }
  VerifyResult result;
  result.rows.push_back(
      {"merges of a free beam with a running body", 5, "else nothing is shown", double(merges), 0, true});
  result.add("largest jump of momentum over a merge [N s], body 1 kg at 4 m/s", 0, "no outer force", jump,
             1e-12);
  return result;
}

// ---- Split ----

/// Fields of a state at a place, and integrals over the beam by a rule fine enough not to show.
struct Fields {
  MaterialPoint<3> at;
  double kinetic, axial, bending, length;  // per length [J/m], [-]
};

Fields fields(const BeamSystem& system, const State& state, double s) {
  const Beam& beam = system.model().beams[0];
  Fields f{material_point(system, state, 0, s), 0, 0, 0, 0};
  const int segment = beam.curve.segment_at(s);
  const double kappa_0 = beam.curve.geometry(segment, beam.curve.parameter(segment, s)).curvature[0];
  const Eigen::Vector3d &rs = f.at.rs, &rss = f.at.rss;
  const double A = rs.squaredNorm(), strain = (A - 1) / 2;
  const double bending = (rs.x() * rss.y() - rs.y() * rss.x()) / A - kappa_0;
  f.kinetic = beam.properties.mass_per_length * f.at.velocity.squaredNorm() / 2;
  f.axial = beam.properties.axial_stiffness * strain * strain / 2;
  f.bending = beam.properties.bending_stiffness * bending * bending / 2;
  f.length = std::sqrt(A);
  return f;
}

VerifyResult split() {
  // A moving body whose neighbouring node is missing, and comes back after 0.1 s.
  BeamModel model =
      one_beam(arc_cubics({0, 1, 0}, 1, -pi / 2, 0, 1), 2, round_bar(0.02, 2000, 2e7), 10, {{0, true}});
  model.beams[0].properties.axial_strain = AxialStrain::pointwise;  // else the new node is moved
  const std::vector<HomeNode>& home = model.beams[0].home;
  add_slider(model, 1, (home[3].s + home[4].s) / 2);
  model.riders[0].speed = 0.5;
  MeshPlan full = initial_plan(model);
  full.beams[0].present.assign(home.size(), true);
  MeshPlan coarse = full;
  coarse.beams[0].present[4] = coarse.beams[0].present[7] = false;
  const BeamSystem from(noted(model), coarse), to(model, full);
  State state = drawn_state(from);
  start_moving(from, state);
  if (make_accelerations_smooth(from, 2e-4, state) != ConsistencyStatus::done)
    throw std::runtime_error("singular mass");
  GeneralizedAlphaIntegrator integrator({}, from, state);
  for (int i = 0; i < 250; ++i)
    if (integrator.advance(2e-4).status != StepStatus::converged) throw std::runtime_error("a step failed");
  const State& before = integrator.state();
  const State after = interpolated(from, before, to);

  std::vector<double> cuts{*place(from, before, 0)};
  for (const HomeNode& node : home) cuts.push_back(node.s);
  std::sort(cuts.begin(), cuts.end());
  double position = 0, slope = 0, curve = 0, velocity = 0;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero(), change = Eigen::Vector4d::Zero();
  constexpr int parts = 20;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c)
    for (int i = 0; i < parts; ++i)
      for (int g = 0; g < GaussRule::size; ++g) {
        const double width = (cuts[c + 1] - cuts[c]) / parts;
        const double s = cuts[c] + width * (i + GaussRule::points[g]), w = width * GaussRule::weights[g];
        const Fields a = fields(from, before, s), b = fields(to, after, s);
        position = std::max(position, (b.at.r - a.at.r).norm());
        slope = std::max(slope, (b.at.rs - a.at.rs).norm());
        curve = std::max(curve, (b.at.rss - a.at.rss).norm());
        velocity = std::max(velocity, (b.at.velocity - a.at.velocity).norm());
        const Eigen::Vector4d of_a(a.kinetic, a.axial, a.bending, a.length),
            of_b(b.kinetic, b.axial, b.bending, b.length);
        sum += w * of_a;
        change += w * (of_b - of_a);
      }
  VerifyResult result;
  const std::string source = "the state before the split";
  result.add("farthest position after a split [m]", 0, source, position, 1e-12);
  result.add("largest change of r_s [-]", 0, source, slope, 1e-11);
  result.add("largest change of r_ss [1/m]", 0, source, curve, 1e-9);
  result.add("largest change of velocity [m/s]", 0, source, velocity, 1e-11);
  const char* names[] = {"kinetic energy", "axial energy", "bending energy", "length"};
  for (int i = 0; i < 4; ++i)
    result.add(std::string("change of ") + names[i] + ", relative", 0, source, change[i] / sum[i], 1e-11);
  return result;
}

}  // namespace

std::vector<VerifyProblem> invariance_problems() {
  const auto drift = [](const BeamModel& model, double end, const std::vector<double>& steps) {
    return [=] { return energy_drift(model, end, steps); };
  };
  return {
      {"split", "material, Green, as drawn", split},
      {"merge-momentum", "material, Green, as drawn", merge_momentum},
      {"frozen-sliding", "material, Green, as drawn", frozen_sliding},
      {"rigid-motion", "spatial, Green, straight", rigid_motion},
      {"energy-drift-pendulum", "material, Green, as drawn", drift(pendulum(4), 1, {3e-4, 1.5e-4, 7.5e-5})},
      {"energy-drift-example-1", "spatial, Green, straight",
       drift(falling_beam(10), 0.14, {1e-4, 5e-5, 2.5e-5})},
      {"energy-drift-example-2", "spatial, Green, straight",
       drift(suspended_beam(6), 0.2, {2e-4, 1e-4, 5e-5})},
      {"energy-drift-example-3-as-drawn", "spatial, Green, as drawn",
       drift(semicircle(8, false), 0.25, {4e-4, 2e-4, 1e-4})},
      {"energy-drift-example-3-straight", "spatial, Green, straight",
       drift(semicircle(8, true), 0.2, {1e-4, 5e-5, 2.5e-5})},
  };
}

}  // namespace nurbeam
