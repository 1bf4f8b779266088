#include <gtest/gtest.h>

#include <random>

#include "fem/system/assembly.h"
#include "fem/system/material_points.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

// The sums over series in the places of the ends are the witness.
template <int D>
void check_spans(int seed) {
  using Layout = ElementLayout<D>;
  std::mt19937 random(seed);
  BeamModel model =
      testing::one_beam(testing::uneven_axis(random, D), D, {300, 2, 0.7, 0, {}}, 8, {{0, true}});
  testing::add_slider(model, 0.8, 0.4 * model.beams[0].curve.length());
  const BeamSystem system(model);
  const State first = testing::disturbed_state(system, random),
              state = testing::disturbed_state(system, random);
  const auto& elements = system.assembly<D>()->elements();
  for (int i = 0; i < static_cast<int>(elements.size()); ++i) {
    const StrainIntegral found = SpanStrain(system, first, i).at(state);
    const AxialSums<D> sums = elements[i].element.axial_sums(gather<D>(elements[i], state.q));
    EXPECT_NEAR(found.value, sums.y[0], 1e-14);
    for (const int end : {0, 1}) {
      const auto part = [&](int of) { return sums.y_q.template block<1, D>(0, of).transpose(); };
      EXPECT_LT((found.by_position[end].head(D) - part(Layout::r(end))).norm(), 1e-12);
      EXPECT_LT((found.by_slope[end].head(D) - part(Layout::slope(end))).norm(), 1e-13);
    }
  }
}

TEST(SpanStrain, IsTheIntegralOfTheAxialStrainInThePlane) { check_spans<2>(1); }
TEST(SpanStrain, IsTheIntegralOfTheAxialStrainInSpace) { check_spans<3>(2); }

// What is found for places of the ends holds for all states that have them.
template <int D>
void check_points(int seed) {
  std::mt19937 random(seed);
  BeamModel model =
      testing::one_beam(testing::uneven_axis(random, D), D, {300, 2, 0.7, 0.01, {}}, 8, {{0, true}});
  testing::add_slider(model, 0.8, 0.4 * model.beams[0].curve.length());
  const BeamSystem system(model);
  const State first = testing::disturbed_state(system, random),
              state = testing::disturbed_state(system, random);
  int moving = 0;
  for (const MeshElement<D>& e : system.assembly<D>()->elements()) {
    if (e.element.fixed()) continue;
    ++moving;
    const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::Constant(0.3);
    const ElementState<D> x = gather<D>(e, state);
    EXPECT_EQ(e.element.force(x, load, e.element.points(gather<D>(e, first.q))), e.element.force(x, load));
  }
  EXPECT_EQ(moving, 2);
}

TEST(PointsOfAMovingElement, HoldForAllStatesWithItsEndsInThePlane) { check_points<2>(3); }
TEST(PointsOfAMovingElement, HoldForAllStatesWithItsEndsInSpace) { check_points<3>(4); }

}  // namespace
}  // namespace nurbeam
