// Beams in space whose sections twist: against Kirchhoff rods solved as initial value problems (DOP853 to
// 1e-12, shooting, no finite elements), closed forms and critical loads.

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/element/section_frame.h"
#include "fem/motion/recentring.h"
#include "fem/system/assembly.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/verify.h"
#include "solver/consistent.h"
#include "solver/explicit_integrator.h"
#include "solver/generalized_alpha.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Rule = Orientation::Rule;

// ---- Cantilevers ----

RationalCubic cubic(const std::array<Vector3d, 4>& P, const std::array<double, 4>& w) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << w[i] * P[i], w[i];
  return RationalCubic(points);
}

/// Stiffnesses of a rod [N, N m^2]; its sections are named by their first axis, as the references have them.
struct Rod {
  double EA, EI1, EI2, EI12, GJ;

  /// For a drawing whose sections d2 point where the references' d1 do: the two axes change places.
  BeamProperties properties() const {
    BeamProperties p(EA, 0, 1);
    p.sections = SectionStiffness{EI2, EI1, -EI12, GJ, 0.01};
    return p;
  }
};

/// A cantilever, clamped at s = 0.
ModelBuilder clamped(const ReferenceCurve& curve, const Rod& rod, int elements) {
  ModelBuilder builder(3);
  const int beam = builder.add_beam(curve, rod.properties(), {elements});
  builder.clamp(beam, 0);
  return builder;
}

/// At rest, from the drawn shape.
struct Rest {
  BeamSystem system;
  State state;

  explicit Rest(const ModelBuilder& builder) : system(builder.build()), state(drawn_state(system)) {
    const StaticReport found = find_static_equilibrium(StaticEquilibrium{}, system, state);
    if (found.status != StaticStatus::converged) throw std::runtime_error("no static equilibrium was found");
  }
  double length() const { return system.model().beams[0].curve.length(); }
  Vector3d tip() const { return material_point(system, state, 0, length()).r; }
  /// The references' d1.
  Vector3d axis() const { return section_point(system, state, 0, length()).triad.d2; }
};

struct Tip {
  Vector3d r, d1;  ///< position and first axis of the section [m], [-]
};

/// Errors of the tip and its section on meshes refined by 2; the finest one's tolerance is `allowed`.
VerifyResult tip_against(const std::function<ModelBuilder(int elements)>& model, const Tip& exact,
                         const std::vector<int>& meshes, double allowed, double order,
                         const std::string& source) {
  VerifyResult result;
  ConvergenceTable table{"the tip [m]", "elements", {}};
  for (const int elements : meshes) {
    const Rest rest(model(elements));
    table.rows.emplace_back(elements, (rest.tip() - exact.r).norm());
    if (elements != meshes.back()) continue;
    const std::string on = ", " + std::to_string(elements) + " elements";
    for (int i = 0; i < 3; ++i)
      result.add(std::string("tip ") + "xyz"[i] + " [m]" + on, exact.r[i], source, rest.tip()[i], allowed);
    if (!exact.d1.isZero(0))
      result.add("turn of the tip's section [rad]" + on, 0, source, (rest.axis() - exact.d1).norm(), allowed);
  }
  result.add(std::move(table), order, 0.1, "cubic elements");
  return result;
}

const char* const rod_source = "Kirchhoff rod, shooting";

/// The 45-degree bend of Bathe & Bolourchi (1979), without shear.
VerifyResult bend(double GJ, const Vector3d& tip, const Vector3d& d1) {
  const Vector3d center(100, 0, 0), end = center + 100 * Vector3d(-std::cos(pi / 4), std::sin(pi / 4), 0);
  const ReferenceCurve curve =
      ReferenceCurve(arc_cubics(center, Vector3d::Zero(), end, -Vector3d::UnitZ()), 3).oriented({});
  const auto model = [&](int elements) {
    ModelBuilder builder = clamped(curve, {1e7, 1e7 / 12, 1e7 / 12, 0, GJ}, elements);
    return builder.force(0, curve.length(), {0, 0, 600});
  };
  return tip_against(model, {tip, d1}, {8, 16, 32}, 6e-6, 4, rod_source);
}

