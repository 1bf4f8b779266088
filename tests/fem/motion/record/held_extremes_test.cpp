#include "fem/motion/record/held_extremes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fem/system/initial_state.h"
#include "nurbs/primitives.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

const std::vector<BeamPart> all_parts = {
    {0, nullptr},
    {0, &BeamRecord::axial_force_min},
    {0, &BeamRecord::axial_force_max},
    {0, &BeamRecord::moment_max},
    {0, &BeamRecord::shear_force_max},
    {0, &BeamRecord::displacement_max},
    {0, &BeamRecord::torque_max},
    {0, &BeamRecord::twist_max},
};

std::vector<double> values_of(const BeamRecord& record) {
  std::vector<double> values;
  for (const BeamPart& part : all_parts)
    values.push_back(part.extreme ? (record.*part.extreme).value : record.length + record.sag);
  return values;
}

BeamModel arc(int dimension, bool has_torsion) {
  BeamProperties properties = testing::round_bar(0.02, 7200, 2e8);
  const double EI = properties.bending_stiffness;
  if (has_torsion) properties.sections = SectionStiffness{EI, EI, 0, EI / 1.3, 1e-3};
  return testing::one_beam(testing::arc_cubics({0, 0, 0}, 1, -0.8 * M_PI, -0.3 * M_PI, 2), dimension,
                           properties, 7, {{0, false}, {9, false}});
}

// Any motion, and another one next to it.
State moved_state(const BeamSystem& system, double along) {
  State state = drawn_state(system);
  for (int i = 0; i < state.q.size(); ++i) {
    state.q[i] += 0.01 * std::sin(3.0 * i + 1) + along * std::sin(1.3 * i);
    state.v[i] = std::cos(5.0 * i) + along * std::cos(0.7 * i);
    state.a[i] = 3 * std::sin(2.0 * i);
  }
  return state;
}

class HeldExtremesOf : public ::testing::TestWithParam<std::pair<int, bool>> {};

TEST_P(HeldExtremesOf, AStateAreItsOwnAndChangeAsThese) {
  const auto [dimension, has_torsion] = GetParam();
  const BeamModel model = arc(dimension, has_torsion);
  const BeamSystem system(model, initial_plan(model));
  const HeldExtremes held(system, moved_state(system, 0), all_parts);
  const auto found = [&](double along) { return values_of(held.at(system, moved_state(system, along))[0]); };
  const auto own = [&](double along) {
    return values_of(record_beams(system, moved_state(system, along))[0]);
  };
  const auto rates = [&](const auto& of) {
    constexpr double h = 1e-7;
    const std::vector<double> more = of(h), less = of(-h);
    std::vector<double> all;
    for (std::size_t i = 0; i < more.size(); ++i) all.push_back((more[i] - less[i]) / (2 * h));
    return all;
  };
  const std::vector<double> value = own(0), same = found(0), rate = rates(own), held_rate = rates(found);
  for (std::size_t i = 0; i < all_parts.size(); ++i) {
    if (i >= 6 && !has_torsion) {
      EXPECT_TRUE(std::isnan(same[i])) << i;
      continue;
    }
    EXPECT_NE(value[i], 0) << i;
    EXPECT_NEAR(same[i], value[i], 1e-12 * std::abs(value[i])) << i;
    EXPECT_NE(rate[i], 0) << i;
    EXPECT_NEAR(held_rate[i], rate[i], 1e-6 * std::abs(rate[i])) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, HeldExtremesOf,
                         ::testing::Values(std::pair{2, false}, std::pair{3, false}, std::pair{3, true}));

// A straight bar that is drawn out evenly, then more on one side or on the other.
TEST(HeldExtremes, AreWhereverValuesAreEqual) {
  BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {2, 0, 0})}, 2,
                                      testing::round_bar(0.02, 7200, 2e8), 8, {{0, false}});
  const BeamSystem system(model, initial_plan(model));
  State even = drawn_state(system);
  even.q *= 1.01;
  const HeldExtremes held(system, even, {{0, &BeamRecord::axial_force_max}});
  const double tension = held.at(system, even)[0].axial_force_max.value;
  for (const int node : {1, 4, 7}) {
    State uneven = even;
    uneven.q[system.mesh().nodes[0][static_cast<std::size_t>(node)].r] += 1e-3;
    const double own = record_beams(system, uneven)[0].axial_force_max.value;
    EXPECT_GT(own, 1.1 * tension);
    EXPECT_NEAR(held.at(system, uneven)[0].axial_force_max.value, own, 1e-12 * own) << node;
  }
}

}  // namespace
}  // namespace nurbeam
