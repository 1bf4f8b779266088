// Slender beams and slack cables: what an element that locks gets wrong. The tolerances are 1.2 times the
// errors of the method's first measurement.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/motion/record/snapshot.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_examples.h"
#include "pipelines/verification/verify_oracles.h"
#include "pipelines/verification/verify_run.h"
#include "solver/rest/static_equilibrium.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

/// The beams of a planar model in equilibrium, found from its drawn shape, and its energy.
struct AtRest {
  explicit AtRest(const BeamModel& model) {
    const BeamSystem system(noted(model, as_statics));
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

/// EI = 1 N m^2, L = 1 m.
BeamModel slender_cantilever(double ratio, int elements) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {ratio, 1, 1}, elements, {{0, true}});
  model.gravity.setZero();
  return model;
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

/// A quarter of a circle of unit length, as drawn: one rational cubic and pieces of it.
VerifyResult drawn_quarter_arc() {
  constexpr double ratio = 1e6, load = 2;
  const Tip exact = stretching_elastica_tip(ratio, load, pi / 2);
  VerifyResult result;
  ConvergenceTable table{"the tip [m], quarter arc as drawn, q = 2, EA L^2/EI = 1e6", "elements", {}};
  constexpr double R = 2 / pi;
  for (const int elements : {4, 8, 16}) {
    BeamModel model =
        one_beam(arc_cubics({0, R, 0}, R, -pi / 2, 0, 1), 2, {ratio, 1, 1}, elements, {{0, true}});
    model.gravity.setZero();
    add_force(model, {0, -load, 0}, 1);
    const double tip = (AtRest(model).tip() - Eigen::Vector2d(exact.x, exact.y)).norm();
    table.rows.emplace_back(elements, tip);
  }
  result.add("tip error [m], 16 elements", 0, "curved elastica that stretches, by shooting",
             table.rows.back().second, 2.4e-7);
  result.add(std::move(table), 4, 0.2, "cubic elements");
  return result;
}

/// In space the planar answer, in a plane askew to the axes.
VerifyResult spatial_cantilever() {
  constexpr double ratio = 1e8, load = 10;
  const Tip exact = stretching_elastica_tip(ratio, load);
  const Eigen::Vector3d down = Eigen::Vector3d(0, -3, 4) / 5;
  VerifyResult result;
  ConvergenceTable table{"the tip [m], in space, q = 10, EA L^2/EI = 1e8", "elements", {}};
  for (const int elements : {8, 16, 32}) {
    BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 3, {ratio, 1, 1}, elements, {{0, true}});
    model.gravity.setZero();
    add_force(model, load * down, 1);
    const AtRest rest(model);
    const Eigen::Vector3d tip = rest.beam.node_positions.back();
    table.rows.emplace_back(elements, (tip - Eigen::Vector3d(exact.x, 0, 0) + exact.y * down).norm());
    result.add("largest error of N/P in space, " + std::to_string(elements) + " elements", 0,
               "the load along the tangent", axial_force_error(rest.beam, load * down) / load,
               elements == 8    ? 0.04
               : elements == 16 ? 0.011
                                : 0.0025);
  }
  result.add("tip error in space [m], 32 elements", 0, "elastica that stretches, by shooting",
             table.rows.back().second, 2.4e-7);
  result.add(std::move(table), 4, 0.2, "cubic elements");
  return result;
}

/// A spline whose parameter runs unevenly, as drawn: weights from 0.4 to 3.
VerifyResult drawn_spline() {
  const auto tip = [](int elements) {
    Eigen::Matrix4d points;     // homogeneous, a column each
    points << 0, 0.9, 0.32, 1,  //
        0, 0.6, 0.32, 0.2,      //
        0, 0, 0, 0,             //
        1, 3, 0.4, 1;
    BeamModel model = one_beam({RationalCubic(points)}, 2, {1e8, 1, 1}, elements, {{0, true}});
    model.gravity.setZero();
    add_force(model, {0, -3, 0}, 10);
    return AtRest(model).tip();
  };
  const Eigen::Vector2d fine = tip(256);
  VerifyResult result;
  ConvergenceTable table{"the tip [m], uneven spline as drawn, EA L^2/EI = 1e8", "elements", {}};
  for (const int elements : {16, 32, 64}) table.rows.emplace_back(elements, (tip(elements) - fine).norm());
  result.add("tip error [m], uneven spline, 64 elements", 0, "256 elements", table.rows.back().second,
             1.9e-6);
  result.add(std::move(table), 4, 0.2, "cubic elements");
  return result;
}