ReferenceCurve rational_curve() {
  return ReferenceCurve(
      {cubic({Vector3d(0, 0, 0), Vector3d(1, 0, 0.2), Vector3d(1.2, 1, 0.4), Vector3d(0.6, 1.5, 1.4)},
             {1, 0.8, 1.3, 1})},
      3);
}
/// Its sections turn by 2.5 rad/m against parallel transport.
ReferenceCurve twisted_curve() {
  const ReferenceCurve curve = rational_curve();
  return curve.oriented({Rule::start, Vector3d::UnitZ(), {{0, 0}, {curve.length(), 2.5 * curve.length()}}});
}
const Rod twisted_rod{1e4, 3, 1, 0.2, 0.7};

VerifyResult twisted_under_force() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = twisted_curve();
    return clamped(curve, twisted_rod, elements).force(0, curve.length(), {0.4, -0.6, 0.5});
  };
  return tip_against(model,
                     {{1.326666613811, -0.396681428473, 1.822346556629},
                      {-0.115459902466, -0.746947324561, -0.654781417922}},
                     {16, 32}, 5.6e-5, 3.8, rod_source);
}

VerifyResult twisted_under_moment() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = twisted_curve();
    return clamped(curve, twisted_rod, elements)
        .force(0, curve.length(), {0.4, -0.6, 0.5})
        .moment(0, curve.length(), {0.2, 0.3, -0.25});
  };
  VerifyResult result = tip_against(model,
                                    {{1.535133495032, -0.581217054969, 1.676096937505},
                                     {-0.868734733306, -0.419526229834, -0.263244573790}},
                                    {16, 32}, 7.6e-5, 3.8, rod_source);
  return result;
}

VerifyResult upright_under_weight() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = rational_curve().oriented({Rule::up, Vector3d::UnitZ()});
    ModelBuilder builder = clamped(curve, {1e4, 3, 1, 0, 0.7}, elements);
    builder.force(0, curve.length(), {0.4, -0.6, 0.5}).add(LineLoad{0, {0, 0, -0.3}, {}});
    return builder;
  };
  return tip_against(
      model,
      {{1.490455617305, -0.304853644010, 1.575171803665}, {0.701054851321, -0.394174798419, -0.594262840611}},
      {8, 16, 32}, 8e-6, 3.8, rod_source);
}

/// Hermite cubics through a curve of parameter x, from 0 to `end`.
std::vector<RationalCubic> hermite(const std::function<Vector3d(double)>& r,
                                   const std::function<Vector3d(double)>& slope, double end, int pieces) {
  std::vector<RationalCubic> cubics;
  const double h = end / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double a = i * h, b = a + h;
    cubics.push_back(cubic({r(a), r(a) + h / 3 * slope(a), r(b) - h / 3 * slope(b), r(b)}, {1, 1, 1, 1}));
  }
  return cubics;
}

VerifyResult quarter_helix() {
  const auto model = [](int elements) {
    const ReferenceCurve curve =
        ReferenceCurve(
            hermite([](double x) { return Vector3d(std::cos(x), std::sin(x), x / pi); },
                    [](double x) { return Vector3d(-std::sin(x), std::cos(x), 1 / pi); }, pi / 2, elements),
            3)
            .oriented({Rule::up, Vector3d::UnitZ()});
    return clamped(curve, {1e5, 2, 1, 0, 0.8}, elements)
        .force(0, curve.length(), {0.5, 0.4, -0.6})
        .moment(0, curve.length(), {0.1, -0.2, 0.3});
  };
  return tip_against(
      model,
      {{0.337353395344, 1.244589969902, -0.448814079382}, {-0.804866436272, -0.039339332993, 0.592150687446}},
      {8, 16, 32}, 2e-7, 3.8, rod_source);
}

