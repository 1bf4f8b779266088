#include "fem/constraints/kept_length.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::kept_length_test {

constexpr int slider = 0, load = 1;
constexpr double held_at = 0.9, length = 0.3;

enum class Between { body_and_body, beam_and_body, point_and_body, beam_and_point };
constexpr Between all_kinds[] = {Between::body_and_body, Between::beam_and_body, Between::point_and_body,
                                 Between::beam_and_point};

Eigen::Vector3d along(int dimension) {
  return Eigen::Vector3d(0.6, -0.7, dimension == 3 ? 0.4 : 0).normalized();
}

// A rod of a length that is not the drawn one; with a direction it keeps its part along that.
BeamSystem with_rod(int dimension, Between kind, bool directed) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  add_sliding(builder, beam, 0.4);
  builder.add_body("load", 2, {1, -0.6, dimension == 3 ? 0.3 : 0});
  const auto point = end_at({0.2, 0.9, 0});
  const auto from = kind == Between::body_and_body    ? end_on_body(slider)
                    : kind == Between::point_and_body ? point
                                                      : end_on_beam(beam, held_at);
  auto& rod =
      builder.connect(from, kind == Between::beam_and_point ? point : end_on_body(load), ConnectorType::rod);
  rod.length = length;
  if (directed) rod.direction = along(dimension);
  return BeamSystem(builder.build());
}

template <class Check>
void for_each_rod(const Check& check) {
  for (const Between kind : all_kinds)
    for (const bool directed : {false, true}) {
      check(with_rod(2, kind, directed), the_constraint<2, KeptLength<2>>, kind, directed);
      check(with_rod(3, kind, directed), the_constraint<3, KeptLength<3>>, kind, directed);
    }
}

// From the first end to the second.
Eigen::Vector3d line(const BeamSystem& system, const State& state) {
  const auto [from, to] = connector_ends(system, state, 0);
  return to - from;
}

TEST(KeptLength, IsTheLengthLessTheGivenOne) {
  for_each_rod([](const BeamSystem& system, const auto& rod_of, Between, bool directed) {
    std::mt19937 random(1);
    const auto rod = rod_of(system, 0);
    const State state = disturbed_state(system, random);
    const Eigen::Vector3d d = line(system, state);
    const double size = directed ? d.dot(along(system.dimension())) : d.norm();
    EXPECT_NEAR(rod.value(state)[0], size - length, 1e-13);
    const auto [found, force] = rod.constraint.length_and_force(state, Eigen::VectorXd::Constant(1, 3.1));
    EXPECT_NEAR(found, size, 1e-13);
    EXPECT_EQ(force, 3.1);
    EXPECT_EQ(rod.constraint.connector(), 0);
  });
}

// Where the ends are, by what they are fastened to.
TEST(KeptLength, IsBetweenWhatItIsFastenedTo) {
  std::mt19937 random(2);
  const AffineMap map = random_map(3, random);
  const auto length_of = [&](Between kind) {
    const BeamSystem system = with_rod(3, kind, false);
    return the_constraint<3, KeptLength<3>>(system).value(mapped_drawing(system, map))[0] + length;
  };
  const ReferenceCurve axis = bent_axis(3);
  const Eigen::Vector3d at_load = map({1, -0.6, 0.3}), point(0.2, 0.9, 0);
  EXPECT_NEAR(length_of(Between::body_and_body), (at_load - map(axis.position(0.4))).norm(), 1e-12);
  EXPECT_NEAR(length_of(Between::beam_and_body), (at_load - map(axis.position(held_at))).norm(), 1e-12);
  EXPECT_NEAR(length_of(Between::point_and_body), (at_load - point).norm(), 1e-12);
  EXPECT_NEAR(length_of(Between::beam_and_point), (map(axis.position(held_at)) - point).norm(), 1e-12);
}

TEST(KeptLength, HasTheDerivativesOfItsValue) {
  for_each_rod([](const BeamSystem& system, const auto& rod_of, Between, bool) {
    std::mt19937 random(3);
    expect_derivatives(rod_of(system, 0), disturbed_state(system, random), random);
  });
}

// A positive multiplier pulls them towards each other.
TEST(KeptLength, PullsItsEndsTogether) {
  for_each_rod([](const BeamSystem& system, const auto& rod_of, Between kind, bool directed) {
    std::mt19937 random(4);
    const auto rod = rod_of(system, 0);
    const int D = system.dimension();
    const State state = disturbed_state(system, random);
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 3.1), forces = rod.forces(state, y);
    const Eigen::Vector3d n = directed ? along(D) : line(system, state).normalized();
    const Eigen::VectorXd pull = 3.1 * n.head(D);
    const bool to_body = kind != Between::beam_and_point;
    expect_same(rod.constraint.on_body(load, state, y), to_body ? Eigen::VectorXd(-pull) : 0 * pull);
    expect_same(rod.constraint.on_body(slider, state, y),
                kind == Between::body_and_body ? pull : Eigen::VectorXd(0 * pull));
    if (to_body) expect_same(forces.segment(position_of(system, load), D), -pull);
    const bool inner = kind == Between::body_and_body || kind == Between::beam_and_body;
    const Resultant whole = resultant(system, state, forces);
    if (inner) EXPECT_LT(whole.force.norm(), 1e-9);
    if (inner && !directed) EXPECT_LT(whole.moment.norm(), 1e-9);
    if (kind == Between::point_and_body) expect_same(whole.force, -3.1 * n);
    if (kind == Between::beam_and_point) expect_same(whole.force, 3.1 * n);
  });
}

}  // namespace nurbeam::testing::kept_length_test