/// The body's places in runs of a sliding example, to compare meshes.
std::vector<Eigen::Vector3d> body_places(const BeamModel& model, double end) {
  const RunRecord run = run_model(model, even_times(end, std::lround(end / 0.01)), 1e-4);
  std::vector<Eigen::Vector3d> places;
  for (std::size_t i = 0; i < run.frames.size(); ++i) places.push_back(run.body(i));
  return places;
}

double rms_distance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Example 1, thick as the paper has it, or of a fifth of the radius at the same mass and bending stiffness.
VerifyResult falling_beams() {
  struct Beam {
    const char* name;
    double stiffer, end;
    std::vector<std::pair<int, double>> errors;  // elements, [m]
  };
  VerifyResult result;
  for (const Beam& beam : {Beam{"EA L^2/EI = 4e4", 1, 0.55, {{5, 8e-3}, {10, 1.2e-3}, {20, 1.3e-4}}},
                           Beam{"EA L^2/EI = 1e6", 25, 0.5, {{10, 8e-4}, {20, 6e-5}, {40, 4.5e-6}}}}) {
    const auto model = [&](int elements) {
      BeamModel falling = falling_beam(elements);
      falling.beams[0].properties.axial_stiffness *= beam.stiffer;
      return falling;
    };
    const std::vector<Eigen::Vector3d> fine = body_places(model(80), beam.end);
    ConvergenceTable table{std::string("the body [m], rms, ") + beam.name, "elements", {}};
    for (const auto& [elements, error] : beam.errors) {
      table.rows.emplace_back(elements, rms_distance(body_places(model(elements), beam.end), fine));
      result.add(
          std::string("rms of the body [m], ") + beam.name + ", " + std::to_string(elements) + " elements", 0,
          "80 elements", table.rows.back().second, 1.2 * error);
    }
    result.add(std::move(table), 3, 0.3, "at least third order");
  }
  return result;
}

/// A rope of 1 m falls from the level about its pinned end.
VerifyResult rope_pendulum() {
  const auto tip = [](int elements) {
    const BeamModel model =
        one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {4e6, 1, 100}, elements, {{0, false}});
    const RunRecord run = run_model(model, even_times(0.6, 60), 2e-4, 0.9, {{0, 1}});
    std::vector<Eigen::Vector3d> places;
    for (std::size_t i = 0; i < run.frames.size(); ++i) places.push_back(run.probe(i));
    return places;
  };
  const std::vector<Eigen::Vector3d> fine = tip(64);
  VerifyResult result;
  ConvergenceTable table{"the tip [m], rms to 0.6 s, EA L^2/EI = 4e6", "elements", {}};
  for (const int elements : {4, 8, 16}) table.rows.emplace_back(elements, rms_distance(tip(elements), fine));
  result.add("rms of the tip [m], 16 elements", 0, "64 elements", table.rows.back().second, 6e-5);
  result.add(std::move(table), 3, 0.3, "at least third order");
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
  return model;
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
          {"axial-strain-arc", "material, Green, as drawn", drawn_quarter_arc},
          {"axial-strain-space", "material, Green, straight", spatial_cantilever},
          {"axial-strain-spline", "material, Green, as drawn", drawn_spline},
          {"axial-strain-slack", "material, Green, straight", slack_wires},
          {"axial-strain-falling-beam", "spatial, Green, straight", falling_beams},
          {"axial-strain-pendulum", "material, Green, straight", rope_pendulum}};
}

}  // namespace nurbeam