VerifyResult rod_to_helix() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3).oriented({});
    return clamped(curve, {1e4, 0.8, 0.8, 0, 0.5}, elements).moment(0, 2, {1.2, 1.6, 0.8});
  };
  return tip_against(
      model,
      {{0.420370514864, 0.999755712464, 0.369932802776}, {-0.320449264224, -0.931946593382, 0.169669726651}},
      {8, 16, 32}, 1.1e-5, 3.8, "an exact helix about the moment");
}

VerifyResult torque_about_the_tangent() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = ReferenceCurve({cubic({Vector3d(0, 0, 0), Vector3d(0.5, 0.9, 0),
                                                        Vector3d(1.6, 0.9, 0.7), Vector3d(1.9, -0.2, 0.5)},
                                                       {1, 1.4, 0.7, 1.1})},
                                                3)
                                     .oriented({Rule::up, {0, 1, 1}});
    ModelBuilder builder = clamped(curve, {2e4, 1, 2.5, -0.3, 0.6}, elements);
    const double L = curve.length();
    builder.force(0, L, {0.3, 0.5, -0.4})
        .add(Moment{{.beam = 0, .s = L, .value = 0.5 * curve.tangent(L), .follower = true, .time = {}}});
    return builder;
  };
  return tip_against(
      model,
      {{1.727174491866, 0.766102244670, -1.078367453319}, {0.185921980327, -0.944121401632, -0.272153993560}},
      {8, 16, 32}, 4.6e-6, 3.8, rod_source);
}

// ---- The drawn shape ----

/// The drawn shape turned by R, sections and all.
State turned_drawing(const BeamSystem& system, const Eigen::Matrix3d& R) {
  State state = drawn_state(system);
  const ReferenceCurve& curve = system.model().beams[0].curve;
  for (const MeshNode& node : system.mesh().nodes[0]) {
    const DrawnSection drawn = curve.section(node.s, node.s == curve.length());
    Eigen::Matrix3d chart;
    chart << drawn.d1, drawn.d2, drawn.t;
    const Vector3d t = R * drawn.t, d1 = R * drawn.d1;
    const SectionTriad<double> at_zero = section_at_node<double>(chart, t, 0.0);
    state.q.segment<3>(node.r) = R * curve.position(node.s);
    state.q.segment<3>(node.slope_left) = t;
    state.q[node.angle_left] = std::atan2(d1.dot(at_zero.d2), d1.dot(at_zero.d1));
  }
  return state;
}

VerifyResult turned_drawings() {
  VerifyResult result;
  for (const double degrees : {0, 30, 90, 170, 180, 720}) {
    double force = 0, strain_energy = 0;
    for (const int elements : {1, 2, 4, 8}) {
      ModelBuilder builder(3);
      builder.add_beam(twisted_curve(), twisted_rod.properties(), {elements});
      const BeamSystem system(builder.build());
      const Vector3d about = Vector3d(0.6, 0.5, 0.62).normalized();  // no tangent comes to its opposite
      const State state =
          turned_drawing(system, Eigen::AngleAxisd(degrees * pi / 180, about).toRotationMatrix());
      VectorXd dynamics(system.coordinate_count()), none(0);
      system.residual(state, dynamics, none);
      const SystemEnergy energy = nurbeam::energy(system, state);
      force = std::max(force, dynamics.norm());
      strain_energy = std::max(strain_energy, energy.axial + energy.bending + energy.torsion);
    }
    const std::string turned = ", turned by " + std::to_string(static_cast<int>(degrees)) + " degrees";
    result.add("force [N], 1 to 8 elements" + turned, 0, "the drawn shape is free of stress", force, 1e-10);
    result.add("strain energy [J]" + turned, 0, "the drawn shape is free of stress", strain_energy, 1e-25);
  }
  return result;
}

