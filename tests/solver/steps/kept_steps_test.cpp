#include "solver/steps/kept_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/small_systems.h"

namespace nurbeam {
namespace {

struct Seen {
  State before;
  IntegratorHistory history;
  State after;
  bool repeated;
};

bool same(const State& a, const State& b) {
  return a.t == b.t && a.q == b.q && a.v == b.v && a.a == b.a && a.lambda == b.lambda;
}

// Whatever is kept of them: the same bits, as the run had them.
TEST(KeptSteps, AreTheStepsOfTheRun) {
  const testing::CartesianPendulum pendulum;
  constexpr GeneralizedAlpha settings{.tolerance = 1e-5};  // steps of many lengths
  constexpr std::size_t count = 37;
  for (const std::size_t most : {1, 2, 3, 7, 16, 100}) {
    KeptSteps kept(settings, pendulum, most);
    GeneralizedAlphaIntegrator integrator(settings, pendulum, pendulum.at_angle(0, 0.7, 0.5));
    std::vector<Seen> steps;
    double length = 0.01;
    for (std::size_t i = 0; i < count; ++i) {
      const State before = integrator.state();
      const IntegratorHistory history = integrator.history();
      const bool repeated = i == 20;
      const StepReport taken =
          repeated ? integrator.repeat(before, history, 0.003) : integrator.advance(length);
      ASSERT_EQ(taken.status, StepStatus::converged);
      length = taken.next_step;
      steps.push_back({before, history, integrator.state(), repeated});
      kept.add({before, history, steps.back().after, repeated});
    }
    ASSERT_EQ(kept.size(), count);
    std::vector<std::size_t> order;
    const auto visit = [&](std::size_t i, const KeptSteps::Step& step) {
      order.push_back(i);
      EXPECT_TRUE(same(step.before, steps[i].before)) << i << " of " << most;
      EXPECT_TRUE(same(step.after, steps[i].after)) << i << " of " << most;
      EXPECT_EQ(step.history.vectors, steps[i].history.vectors) << i << " of " << most;
      EXPECT_EQ(step.history.numbers[0], steps[i].history.numbers[0]) << i << " of " << most;
      EXPECT_EQ(step.repeated, steps[i].repeated);
    };
    kept.forward(visit);
    ASSERT_EQ(order.size(), count);
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
    order.clear();
    kept.back(visit);
    ASSERT_EQ(order.size(), count);
    EXPECT_TRUE(std::is_sorted(order.rbegin(), order.rend()));
  }
}

}  // namespace
}  // namespace nurbeam
