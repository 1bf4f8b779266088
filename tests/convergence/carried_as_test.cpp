// A body that runs through elements that stay moves as one does with which a node moves: the two have meshes,
// constraints and events that share nothing.

#include <gtest/gtest.h>

#include <functional>

#include "pipelines/verification/verify_examples.h"
#include "tests/convergence/run_model.h"

namespace nurbeam {
namespace {

struct BothWays {
  double apart;         ///< largest distance of the two bodies [m]
  double energy_drift;  ///< of the one that is a point, of its largest kinetic energy
};

BothWays run_both(BeamModel model, double end, double step) {
  const std::vector<double> times = testing::even_times(end, 20);
  const auto node = testing::run_model(model, times, step);
  model.riders[0].as_point = true;
  const auto point = testing::run_model(model, times, step);
  EXPECT_FALSE(node.report.events.empty());
  EXPECT_TRUE(point.report.events.empty());
  double apart = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    apart = std::max(apart, (node.body(i) - point.body(i)).norm());
  return {apart, point.report.energy_drift / point.report.peak_kinetic_energy};
}

// Of second order at least.
void expect_order(const std::function<BeamModel(int)>& model, double end, double step) {
  double last = 0;
  for (const int elements : {10, 20, 40}) {
    const BothWays now = run_both(model(elements), end, step);
    if (last > 0) EXPECT_LT(now.apart, last / 3.2) << elements;
    EXPECT_LT(now.energy_drift, 1e-4) << elements;
    last = now.apart;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(CarriedAs, NodeAndPointConvergeToOneMotionOfAFallingBeam) {
  expect_order(verification::falling_beam, 0.55, 2e-4);
}

TEST(CarriedAs, NodeAndPointConvergeToOneMotionOfASuspendedBeam) {
  expect_order(verification::suspended_beam, 0.3, 2e-4);
}

TEST(CarriedAs, NodeAndPointConvergeToOneMotionOfASemicircle) {
  expect_order([](int elements) { return verification::semicircle(elements, false); }, 0.8, 5e-4);
}

}  // namespace
}  // namespace nurbeam