// ---- Matrices of small models ----

/// Tangents of a system, dense, on the motions that its constraints allow.
struct AllowedMotions {
  MatrixXd K, M;

  AllowedMotions(const BeamSystem& system, const State& state) {
    const int n = system.coordinate_count(), m = system.constraint_count();
    const auto tangent = [&](const TangentWeights& w) {
      Eigen::SparseMatrix<double> kkt = system.tangent_pattern();
      system.tangent(state, w, kkt);
      return MatrixXd(kkt);
    };
    const MatrixXd stiffness = tangent({.stiffness = 1});
    const MatrixXd Z =
        m == 0 ? MatrixXd::Identity(n, n) : MatrixXd(stiffness.bottomLeftCorner(m, n).fullPivLu().kernel());
    K = Z.transpose() * stiffness.topLeftCorner(n, n) * Z;
    M = Z.transpose() * tangent({.mass = 1}).topLeftCorner(n, n) * Z;
  }
};

int negative_eigenvalues(const MatrixXd& K, double below) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver((K + K.transpose()) / 2, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() < below).count());
}

/// Where `unstable` turns true between lo and hi.
double critical(const std::function<bool(double)>& unstable, double lo, double hi) {
  if (unstable(lo) || !unstable(hi)) return NAN;
  while (hi - lo > 1e-9 * hi) {
    const double middle = (lo + hi) / 2;
    (unstable(middle) ? hi : lo) = middle;
  }
  return (lo + hi) / 2;
}

// ---- Springs and frequencies ----

VerifyResult spring() {
  const double R = 1, pitch = 0.9, end = 6 * pi, EI = 2, GJ = 1.5, EA = 1e6;
  const double climb = pitch / (2 * pi), L = end * std::hypot(R, climb);
  const double sine = climb / std::hypot(R, climb), cosine = R / std::hypot(R, climb);
  const double exact = R * R * L * (cosine * cosine / GJ + sine * sine / EI) + L * sine * sine / EA;
  VerifyResult result;
  ConvergenceTable table{"the compliance [m/N]", "elements", {}};
  for (const int elements : {24, 48, 96}) {
    const ReferenceCurve curve =
        ReferenceCurve(
            hermite([&](double x) { return Vector3d(R * std::cos(x), R * std::sin(x), climb * x); },
                    [&](double x) { return Vector3d(-R * std::sin(x), R * std::cos(x), climb); }, end,
                    elements),
            3)
            .oriented({});
    // A force along the axis, on an arm that is held to the end: the work of a small one.
    const double F = 1e-6, s = curve.length();
    const Vector3d arm(-R, 0, 0), force(0, 0, F);
    const Rest rest(
        clamped(curve, {EA, EI, EI, 0, GJ}, elements).force(0, s, force).moment(0, s, arm.cross(force)));
    const SystemEnergy energy = nurbeam::energy(rest.system, rest.state);
    const double compliance = 2 * (energy.axial + energy.bending + energy.torsion) / (F * F);
    table.rows.emplace_back(elements, std::abs(compliance - exact));
    if (elements == 96)
      result.add("compliance along the axis [m/N], 96 elements", exact,
                 "R^2 L (cos^2/GJ + sin^2/EI) + L sin^2/EA", compliance, 1.6e-4);
  }
  result.add(std::move(table), 3.8, 0.1, "cubic elements");
  return result;
}

/// A straight round rod along x, from the origin.
ReferenceCurve straight_rod(double length) {
  return ReferenceCurve({line_cubic({0, 0, 0}, {length, 0, 0})}, 3).oriented({});
}

