// Cantilevers and hanging cables at rest.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"
#include "solver/rest/static_equilibrium.h"

namespace nurbeam {

namespace {

using namespace verification;
using std::numbers::pi;

/// A planar model without sliding joints in equilibrium, found from its drawn shape.
class PlanarRest {
 public:
  explicit PlanarRest(const BeamModel& model) : system_(noted(model, as_statics)) {
    state_ = drawn_state(system_);
    const StaticReport found = find_static_equilibrium(StaticEquilibrium{}, system_, state_);
    if (found.status != StaticStatus::converged) throw std::runtime_error("no static equilibrium was found");
  }
  PlanarRest(const PlanarRest&) = delete;
  PlanarRest& operator=(const PlanarRest&) = delete;

  Eigen::Vector2d position(double s) const { return material_point(system_, state_, 0, s).r.head<2>(); }
  double length() const { return beam_length(system_, state_, 0); }
  /// Pull of the first support on the beam, along the first axis, outwards [N].
  double pull() const { return -reaction(system_, state_, state_.lambda, 0).force.x(); }

 private:
  BeamSystem system_;
  State state_;
};

// ---- Cantilevers of 1 m with EI = 1 N m^2 ----

BeamModel cantilever(double EA, int elements) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {EA, 1, 1, 0, {}}, elements, {{0, true}});
  model.gravity.setZero();
  return model;
}

BeamModel rolled_up(double moment, int elements) {
  BeamModel model = cantilever(1e3, elements);
  add_moment(model, {0, 0, moment}, 1);
  return model;
}

VerifyResult roll_up() {
  VerifyResult result;
  const std::string source = "(EI/M) (sin, 1 - cos)(M L/EI)";
  for (const auto& [name, moment] : {std::pair{"M = pi EI/L", pi}, {"M = 2 pi EI/L", 2 * pi}}) {
    const PlanarRest rest(rolled_up(moment, 200));
    const Tip exact = roll_up_tip(moment);
    const std::string load = std::string(" [m], ") + name + ", 200 elements";
    result.add("tip x" + load, exact.x, source, rest.position(1).x(), 1e-8);
    result.add("tip y" + load, exact.y, source, rest.position(1).y(), 1e-8);
    result.add("length" + load, 1, "no axial strain", rest.length(), 1e-8);
  }
  ConvergenceTable table{"the tip [m] where M = 2 pi EI/L", "elements", {}};
  for (const int elements : {16, 32, 64})
    table.rows.emplace_back(elements, PlanarRest(rolled_up(2 * pi, elements)).position(1).norm());
  result.add(std::move(table), 4, 0.1, "cubic elements");
  return result;
}

VerifyResult elastica() {
  VerifyResult result;
  for (const int q : {1, 2, 5, 10}) {
    BeamModel model = cantilever(1e7, 64);
    add_force(model, {0, -double(q), 0}, 1);
    const PlanarRest rest(std::move(model));
    const Tip exact = elastica_tip(q);
    const std::string load = ", q = " + std::to_string(q) + ", EA = 1e7 EI/L^2";
    result.add("u/L" + load, 1 - exact.x, "Mattiasson 1981, elliptic integrals", 1 - rest.position(1).x(),
               1e-5);
    result.add("w/L" + load, -exact.y, "Mattiasson 1981, elliptic integrals", -rest.position(1).y(), 1e-5);
  }
  return result;
}

VerifyResult small_deflection() {
  VerifyResult result;
  ConvergenceTable loads{"the tip over PL^3/3EI, 1 element", "P [N]", {}};
  for (const double P : {0.004, 0.002, 0.001}) {
    BeamModel model = cantilever(1e3, 1);
    add_force(model, {0, -P, 0}, 1);
    const double ratio = -PlanarRest(std::move(model)).position(1).y() / (P / 3);
    loads.rows.emplace_back(P, std::abs(ratio - 1));
    if (P == 0.001)
      result.add("tip over PL^3/3EI, P = 0.001 EI/L^2, 1 element", 1, "linear theory", ratio, 1e-6);
  }
  result.add(std::move(loads), 2, 0.05, "linear theory misses the square of the load");

  // Under a line load a cubic element is exact at its nodes and misses w h^4/384EI in its middle.
  const double w = 1e-4;
  ConvergenceTable inside{"the middle of the first element [m] under w = 1e-4 N/m", "elements", {}};
  for (const int elements : {1, 2, 4}) {
    BeamModel model = cantilever(1e3, elements);
    add_line_load(model, {0, -w, 0});
    const PlanarRest rest(std::move(model));
    const double x = 0.5 / elements, exact = -w * x * x * (6 - 4 * x + x * x) / 24;
    inside.rows.emplace_back(elements, std::abs(rest.position(x).y() - exact));
    result.add("tip y [m] under w = 1e-4 N/m, " + std::to_string(elements) + " elements", -w / 8, "wL^4/8EI",
               rest.position(1).y(), 1e-12);
  }
  result.add(std::move(inside), 4, 0.05, "w h^4/384EI of a cubic");
  return result;
}

