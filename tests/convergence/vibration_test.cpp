// Motion without a sliding body: frequencies, the curved pendulum, a force that moves over a beam.

#include <Eigen/Dense>
#include <algorithm>

#include "fem/beam_system.h"
#include "tests/convergence/run_model.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::arc_cubics;
using testing::even_times;
using testing::line_cubic;
using testing::one_beam;
using testing::round_bar;
using testing::run_model;
using testing::RunRecord;

// Angular frequencies of small vibrations about the drawn shape [rad/s], increasing; |omega^2| where
// round-off makes it negative.
Eigen::VectorXd frequencies(BeamModel model) {
  model.gravity.setZero();
  const BeamSystem<2> system(model, initial_plan(model));
  const int n = system.coordinate_count();
  const State state = system.drawn_state();
  const auto tangent = [&](const TangentWeights& w) {
    Eigen::SparseMatrix<double> kkt = system.tangent_pattern();
    system.tangent(state, w, kkt);
    return Eigen::MatrixXd(kkt);
  };
  const Eigen::MatrixXd M = tangent({.mass = 1}), K = tangent({.stiffness = 1});
  const Eigen::MatrixXd free = M.bottomLeftCorner(system.constraint_count(), n).fullPivLu().kernel();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      free.transpose() * K.topLeftCorner(n, n) * free, free.transpose() * M.topLeftCorner(n, n) * free,
      Eigen::EigenvaluesOnly);
  return modes.eigenvalues().cwiseAbs().cwiseSqrt();
}

TEST(Frequencies, OfASlenderBeamAreThoseOfEulerAndBernoulli) {
  const BeamProperties bar = round_bar(0.005, 7200, 200e9);
  const double unit = std::sqrt(bar.bending_stiffness / bar.mass_per_length);
  const auto beam = [&](const std::vector<std::pair<double, bool>>& supports) {
    return frequencies(one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, bar, 20, supports));
  };
  const Eigen::VectorXd cantilever = beam({{0, true}}), pinned = beam({{0, false}, {1, false}});
  const double roots[] = {1.87510407, 4.69409113, 7.85475744};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(cantilever[i] / (unit * roots[i] * roots[i]), 1, 1e-4);
    const double beta = (i + 1) * M_PI;
    EXPECT_NEAR(pinned[i] / (unit * beta * beta), 1, 1e-4);
  }
}

BeamModel curved_pendulum(CurvatureMeasure curvature, int elements) {
  return one_beam(arc_cubics({0, 0.5, 0}, 0.5, -M_PI / 2, -M_PI / 6, 1), 2,
                  round_bar(0.02, 6000, 2e6, curvature), elements, {{0, false}});
}

TEST(Frequencies, OfThePinnedArcAreThoseOfTheReference) {
  const std::vector<std::pair<CurvatureMeasure, std::vector<double>>> references{
      {CurvatureMeasure::spatial, {8.9996, 31.633, 62.390, 70.677, 117.66}},
      {CurvatureMeasure::material, {8.988, 31.597, 62.297, 70.822}}};
  for (const auto& [curvature, expected] : references) {
    const Eigen::VectorXd omega = frequencies(curved_pendulum(curvature, 24));
    EXPECT_LT(omega[0], 1e-3);  // it swings freely
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(omega[i + 1] / expected[i], 1, 2e-4);
  }
}

TEST(CurvedPendulum, SwingsAsInTheReferenceRuns) {
  struct Reference {
    double AB, fall, length;
  };
  // At 0.2, 0.4 and 0.8 s, to 4e-6 m; subdivision paper, Section 4, with the metric of the drawing.
  const std::vector<std::pair<CurvatureMeasure, std::vector<Reference>>> references{
      {CurvatureMeasure::spatial,
       {{0.423720923, -0.220576957, 0.526796576},
        {0.505662695, -0.745614747, 0.523011159},
        {0.445215937, -0.065294728, 0.531502082}}},
      {CurvatureMeasure::material,
       {{0.423709655, -0.220890605, 0}, {0.505894707, -0.745921325, 0}, {0.441658296, -0.066021437, 0}}}};
  for (const auto& [curvature, expected] : references) {
    const BeamModel model = curved_pendulum(curvature, 8);
    const double L = model.beams[0].curve.length();
    const RunRecord run = run_model(model, {0.2, 0.4, 0.8}, 1e-3, 0.9, {{0, 0}, {0, L}});
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Eigen::Vector3d a = run.frames[i].probes[0].position, b = run.frames[i].probes[1].position;
      EXPECT_NEAR((b - a).norm(), expected[i].AB, 5e-4);
      EXPECT_NEAR(b.y() - 0.25, expected[i].fall, 5e-4);
      if (expected[i].length > 0) EXPECT_NEAR(run.frames[i].beams[0].length, expected[i].length, 5e-4);
    }
  }
}

// Fryba's series: midspan deflection under a force that crosses a simply supported beam in unit time, over
// the static one; undefined where n = alpha.
double midspan_ratio(double alpha, double tau) {
  double sum = 0;
  for (int n = 1; n < 40; n += 2) {
    const double sign = n % 4 == 1 ? 1 : -1;
    sum += sign / (n * n * (n * n - alpha * alpha)) *
           (std::sin(n * M_PI * tau) - alpha / n * std::sin(n * n * M_PI * tau / alpha));
  }
  return 96 / std::pow(M_PI, 4) * sum;
}

TEST(MovingForce, BendsABeamAsInFrybasSeries) {
  const BeamProperties bar = round_bar(0.01, 7800, 210e9);
  const double L = 1, P = 1, largest[] = {1.2576, 1.7054, 1.5481}, alphas[] = {0.25, 0.5, 1.0};
  for (int k = 0; k < 3; ++k) {
    BeamModel model = one_beam({line_cubic({0, 0, 0}, {L, 0, 0})}, 2, bar, 8, {{0, false}, {L, false}});
    model.gravity.setZero();
    const double speed = alphas[k] * M_PI / L * std::sqrt(bar.bending_stiffness / bar.mass_per_length);
    model.point_loads.push_back({.beam = 0, .s = 0, .speed = speed, .value = {0, -P, 0}});
    const RunRecord run = run_model(model, even_times(L / speed, 200), L / speed / 200, 0.9, {{0, L / 2}});
    double deepest = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const double ratio = -run.probe(i).y() * 48 * bar.bending_stiffness / (P * L * L * L);
      deepest = std::max(deepest, ratio);
      if (alphas[k] < 1) EXPECT_NEAR(ratio, midspan_ratio(alphas[k], i / 200.0), 5e-3);
    }
    EXPECT_NEAR(deepest, largest[k], 1e-3);
  }
}

}  // namespace
}  // namespace nurbeam