VerifyResult torsional_frequencies() {
  VerifyResult result;
  ConvergenceTable table{"the second torsional frequency [rad/s]", "elements", {}};
  for (const int elements : {4, 8}) {
    BeamProperties properties(1e3, 0, 1);
    properties.sections = SectionStiffness{1, 1, 0, 1, 1};
    ModelBuilder builder(3);
    builder.add_beam(straight_rod(1), properties, {elements});
    const BeamSystem system(builder.clamp(0, 0).build());
    const AllowedMotions motions(system, drawn_state(system));
    // Bending and stretching are decoupled, and as slow or slower: take the frequencies nearest to the
    // answer.
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(motions.K, motions.M,
                                                                   Eigen::EigenvaluesOnly);
    for (const double exact : {pi / 2, 3 * pi / 2}) {
      const VectorXd frequencies = modes.eigenvalues().cwiseMax(0).cwiseSqrt();
      Eigen::Index nearest;
      (frequencies.array() - exact).abs().minCoeff(&nearest);
      const double error = std::abs(frequencies[nearest] - exact);
      if (exact > pi) table.rows.emplace_back(elements, error);
      if (elements == 8)
        result.add("torsional frequency, fixed-free [rad/s], 8 elements", exact, "(k - 1/2) pi c/L",
                   frequencies[nearest], exact > pi ? 1e-3 : 5e-6);
    }
  }
  result.add(std::move(table), 3.8, 0.1, "quadratic twist");
  return result;
}

// ---- Critical loads ----

/// A state twisted evenly by the moment M, from the drawing.
State twisted_state(const BeamSystem& system, double M) {
  State state = drawn_state(system);
  const double GJ = system.model().beams[0].properties.sections->torsion;
  for (const MeshNode& node : system.mesh().nodes[0]) state.q[node.angle_left] = M * node.s / GJ;
  return state;
}

/// The stiffness at a state with coordinates `held` and others tied to one another.
MatrixXd stiffness(const BeamSystem& system, const State& state) {
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern();
  system.tangent(state, {.stiffness = 1}, kkt);
  return MatrixXd(kkt).topLeftCorner(system.coordinate_count(), system.coordinate_count());
}

VerifyResult greenhill() {
  VerifyResult result;
  const double L = 2, exact = 8.986818915818;
  ConvergenceTable table{"the critical moment M L/EI", "elements", {}};
  for (const int elements : {8, 16, 32}) {
    ModelBuilder builder(3);
    builder.add_beam(straight_rod(L), Rod{1e4, 1, 1, 0, 0.8}.properties(), {elements});
    const BeamSystem system(builder.build());
    const MeshNode &first = system.mesh().nodes[0].front(), &last = system.mesh().nodes[0].back();
    std::vector<bool> held(system.coordinate_count(), false);
    for (const int d : {0, 1, 2}) held[first.r + d] = true;
    for (const MeshNode* node : {&first, &last}) {
      for (const int d : {1, 2}) held[node->r + d] = held[node->slope_left + d] = true;
      held[node->angle_left] = true;
    }
    std::vector<int> free;
    for (int i = 0; i < system.coordinate_count(); ++i)
      if (!held[i]) free.push_back(i);
    const double computed = critical(
        [&](double m) {
          return negative_eigenvalues(stiffness(system, twisted_state(system, m / L))(free, free), 0) > 0;
        },
        0.9 * exact, 1.1 * exact);
    table.rows.emplace_back(elements, std::abs(computed - exact));
    if (elements == 32)
      result.add("M L/EI of a twisted rod, clamped, 32 elements", exact, "tan x = x (Greenhill)", computed,
                 1.8e-5 * exact);
  }
  result.add(std::move(table), 3.8, 0.1, "cubic elements");
  return result;
}

