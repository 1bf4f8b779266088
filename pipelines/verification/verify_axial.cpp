// Slender beams and slack cables: what an element that locks gets wrong. The tolerances are 1.2 times the
// errors of the method's first measurement.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/motion/snapshot.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

/// The beams of a planar model in equilibrium, found from its drawn shape, and its energy.
struct AtRest {
  explicit AtRest(const BeamModel& model) {
    const BeamSystem system(model);
    State state = drawn_state(system);
    if (find_static_equilibrium({}, system, state).status != StaticStatus::converged)
      throw std::runtime_error("no static equilibrium was found");
    beam = record_beams(system, state)[0];
    energies = energy(system, state);
  }
  Eigen::Vector2d tip() const { return beam.node_positions.back().head<2>(); }

  BeamRecord beam;
  SystemEnergy energies;
};

/// With the assumed strain.
BeamModel unlocked(BeamModel model) {
  for (Beam& beam : model.beams) beam.properties.axial_strain = AxialStrain::ends_and_mean;
  return model;
}

/// EI = 1 N m^2, L = 1 m.
BeamModel slender_cantilever(double ratio, int elements) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {ratio, 1, 1}, elements, {{0, true}});
  model.gravity.setZero();
  return unlocked(std::move(model));
}

/// Largest error of the axial force in a beam that a dead force F pulls at its end: it is F along the
/// tangent.
double axial_force_error(const BeamRecord& beam, const Eigen::Vector3d& F) {
  double largest = 0;
  for (const ElementRecord& element : beam.elements) {
    const RationalCubic cubic(element.control_points);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d tangent = cubic.derivatives(i / 3.0).col(1).normalized();
      largest = std::max(largest, std::abs(element.axial_force[i] - F.dot(tangent)));
    }
  }
  return largest;
}

VerifyResult cantilevers() {
  constexpr double P = 10;
  constexpr int elements[] = {8, 16, 32};
  constexpr double tip_errors[] = {5.3e-5, 3.2e-6, 2.0e-7}, force_errors[] = {0.032, 0.009, 0.002};
  VerifyResult result;
  for (const double ratio : {1e4, 1e6, 1e8, 1e10}) {
    const Tip exact = stretching_elastica_tip(ratio, P);
    const std::string slender = ", EA L^2/EI = " + text_of(ratio);
    ConvergenceTable table{"the tip [m], q = 10" + slender, "elements", {}};
    for (int i = 0; i < 3; ++i) {
      BeamModel model = slender_cantilever(ratio, elements[i]);
      add_force(model, {0, -P, 0}, 1);
      const AtRest rest(model);
      const double tip = (rest.tip() - Eigen::Vector2d(exact.x, exact.y)).norm();
      const std::string mesh = slender + ", " + std::to_string(elements[i]) + " elements";
      result.add("tip error [m]" + mesh, 0, "elastica that stretches, by shooting", tip, 1.2 * tip_errors[i]);
      result.add("largest error of N/P" + mesh, 0, "the load along the tangent",
                 axial_force_error(rest.beam, {0, -P, 0}) / P, 1.2 * force_errors[i]);
      table.rows.emplace_back(elements[i], tip);
    }
    result.add(std::move(table), 4, 0.2, "cubic elements");
  }
  return result;
}

VerifyResult slender_roll_up() {
  VerifyResult result;
  constexpr double errors[] = {1.6e-3, 1e-4, 6e-6};
  ConvergenceTable table{"the tip [m], M = 2 pi EI/L, EA L^2/EI = 1e8", "elements", {}};
  for (int i = 0; i < 3; ++i) {
    BeamModel model = slender_cantilever(1e8, 8 << i);
    add_moment(model, {0, 0, 2 * pi}, 1);
    const double tip = AtRest(model).tip().norm();
    result.add("tip error [m], EA L^2/EI = 1e8, " + std::to_string(8 << i) + " elements", 0, "a full circle",
               tip, 1.2 * errors[i]);
    table.rows.emplace_back(8 << i, tip);
  }
  result.add(std::move(table), 4, 0.2, "cubic elements");
  return result;
}

/// Steel, with a tenth of its bending stiffness: the string has none.
BeamProperties wire_properties(double radius) {
  BeamProperties properties = round_bar(radius, 7850, 200e9);
  properties.bending_stiffness /= 10;
  return properties;
}

/// A wire of radius 1 mm between pins 10 m apart, of a length, drawn as an arc or nearly straight.
BeamModel wire(double length, int elements) {
  constexpr double span = 10, r = 1e-3;
  const double a = root([&](double x) { return span / length - std::sin(x) / x; }, 1e-3, 3);
  const double R = span / (2 * std::sin(a));
  BeamModel model = one_beam(arc_cubics({span / 2, R * std::cos(a), 0}, R, -pi / 2 - a, -pi / 2 + a, 2), 2,
                             wire_properties(r), elements, {{0, false}, {2 * length, false}});
  model.beams[0].curve = model.beams[0].curve.straightened();
  return unlocked(std::move(model));
}

VerifyResult slack_wires() {
  VerifyResult result;
  for (const auto& [length, elements] : {std::pair{10.1, 10}, {20.0, 40}}) {
    const BeamModel model = wire(length, elements);
    const double w = model.beams[0].properties.mass_per_length * 9.81;
    const Hanging exact = hang({model.beams[0].properties.axial_stiffness, w}, length, 10, 0);
    const AtRest rest(model);
    double least = INFINITY, largest = -INFINITY;
    for (const ElementRecord& element : rest.beam.elements) {
      least = std::min(least, element.axial_force.minCoeff());
      largest = std::max(largest, element.axial_force.maxCoeff());
    }
    const double greatest = std::hypot(exact.H, w * length / 2);
    const std::string mesh =
        " [N], " + text_of(100 * (length / 10 - 1)) + " % slack, " + std::to_string(elements) + " elements";
    result.add("least tension" + mesh, exact.H, "string with the Green law", least, 0.01 * exact.H);
    result.add("greatest tension" + mesh, greatest, "string with the Green law", largest, 0.01 * greatest);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> axial_strain_problems() {
  return {{"axial-strain-cantilever", "material, Green, straight", cantilevers},
          {"axial-strain-roll-up", "material, Green, straight", slender_roll_up},
          {"axial-strain-slack", "material, Green, straight", slack_wires}};
}

}  // namespace nurbeam
