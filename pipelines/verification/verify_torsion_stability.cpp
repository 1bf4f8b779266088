// Beams in space whose sections twist: springs, torsional frequencies and critical loads against closed
// forms.

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "fem/system/assembly.h"
#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/rod_models.h"
#include "pipelines/verification/verify.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Rule = Orientation::Rule;

// ---- Matrices of small models ----

/// Tangents of a system, dense, on the motions that its constraints allow.
struct AllowedMotions {
  MatrixXd K, M;

  AllowedMotions(const BeamSystem& system, const State& state) {
    const int n = system.coordinate_count(), m = system.constraint_count();
    const auto tangent = [&](const TangentWeights& w) { return MatrixXd(tangent_matrix(system, state, w)); };
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

VerifyResult torsional_frequencies() {
  VerifyResult result;
  ConvergenceTable table{"the second torsional frequency [rad/s]", "elements", {}};
  for (const int elements : {4, 8}) {
    BeamProperties properties(1e3, 0, 1);
    properties.sections = SectionStiffness{1, 1, 0, 1, 1};
    ModelBuilder builder(3);
    builder.add_beam(straight_rod(1), properties, {elements});
    const BeamSystem system(noted(builder.clamp(0, 0).build()));
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
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.stiffness = 1});
  return MatrixXd(kkt).topLeftCorner(system.coordinate_count(), system.coordinate_count());
}

/// The moment M L/EI at which a rod of 2 m with both ends clamped, one free along the axis, leaves its line;
/// under the tension T L^2/EI.
double moment_of_a_clamped_rod(int elements, double tension, double lo, double hi) {
  const double L = 2, EA = tension > 0 ? 1e8 : 1e4;
  ModelBuilder builder(3);
  builder.add_beam(straight_rod(L), Rod{EA, 1, 1, 0, 0.8}.properties(), {elements});
  const BeamSystem system(noted(builder.build(), as_statics));
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
  // Pulled by T = EA e (1 + e/2)(1 + e) along x.
  const double T = tension / (L * L), strain = T / EA * (1 - 1.5 * T / EA);
  const auto leaves_its_line = [&](double m) {
    State state = twisted_state(system, m / L);
    for (const MeshNode& node : system.mesh().nodes[0]) {
      state.q[node.r] *= 1 + strain;
      state.q[node.slope_left] *= 1 + strain;
    }
    return negative_eigenvalues(stiffness(system, state)(free, free), 0) > 0;
  };
  return critical(leaves_its_line, lo, hi);
}

VerifyResult greenhill() {
  VerifyResult result;
  constexpr double exact = 8.986818915818;
  ConvergenceTable table{"the critical moment M L/EI", "elements", {}};
  for (const int elements : {8, 16, 32}) {
    const double computed = moment_of_a_clamped_rod(elements, 0, 0.9 * exact, 1.1 * exact);
    table.rows.emplace_back(elements, std::abs(computed - exact));
    if (elements == 32)
      result.add("M L/EI of a twisted rod, clamped, 32 elements", exact, "tan x = x (Greenhill)", computed,
                 1.8e-5 * exact);
  }
  result.add(std::move(table), 3.8, 0.1, "cubic elements");
  for (const auto& [tension, moment] : {std::pair{1., 9.13473009}, {10., 10.42885644}, {30., 13.11349975}})
    result.add("M L/EI under a tension T L^2/EI of " + text_of(tension) + ", 32 elements", moment,
               "Greenhill's rod with both ends clamped, its determinant",
               moment_of_a_clamped_rod(32, tension, 0.95 * moment, 1.05 * moment), 6e-5 * moment);
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
    const BeamSystem system(noted(builder.build(), as_statics));
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
    Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.stiffness = 1});
    const VectorXd step = MatrixXd(kkt).partialPivLu().solve(rows);
    state.q -= step.head(n);
    state.lambda -= step.tail(m);
    if (step.head(n).norm() < 1e-12 * (1 + state.q.norm())) return state;
  }
  throw std::runtime_error("no equilibrium was found");
}

double critical_load(const BeamModel& model, double lo, double hi) {
  const BeamSystem system(noted(model, as_statics));
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

}  // namespace

std::vector<VerifyProblem> torsion_stability_problems() {
  const std::string measures = "material, Green, as drawn, torsion";
  return {
      {"torsion-spring", measures, spring},
      {"torsion-greenhill", measures, greenhill},
      {"torsion-ring", measures, twisted_ring},
      {"torsion-strip", measures, lateral_buckling},
      {"torsion-frame", measures, right_angle_frame},
      {"torsion-frequencies", measures, torsional_frequencies},
  };
}

}  // namespace nurbeam
