#include "pipelines/verification/falling_chain.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "fem/model/build.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "nurbs/primitives.h"
#include "pipelines/verification/hanging_string.h"
#include "pipelines/verification/mass_chain.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify_oracles.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"

namespace nurbeam::verification {

namespace {

using std::numbers::pi;
using Points = std::vector<Eigen::Vector2d>;

constexpr double length = 10, EA = 2.5e5, g = 9.81;
constexpr int masses = 800, compared = 40;

BeamModel folded_rope(int elements, bool held) {
  const double straight = (length - pi / 2) / 2;
  std::vector<RationalCubic> axis{line_cubic({0, 0, 0}, {0, -straight, 0})};
  for (const RationalCubic& arc : arc_cubics({0.5, -straight, 0}, 0.5, pi, 2 * pi, 2)) axis.push_back(arc);
  axis.push_back(line_cubic({1, -straight, 0}, {1, 0, 0}));
  ModelBuilder builder(2, {0, -g, 0});
  constexpr double as_a_chain =
      1e-4;  // bending stiffness, which reaches over a hundredth of a metre at the bend
  builder.add_beam(ReferenceCurve(axis, 2).straightened(), BeamProperties(EA, as_a_chain, 1), {elements});
  builder.pin(0, 0);
  if (held) builder.pin(0, length);
  return builder.build();
}

Points points_of(const BeamSystem& system, const State& state) {
  Points points;
  const double L = system.model().beams[0].curve.length();
  for (int i = 0; i <= compared; ++i)
    points.emplace_back(material_point(system, state, 0, L * i / compared).r.head<2>());
  return points;
}

/// The chain in its own equilibrium: the force in every spring is known but for its level part.
class HangingChain {
 public:
  HangingChain() : chain_({0, -g, 0}) {
    const double H = root([](double level) { return places(level).back().x() - 1; }, 0.1, 10);
    for (const Eigen::Vector2d& place : places(H)) chain_.add_mass(0, {place.x(), place.y(), 0});
    for (int i = 0; i < masses; ++i) chain_.add_part(i, i + 1, length / masses, {0, EA, 1});
    chain_.hold(0);
  }

  Points at(double time) {
    chain_.advance(time);
    Points points;
    for (int i = 0; i <= compared; ++i) points.emplace_back(chain_.place(i * masses / compared).head<2>());
    return points;
  }

 private:
  static Points places(double H) {
    constexpr double part = length / masses;
    Points all{{0, 0}};
    for (int i = 0; i < masses; ++i) {
      const Eigen::Vector2d force(H, g * (part * (i + 0.5) - length / 2));
      const double T = force.norm();
      all.emplace_back(all.back() + part * string_stretch(0, EA, T) / T * force);
    }
    return all;
  }

  MassChain chain_;
};

double rms(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double least_slope(const BeamSystem& system, const State& state) {
  double least = 1;
  for (const MeshSpan& span : system.mesh().spans)
    for (int i = 0; i <= 20; ++i) {
      const double s = span.s_a + (span.s_b - span.s_a) * i / 20;
      least = std::min(least, material_point(system, state, 0, s).rs.norm());
    }
  return least;
}

}  // namespace

FallingChain falling_chain(int elements, double end) {
  constexpr double step = 5e-4;
  const BeamSystem before(folded_rope(elements, true)), system(noted(folded_rope(elements, false)));
  State state = drawn_state(before);
  if (find_static_equilibrium({}, before, state).status != StaticStatus::converged)
    throw std::runtime_error("no static equilibrium was found");
  state.lambda = Eigen::VectorXd::Zero(system.constraint_count());
  state.v = state.a = Eigen::VectorXd::Zero(system.coordinate_count());
  if (make_accelerations_consistent(system, state) != ConsistencyStatus::done)
    throw std::runtime_error("no consistent accelerations were found");
  HangingChain chain;
  GeneralizedAlphaIntegrator rope({.rho_infinity = 0.95}, system, state);
  FallingChain found;
  for (int i = 1; i <= std::lround(end / step); ++i) {
    if (rope.advance(step).status != StepStatus::converged) throw std::runtime_error("a step failed");
    if (i % 40 == 0) found.least_slope = std::min(found.least_slope, least_slope(system, rope.state()));
    if (i == 1200) found.at_0_6 = rms(points_of(system, rope.state()), chain.at(rope.state().t));
    if (i == 2400) found.at_1_2 = rms(points_of(system, rope.state()), chain.at(rope.state().t));
  }
  return found;
}

Recoil recoil(int elements) {
  constexpr double EI = 0.01;
  const double step = 5e-3 / elements;  // a quarter of what a wave of stretch takes along an element
  ModelBuilder builder(2, {0, -g, 0});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {length, 0, 0})}, 2), BeamProperties(EA, EI, 1),
                   {elements});
  builder.pin(0, 0);
  BeamModel model = builder.build();
  model.beams[0].properties.compression = Compression::buckles;
  const BeamSystem system(noted(model));
  State state = drawn_state(system);
  for (const MeshNode& node : system.mesh().nodes[0]) {
    state.q[node.r] *= 1.01;
    state.q[node.slope_left] = 1.01;
  }
  state.lambda = Eigen::VectorXd::Zero(system.constraint_count());
  state.v = state.a = Eigen::VectorXd::Zero(system.coordinate_count());
  if (make_accelerations_consistent(system, state) != ConsistencyStatus::done)
    throw std::runtime_error("no consistent accelerations were found");
  GeneralizedAlphaIntegrator rope({.rho_infinity = 0.95}, system, state);
  Recoil found;
  for (int i = 1; i <= std::lround(1 / step); ++i) {
    if (rope.advance(step).status != StepStatus::converged) throw std::runtime_error("a step failed");
    if (i % 40 == 0) found.least_slope = std::min(found.least_slope, least_slope(system, rope.state()));
  }
  found.end_x = material_point(system, rope.state(), 0, length).r.x();
  return found;
}

}  // namespace nurbeam::verification
