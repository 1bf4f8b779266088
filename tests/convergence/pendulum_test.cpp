// The curved pendulum of the subdivision paper, in three drawings of one arc.

#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/papers/pendulum_motion.h"
#include "pipelines/verification/references.h"

namespace nurbeam {
namespace {

constexpr double step = 4e-4;  // extrapolated to 0: 8e-6 m are left

class Pendulum : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { fine_ = extrapolated_pendulum_motion({.elements = 32}, step); }
  static PendulumError error(const PendulumMesh& mesh) {
    const PendulumMotion motion = extrapolated_pendulum_motion(mesh, step);
    EXPECT_EQ(motion.report.status, SimulationStatus::done);
    return largest_difference(motion, fine_);
  }
  static PendulumMotion fine_;
};
PendulumMotion Pendulum::fine_;

TEST(PendulumArcs, AreTheSameArcWithOtherSpeeds) {
  const auto speed = [](PendulumArc arc, double u) {
    return pendulum_axis(arc).derivatives(u).col(1).norm();
  };
  for (PendulumArc arc : {PendulumArc::uniform, PendulumArc::paper, PendulumArc::extreme})
    for (double u : {0.0, 0.3, 0.5, 0.9, 1.0}) {
      const Eigen::Vector3d r = pendulum_axis(arc).point(u);
      EXPECT_NEAR(std::hypot(r.x(), r.y() - 0.5), 0.5, 1e-6);
    }
  EXPECT_NEAR(speed(PendulumArc::uniform, 1) / speed(PendulumArc::uniform, 0), 1, 1e-12);
  EXPECT_NEAR(speed(PendulumArc::paper, 1) / speed(PendulumArc::paper, 0), 2.0485, 1e-4);
  EXPECT_NEAR(speed(PendulumArc::extreme, 1) / speed(PendulumArc::extreme, 0), 16, 1e-12);
}

// Two programs that share no formulation, spatial curvature, at 0.2, 0.4 and 0.8 s, to 4e-6 m.
TEST_F(Pendulum, OnAFineMeshSwingsAsInTheReferenceRuns) {
  for (const references::Swing& swing : references::pendulum()) {
    const auto at = static_cast<std::size_t>(std::lround(100 * swing.time));
    EXPECT_NEAR(fine_.AB.at(at), swing.AB, 1.2e-5);
    EXPECT_NEAR(fine_.fall.at(at), swing.fall, 1.2e-5);
    EXPECT_NEAR(fine_.length.at(at), swing.length, 1.2e-5);
  }
}

// The whip back after 0.9 s carries most of the error in y_B.
TEST_F(Pendulum, ConvergesToOneMotionInEveryParametrisation) {
  for (PendulumArc arc : {PendulumArc::uniform, PendulumArc::paper, PendulumArc::extreme}) {
    SCOPED_TRACE(static_cast<int>(arc));
    const PendulumError eight = error({.arc = arc, .elements = 8}),
                        sixteen = error({.arc = arc, .elements = 16});
    EXPECT_LT(eight.AB, 5e-4);
    EXPECT_LT(eight.fall, 7.5e-4);
    EXPECT_LT(sixteen.AB, arc == PendulumArc::extreme ? 4e-5 : 3e-5);
    EXPECT_LT(sixteen.fall, 7e-5);
    EXPECT_GT(std::log2(eight.AB / sixteen.AB), 3.5);
    EXPECT_GT(std::log2(eight.fall / sixteen.fall), 3);
  }
}

TEST_F(Pendulum, WithoutTheMetricConvergesToWrongLimits) {
  const auto wrong = [](PendulumArc arc, int elements) {
    return error({.arc = arc, .elements = elements, .metric = false}).AB;
  };
  for (int elements : {8, 16}) {
    EXPECT_NEAR(wrong(PendulumArc::uniform, elements), 6.7e-3, 4e-4);
    EXPECT_NEAR(wrong(PendulumArc::paper, elements), 7.1e-2, 1e-3);
  }
  const PendulumMotion collapsed =
      pendulum_motion({.arc = PendulumArc::extreme, .elements = 8, .metric = false},
                      GeneralizedAlpha{.rho_infinity = 0.9}, step);
  EXPECT_EQ(collapsed.report.status, SimulationStatus::not_converged);
  EXPECT_GT(collapsed.report.time, 0.5);
}

TEST(PendulumSteps, OfGeneralizedAlphaAreOfSecondOrderInEnergyAndPlace) {
  const PendulumMesh mesh{.elements = 8};
  const GeneralizedAlpha method{.rho_infinity = 0.9};
  const PendulumMotion exact = pendulum_motion(mesh, ExplicitRungeKutta{}, 2.5e-4);
  const auto run = [&](double h) { return pendulum_motion(mesh, method, h); };
  const PendulumMotion coarse = run(2.5e-4), middle = run(1.25e-4), fine = run(6.25e-5);
  EXPECT_NEAR(std::log2(coarse.drift() / middle.drift()), 2, 0.1);
  EXPECT_NEAR(std::log2(middle.drift() / fine.drift()), 2, 0.1);
  EXPECT_LT(fine.drift(), 1e-6);
  EXPECT_NEAR(std::log2(largest_difference(coarse, exact).fall / largest_difference(middle, exact).fall), 2,
              0.5);
}

// Steps that resolve the fastest of the axial waves, which the sudden weight excites.
TEST(PendulumSteps, OfRungeAndKuttaAreOfFourthOrder) {
  const PendulumMesh mesh{.elements = 2};
  const auto run = [&](double h) { return pendulum_motion(mesh, ExplicitRungeKutta{}, h); };
  const PendulumMotion a = run(4e-4), b = run(2e-4), exact = run(5e-5);
  EXPECT_NEAR(std::log2(largest_difference(a, exact).AB / largest_difference(b, exact).AB), 4, 0.5);
}

TEST(PendulumSteps, OfThePaperAreStableUpToItsNumberOfElements) {
  const PendulumMotion seven = pendulum_motion({.elements = 7}, ExplicitRungeKutta{}, 1e-3);
  EXPECT_EQ(seven.t.size(), 101U);
  EXPECT_LT(seven.drift(), 1e-5);
  const PendulumMotion sixteen = pendulum_motion({.elements = 16}, ExplicitRungeKutta{}, 1e-3);
  EXPECT_FALSE(sixteen.t.size() == 101 && sixteen.drift() < 1);
}

}  // namespace
}  // namespace nurbeam