VerifyResult twisted_ring() {
  VerifyResult result;
  const double R = 1, exact = std::sqrt(3);
  ConvergenceTable table{"the critical moment M R/EI", "elements", {}};
  for (const int elements : {16, 32, 64}) {
    ModelBuilder builder(3);
    builder.add_beam(ReferenceCurve(arc_cubics({0, 0, 0}, R, 0, 2 * pi, 4), 3).straightened().oriented({}),
                     Rod{1e6, 1, 1, 0, 0.8}.properties(), {elements});
    const BeamSystem system(builder.build());
    // The end is tied to the start; its section stays turned against it by the twist.
    const MeshNode &first = system.mesh().nodes[0].front(), &last = system.mesh().nodes[0].back();
    const int n = system.coordinate_count();
    std::vector<int> to(n);
    for (int i = 0; i < n; ++i) to[i] = i;
    for (int d = 0; d < 3; ++d) {
      to[last.r + d] = first.r + d;
      to[last.slope_left + d] = first.slope_left + d;
    }
    to[last.angle_left] = first.angle_left;
    MatrixXd tie = MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) tie(i, to[i]) = 1;
    std::vector<int> kept;
    for (int i = 0; i < n; ++i)
      if (to[i] == i) kept.push_back(i);
    // Six rigid motions and the ring's turn about its own tangent cost nothing, but round-off.
    const auto unstable = [&](double M) {
      const MatrixXd K = tie.transpose() * stiffness(system, twisted_state(system, M)) * tie;
      return negative_eigenvalues(K(kept, kept), -1e-7) > 0;
    };
    const double computed = critical(unstable, 0.9 * exact, 1.1 * exact);
    table.rows.emplace_back(elements, std::abs(computed - exact));
    if (elements == 32)
      result.add("M R/EI of a twisted ring, 32 elements", exact, "sqrt(3) (Michell 1889, Zajac 1962)",
                 computed, 7e-5);
  }
  result.add(std::move(table), 3.8, 0.1, "cubic elements");
  return result;
}

/// In equilibrium at the load, on the branch that starts at `state`: Newton's method, dense.
State equilibrium(const BeamSystem& system, State state, double load) {
  const int n = system.coordinate_count(), m = system.constraint_count();
  state.load = load;
  for (int i = 0; i < 30; ++i) {
    VectorXd rows(n + m);
    system.residual(state, rows.head(n), rows.tail(m));
    Eigen::SparseMatrix<double> kkt = system.tangent_pattern();
    system.tangent(state, {.stiffness = 1}, kkt);
    const VectorXd step = MatrixXd(kkt).partialPivLu().solve(rows);
    state.q -= step.head(n);
    state.lambda -= step.tail(m);
    if (step.head(n).norm() < 1e-12 * (1 + state.q.norm())) return state;
  }
  throw std::runtime_error("no equilibrium was found");
}

double critical_load(const BeamModel& model, double lo, double hi) {
  const BeamSystem system(model);
  return critical(
      [&](double load) {
        const State state = equilibrium(system, drawn_state(system), load);
        return negative_eigenvalues(AllowedMotions(system, state).K, 0) > 0;
      },
      lo, hi);
}

VerifyResult lateral_buckling() {
  VerifyResult result;
  for (const int elements : {8, 16}) {
    BeamProperties strip(1e8, 0, 1);
    strip.sections = SectionStiffness{1e5, 1, 0, 0.5, 0.01};
    ModelBuilder builder(3);
    builder.add_beam(straight_rod(2), strip, {elements});
    builder.clamp(0, 0).force(0, 2, {0, 0, 1});
    const double factor = 4 / std::sqrt(0.5);
    result.add("P L^2/sqrt(EI2 GJ) of a cantilever strip, " + std::to_string(elements) + " elements", 4.0126,
               "Timoshenko & Gere", factor * critical_load(builder.build(), 3.8 / factor, 4.3 / factor),
               5e-4);
  }
  return result;
}

