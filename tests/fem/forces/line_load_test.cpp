#include "fem/forces/line_load.h"

#include <utility>

#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"

namespace nurbeam::testing::line_load_test {

const TimeTable ramp{{0, 0.5}, {1, 2}};
Eigen::Vector3d value(int dimension) { return {1, -2, dimension == 3 ? 0.7 : 0}; }

BeamSystem loaded(int dimension, bool loads) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  builder.add_beam(ReferenceCurve({going_on(dimension)}, dimension), BeamProperties(300, 2, 0.7), {4});
  if (loads) builder.add(LineLoad{beam, value(dimension), ramp});
  return BeamSystem(builder.build());
}

// The integral of the axis over its length, by Simpson's rule.
Eigen::Vector3d integral_of(const ReferenceCurve& curve) {
  constexpr int parts = 400;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i <= parts; ++i)
    sum += (i % parts == 0 ? 1 : i % 2 ? 4 : 2) * curve.position(curve.length() * i / parts);
  return curve.length() / (3 * parts) * sum;
}

TEST(LineLoad, IsOnItsBeamAloneWithItsFactorOfTime) {
  const LineLoad load{1, {1, 2, 3}, ramp};
  EXPECT_EQ(load.per_length(0, 0.5), Eigen::Vector3d::Zero());
  EXPECT_LT((load.per_length(1, 0.5) - 1.25 * Eigen::Vector3d(1, 2, 3)).norm(), 1e-15);
}

// What it adds to the residual of the whole system, on an image of the drawing.
template <int D>
void check_resultant() {
  std::mt19937 random(1);
  const BeamSystem with = loaded(D, true), without = loaded(D, false);
  const AffineMap map = random_map(D, random, 0.1);
  State state = mapped_drawing(with, map);
  state.t = 0.2;
  state.load = 0.6;
  const auto dynamics = [&](const BeamSystem& system) {
    Eigen::VectorXd rows(system.coordinate_count()), none(0);
    system.residual(state, rows, none);
    return rows;
  };
  const ReferenceCurve& curve = with.model().beams[0].curve;
  const Eigen::Vector3d f = 0.6 * (0.5 + 0.2 * 1.5) * value(D);
  const Resultant on_beam = resultant(with, state, dynamics(without) - dynamics(with));
  expect_same(on_beam.force, curve.length() * f, 1e-7);
  expect_same(on_beam.moment, (map.F * integral_of(curve) + curve.length() * map.c).cross(f), 1e-7);
}
TEST(LineLoad, IsSpreadOverTheDrawnLength) {
  check_resultant<2>();
  check_resultant<3>();
}

template <int D>
void check_work() {
  std::mt19937 random(2);
  const BeamSystem system = loaded(D, true);
  const auto load = the_force<D, LineLoad>(system);
  const AffineMap first = random_map(D, random), last = random_map(D, random);
  State from = mapped_drawing(system, first), to = mapped_drawing(system, last);
  from.t = 0.2;
  to.t = 0.6;
  const ReferenceCurve& curve = system.model().beams[0].curve;
  const Eigen::Vector3d moved = (last.F - first.F) * integral_of(curve) + curve.length() * (last.c - first.c);
  EXPECT_NEAR(load.work(from, to), (0.8 + 1.4) / 2 * value(D).dot(moved), 1e-7);
}
TEST(LineLoad, DoesItsWorkOnWhatTheBeamMoves) {
  check_work<2>();
  check_work<3>();
}

// The uneven part of a load is forces at places: to the last bit what point loads give.
template <int D>
void check_shares() {
  std::mt19937 random(3);
  const Eigen::Vector3d f = value(D);
  const auto system = [&](bool as_shares) {
    ModelBuilder builder(D);
    const int beam = add_bent_beam(builder, D);
    LineLoad load{beam, f, ramp, 0.9};
    if (as_shares) load.uneven = {{0.3, 0.2}, {0.8, -0.05}};
    builder.add(load);
    if (!as_shares)
      for (const auto& [s, length] : {std::pair{0.3, 0.2}, {0.8, -0.05}})
        builder.add(PointLoad{{.beam = beam, .s = s, .value = length * f, .time = ramp}});
    return BeamSystem(builder.build());
  };
  const BeamSystem shares = system(true), points = system(false);
  const AffineMap map = random_map(D, random, 0.1), later = random_map(D, random, 0.1);
  State from = mapped_drawing(shares, map), to = mapped_drawing(shares, later);
  from.t = 0.2;
  to.t = 0.6;
  const auto dynamics = [&](const BeamSystem& of) {
    Eigen::VectorXd rows(of.coordinate_count()), none(0);
    of.residual(from, rows, none);
    return rows;
  };
  EXPECT_LT((dynamics(shares) - dynamics(points)).norm(), 1e-13);
  EXPECT_NEAR(load_work(shares, from, to), load_work(points, from, to), 1e-12);
  const auto actions = [&](const BeamSystem& of) {
    return with_assembly(of, [&](const auto& a) { return a.actions(from); });
  };
  ASSERT_EQ(actions(shares).size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_LT((actions(shares)[i].force - actions(points)[i].force).norm(), 1e-15);
}
TEST(LineLoad, HasAnUnevenPartOfForcesAtPlaces) {
  check_shares<2>();
  check_shares<3>();
}

}  // namespace nurbeam::testing::line_load_test