// ---- Cables under w = 10 N/m; EI = 0.01 N m^2 is as good as none ----

constexpr double weight = 10;

/// A cable between (0, 0) and (100 m, rise), drawn straight or as the arc of the given length.
BeamModel cable(double EA, double length, double rise) {
  const Eigen::Vector3d end(100, rise, 0);
  std::vector<RationalCubic> axis{line_cubic(Eigen::Vector3d::Zero(), end)};
  const double chord = end.norm();
  if (length > chord) {
    // The arc turns by 2 a: sin(a)/a = chord/length.
    const double a = root([&](double x) { return chord / length - std::sin(x) / x; }, 1e-3, 3);
    const double radius = chord / (2 * std::sin(a)), along = std::atan2(end.y(), end.x());
    const Eigen::Vector3d center =
        end / 2 + radius * std::cos(a) * Eigen::Vector3d(-std::sin(along), std::cos(along), 0);
    axis = arc_cubics(center, radius, along - pi / 2 - a, along - pi / 2 + a, 1);
  }
  BeamModel model = one_beam(axis, 2, {EA, 0.01, 1, 0, {}}, 40, {{0, false}, {2 * length, false}});
  model.gravity.setZero();
  add_line_load(model, {0, -weight, 0});
  return model;
}

VerifyResult catenary(double length, double H, double sag) {
  const PlanarRest rest(cable(1e6, length, 0));
  const std::string source = "Irvine's integrals with the Green law";
  VerifyResult result;
  result.add("H [N], EA = 1e6 N", H, source, rest.pull(), 1e-6 * H);
  result.add("sag [m], EA = 1e6 N", sag, source, -rest.position(length / 2).y(), 1e-6 * sag);
  return result;
}

VerifyResult uneven_supports() {
  VerifyResult result;
  const double S = 105, drop = 20;
  const StringLaw law{.EA = 1e6, .w = weight};
  const Hanging exact = hang(law, S, 100, -drop);
  const StringShape half = law.shape(exact.H, exact.V, S / 2);
  const PlanarRest rest(cable(law.EA, S, -drop));
  const std::string source = "the string's integrals with the Green law";
  result.add("H [N], EA = 1e6 N", exact.H, source, rest.pull(), 1e-6 * exact.H);
  result.add("middle x [m], EA = 1e6 N", half.x, source, rest.position(S / 2).x(), 1e-6 * half.x);
  result.add("middle y [m], EA = 1e6 N", half.y, source, rest.position(S / 2).y(), 1e-6 * std::abs(half.y));
  const double H = inextensible_pull(S, 100, drop, weight);
  result.add("H [N], EA = 1e11 N", H, "S^2 - d^2 = (2a sinh(X/2a))^2",
             PlanarRest(cable(1e11, S, -drop)).pull(), 1e-6 * H);
  return result;
}

}  // namespace

std::vector<VerifyProblem> statics_problems() {
  return {
      {"roll-up", "material, Green, straight", roll_up},
      {"elastica", "material, Green, straight", elastica},
      {"small-deflection", "material, Green, straight", small_deflection},
      {"catenary-straight", "material, Green, straight",
       [] { return catenary(100, 3462.027912, 3.60440202); }},
      {"catenary-slack", "material, Green, as drawn", [] { return catenary(102, 1396.162404, 9.03621513); }},
      {"uneven-supports", "material, Green, as drawn", uneven_supports},
  };
}

}  // namespace nurbeam