/// A cantilever of two legs at a right angle, one beam with a rigid corner.
VerifyResult right_angle_frame() {
  VerifyResult result;
  const double leg = 240, b = 0.6, h = 30, E = 71240, G = E / (2 * 1.31);
  for (const int per_leg : {2, 8}) {
    BeamProperties strip(E * b * h, 0, 1e-3);
    strip.sections =
        SectionStiffness{E * b * h * h * h / 12, E * h * b * b * b / 12, 0, G * h * b * b * b / 3, 1e-3};
    ModelBuilder builder(3);
    const std::vector<RationalCubic> legs{line_cubic({0, 0, 0}, {leg, 0, 0}),
                                          line_cubic({leg, 0, 0}, {leg, -leg, 0})};
    builder.add_beam(ReferenceCurve(legs, 3).oriented({Rule::start, {0, 1, 0}, {}}), strip, {2 * per_leg});
    BeamModel model = builder.clamp(0, 0).force(0, 2 * leg, {1, 0, 0}).build();
    model.beams[0].home[per_leg].kind = NodeKind::rigid;
    result.add("critical load of a right-angle frame, " + std::to_string(per_leg) + " elements a leg", 1.0885,
               "1.087 to 1.090", critical_load(model, 0.9, 1.2), 1.5e-3);
  }
  return result;
}

// ---- Free flight ----

/// A quarter circle with twisted sections that is thrown, turning by 7 rad in 0.8 s.
struct Flight {
  MeshedState at;
  int recentrings = 0;

  Flight() {
    const ReferenceCurve arc(arc_cubics({0, 0, 0}, 1, 0, pi / 2, 1), 3);
    const double L = arc.length();
    BeamProperties properties = Rod{2000, 2, 1, 0, 0.8}.properties();
    properties.sections->spin_inertia = 0.004;
    properties.axial_strain = AxialStrain::pointwise;
    ModelBuilder builder(3);
    builder.add_beam(arc.oriented({Rule::start, Vector3d::UnitZ(), {{0, 0}, {L, 1.2 * L}}}), properties, {2});
    at = MeshedState::drawn(std::make_shared<const BeamModel>(builder.build()));
    const Vector3d w(6, -4, 5);
    int k = 0;
    for (const MeshNode& node : at.system->mesh().nodes[0]) {
      const Vector3d rs = at.state.q.segment<3>(node.slope_left);
      at.state.v.segment<3>(node.r) = w.cross(Vector3d(at.state.q.segment<3>(node.r)));
      at.state.v.segment<3>(node.slope_left) = w.cross(rs);
      at.state.v[node.angle_left] = w.dot(rs.normalized()) + 3 * k++;
    }
  }

  void fly(double end, double step, bool explicitly) {
    std::unique_ptr<Integrator> integrator = start(explicitly);
    while (at.state.t < end - step / 2) {
      if (integrator->advance(step).status != StepStatus::converged)
        throw std::runtime_error("a step failed");
      at.state = integrator->state();
      if (!recentring_due(*at.system, at.state)) continue;
      at = recentred(*at.system, at.state);
      ++recentrings;
      integrator = start(explicitly);
    }
  }
  std::unique_ptr<Integrator> start(bool explicitly) {
    if (make_accelerations_consistent(*at.system, at.state) != ConsistencyStatus::done)
      throw std::runtime_error("no accelerations");
    if (explicitly) return std::make_unique<ExplicitIntegrator>(ExplicitRungeKutta{}, *at.system, at.state);
    return std::make_unique<GeneralizedAlphaIntegrator>(
        GeneralizedAlpha{.rho_infinity = 0.9, .newton_tolerance = 1e-13}, *at.system, at.state);
  }

  double energy() const { return nurbeam::energy(*at.system, at.state).mechanical(); }
  Vector3d start_point() const { return at.state.q.segment<3>(at.system->mesh().nodes[0][0].r); }
  /// About the origin [kg m^2/s]: by the rotations of all nodes, which turn the angle by w . (t + m)/(1 + t .
  /// m).
  Vector3d angular_momentum() const {
    Eigen::SparseMatrix<double> kkt = at.system->tangent_pattern();
    at.system->tangent(at.state, {.mass = 1}, kkt);
    const VectorXd p = kkt * at.state.v;
    Vector3d sum = Vector3d::Zero();
    const auto& nodes = at.system->mesh().nodes[0];
    const auto& elements = at.system->assembly<3>()->elements();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const MeshNode& node = nodes[i];
      const auto part = [&](const VectorXd& x, int first) -> Vector3d { return x.segment<3>(first); };
      const Vector3d t = part(at.state.q, node.slope_left).normalized();
      const TwistElement& element = elements[std::min(i, elements.size() - 1)].twist->element;
      const Vector3d m = element.chart(i < elements.size() ? 0 : 1).col(2);
      for (const int first : {node.r, node.slope_left}) sum += part(at.state.q, first).cross(part(p, first));
      sum += p[node.angle_left] * (t + m) / (1 + t.dot(m));
    }
    return sum;
  }
};

VerifyResult free_flight() {
  VerifyResult result;
  const double end = 0.8;
  const Vector3d exact(-2.622729899, 3.134903344, 5.398534461);
  const std::string source = "the same elements, Runge-Kutta";
  Flight flight;
  const double energy = flight.energy();
  const Vector3d angular_momentum = flight.angular_momentum();
  flight.fly(end, 2e-4, true);
  result.add("exchanges of charts, at least", 1, "it turns by 7 rad", flight.recentrings, 0);
  result.rows.back().at_least = true;
  for (int i = 0; i < 3; ++i)
    result.add(std::string("start ") + "xyz"[i] + " [m]", exact[i], source, flight.start_point()[i], 2e-9);
  const Vector3d d1 = section_point(*flight.at.system, flight.at.state, 0, 0).triad.d2;
  result.add("section at the start, x", 0.32490696, source, d1.x(), 2e-8);
  result.add("section at the start, y", -0.81585570, source, d1.y(), 2e-8);
  result.add("energy [J]", 52.0896, source, energy, 5e-5);
  result.add("change of energy [J]", 0, "nothing dissipates", flight.energy() - energy, 1e-8);
  result.add("change of angular momentum [kg m^2/s]", 0, "no force acts",
             (flight.angular_momentum() - angular_momentum).norm(), 1e-8);
  ConvergenceTable table{"the start [m], generalized-alpha", "step [s]", {}};
  for (const double step : {2e-4, 1e-4, 5e-5}) {
    Flight again;
    again.fly(end, step, false);
    table.rows.emplace_back(step, (again.start_point() - exact).norm());
  }
  result.add(std::move(table), 2, 0.1, "second order, exchanges of charts or not");
  return result;
}

}  // namespace

std::vector<VerifyProblem> torsion_problems() {
  const std::string measures = "material, Green, as drawn, torsion";
  return {
      {"torsion-bend", measures,
       [] {
         return bend(1e7 / 12, {15.685355756, 47.152150168, 53.471762721},
                     {-0.4165758761, -0.8163498388, 0.4000468473});
       }},
      {"torsion-bend-square", measures,
       [] {
         return bend(0.140577014955 * 5e6, {15.558334235, 46.893617693, 53.604283430}, Vector3d::Zero());
       }},
      {"torsion-twisted-force", measures, twisted_under_force},
      {"torsion-twisted-moment", measures, twisted_under_moment},
      {"torsion-upright-weight", measures, upright_under_weight},
      {"torsion-helix", measures, quarter_helix},
      {"torsion-rod-to-helix", measures, rod_to_helix},
      {"torsion-drawn", measures, turned_drawings},
      {"torsion-spring", measures, spring},
      {"torsion-greenhill", measures, greenhill},
      {"torsion-ring", measures, twisted_ring},
      {"torsion-strip", measures, lateral_buckling},
      {"torsion-frame", measures, right_angle_frame},
      {"torsion-follower", measures, torque_about_the_tangent},
      {"torsion-frequencies", measures, torsional_frequencies},
      {"torsion-flight", "material, Green pointwise, as drawn, torsion", free_flight},
  };
}

}  // namespace nurbeam
