// Torsion in whole models: rings, chains, corners, joints and forks.

#include <gtest/gtest.h>

#include <numbers>

#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "fem/system/stress_resultants.h"
#include "solver/rest/static_equilibrium.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::arc_cubics;
using testing::line_cubic;
using testing::torsion_model;
using testing::uneven_axis;
using testing::with_corner;
using testing::with_sections;

/// Norms of the dynamics and of the constraints.
Eigen::Vector2d imbalance(const BeamSystem& system, const State& state) {
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  system.residual(state, dynamics, constraints);
  return {dynamics.norm(), constraints.norm()};
}

void expect_free_of_stress(const BeamModel& model) {
  const BeamSystem system(model);
  const State state = drawn_state(system);
  const SystemEnergy drawn = energy(system, state);
  EXPECT_LT(imbalance(system, state).maxCoeff(), 1e-10);
  EXPECT_LT(drawn.axial + drawn.bending + drawn.torsion, 1e-24);
}

RationalCubic cubic(const std::array<Vector3d, 4>& P) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << P[i], 1;
  return RationalCubic(points);
}

TEST(Torsion, LeavesARingFreeOfStressWhoseFrameComesBackTurned) {
  const Vector3d a(0, 0, 0), b(1, 0.5, 0.3), along_a(0, -0.8, 0.5), along_b(0.2, 0.9, 0.4);
  const ReferenceCurve curve(
      {cubic({a, a + along_a, b - along_b, b}), cubic({b, b + along_b, a - along_a, a})}, 3,
      Metric::arc_length, true);
  ModelBuilder builder(3);
  builder.add_beam(curve, with_sections(), {8});
  const BeamModel model = builder.build();
  EXPECT_GT(std::abs(model.beams[0].curve.holonomy()), 0.1);
  expect_free_of_stress(model);
  // Every element has its own bubble and every node its angle, the seam's one.
  EXPECT_EQ(BeamSystem(model).coordinate_count(), 8 * 8);
}

TEST(Torsion, LeavesAChainOfUnlikeSegmentsWithACornerFreeOfStress) {
  std::vector<RationalCubic> chain{line_cubic({0, -1, 0}, {1, -1, 0})};
  for (const RationalCubic& arc : arc_cubics({1, 0, 0}, 1, -pi / 2, 0, 1)) chain.push_back(arc);
  chain.push_back(line_cubic({2, 0, 0}, {2, 0, 1}));
  const ReferenceCurve curve(chain, 3);
  for (const Orientation::Rule rule : {Orientation::Rule::start, Orientation::Rule::up}) {
    ModelBuilder builder(3);
    builder.add_beam(curve.oriented({rule, {0.3, 1, 0.5}, {{0, 0}, {curve.length(), 2}}}), with_sections(),
                     {8});
    BeamModel model = builder.clamp(0, 0).build();
    model.beams[0].home[model.beams[0].home_at(curve.breaks()[2])].kind = NodeKind::rigid;
    expect_free_of_stress(model);
  }
}

Vector3d tip_at_rest(const BeamModel& model, int beam) {
  const BeamSystem system(model);
  State state = drawn_state(system);
  EXPECT_EQ(find_static_equilibrium(StaticEquilibrium{}, system, state).status, StaticStatus::converged);
  return material_point(system, state, beam, model.beams[beam].curve.length()).r;
}

// A corner carries what a rigid joint of two beams does: moments about all axes.
TEST(Torsion, CarriesMomentsOverACornerAsOverARigidJoint) {
  std::mt19937 random(5);
  const std::vector<RationalCubic> column = uneven_axis(random, 3);
  const std::vector<RationalCubic> whole = with_corner(column, 1.2, uneven_axis(random, 3), 3);
  const ReferenceCurve curve = ReferenceCurve(whole, 3).oriented({Orientation::Rule::up, {0.2, 0.3, 1}, {}});
  const double corner = curve.breaks()[2];
  ModelBuilder cornered(3), joined(3);
  cornered.add_beam(curve, with_sections(), {12});
  BeamModel one = cornered.clamp(0, 0).force(0, curve.length(), {0.1, 0.3, 0.2}).build();
  one.beams[0].home[one.beams[0].home_at(corner)].kind = NodeKind::rigid;
  const auto part = [&](std::size_t from, std::size_t to) {
    return ReferenceCurve({whole.begin() + static_cast<long>(from), whole.begin() + static_cast<long>(to)}, 3)
        .oriented({Orientation::Rule::up, {0.2, 0.3, 1}, {}});
  };
  joined.add_beam(part(0, 2), with_sections(), {6});
  joined.add_beam(part(2, 4), with_sections(), {6});
  joined.clamp(0, 0).join(0, corner, 1, 0, true).force(1, curve.length() - corner, {0.1, 0.3, 0.2});
  const BeamModel two = joined.build();
  int parts = 0;
  for (const HomeNode& node : one.beams[0].home) parts += node.s < corner - 1e-9;
  ASSERT_EQ(parts, 6);  // the same mesh
  EXPECT_LT((tip_at_rest(one, 0) - tip_at_rest(two, 1)).norm(), 1e-9);
  EXPECT_GT((tip_at_rest(one, 0) - curve.position(curve.length())).norm(), 0.1);
}

// A torque on the middle of a rod whose ends cannot roll: both halves take one half.
TEST(Torsion, IsTakenByForks) {
  BeamProperties properties = with_sections(0);
  properties.sections->bending_product = 0;
  ModelBuilder builder(3);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3), properties, {4});
  builder.fork(0, 0).fork(0, 2).moment(0, 1, {0.3, 0, 0});
  const BeamSystem system(builder.build());
  State state = drawn_state(system);
  ASSERT_EQ(find_static_equilibrium(StaticEquilibrium{}, system, state).status, StaticStatus::converged);
  const double angle = 0.15 * 1 / properties.sections->torsion;
  const SectionPoint middle = section_point(system, state, 0, 1);
  EXPECT_NEAR(std::atan2(-middle.triad.d2.y(), middle.triad.d2.z()), angle, 1e-9);
  EXPECT_NEAR(section_point(system, state, 0, 0.4).moments.torque, 0.15, 1e-9);
  EXPECT_NEAR(section_point(system, state, 0, 1.7).moments.torque, -0.15, 1e-9);
  for (const int support : {0, 1})
    EXPECT_LT((reaction(system, state, state.lambda, support).couple - Vector3d(-0.15, 0, 0)).norm(), 1e-9);
}

// Reactions and stress resultants balance the loads, at nodes to round-off: forces and couples of every kind.
TEST(Torsion, IsInBalanceWithItsLoads) {
  std::mt19937 random(8);
  const ReferenceCurve curve = ReferenceCurve(uneven_axis(random, 3), 3)
                                   .oriented({Orientation::Rule::start, {0.1, 0.3, 1}, {{0, 0}, {2, 3}}});
  const double L = curve.length(), inside = 0.37 * L;
  const Vector3d F(0.1, 0.3, 0.2), M(0.2, -0.1, 0.15), inner(0.1, 0.2, -0.1);
  ModelBuilder builder(3);
  builder.add_beam(curve, with_sections(0), {6});
  builder.clamp(0, 0).force(0, L, F).moment(0, L, M).moment(0, inside, inner);
  const BeamSystem system(builder.build());
  State state = drawn_state(system);
  ASSERT_EQ(find_static_equilibrium(StaticEquilibrium{}, system, state).status, StaticStatus::converged);
  const Vector3d tip = material_point(system, state, 0, L).r;
  const auto couple_beyond = [&](double s) -> Vector3d {
    return (tip - material_point(system, state, 0, s).r).cross(F) + M +
           (s < inside ? inner : Vector3d::Zero());
  };
  const auto at_clamp = reaction(system, state, state.lambda, 0);
  EXPECT_LT((at_clamp.force + F).norm(), 1e-9);
  EXPECT_LT((at_clamp.couple + couple_beyond(0)).norm(), 1e-9);
  const CarriedBySpans carried(system, state);
  for (int i = 0; i < static_cast<int>(system.mesh().spans.size()); ++i) {
    const MeshSpan& span = system.mesh().spans[i];
    for (const double s : {span.s_a, span.s_b, 0.5 * (span.s_a + span.s_b)}) {
      const bool at_node = s == span.s_a || s == span.s_b;
      const MaterialPoint<3> p = material_point_in(system, state, i, s);
      const Vector3d couple = carried[i].at(s, p.r, p.rs).couple;
      EXPECT_LT((couple - couple_beyond(s)).norm(), at_node ? 1e-9 : 1e-3) << s;
    }
  }
  // The torque of a record is that couple's part along the tangent; the section's own approaches it.
  const ElementRecord record = record_element(system, state, 3, carried[3]);
  const MaterialPoint<3> first = material_point_in(system, state, 3, record.s_start);
  EXPECT_NEAR(record.torque[0], couple_beyond(record.s_start).dot(first.rs.normalized()), 1e-9);
  EXPECT_NEAR(
      record.torque[1],
      section_point(system, state, 0, record.s_start + (record.s_end - record.s_start) / 3).moments.torque,
      1e-2);
}

TEST(Torsion, OfAModelIsRefusedWhereItMeansNothing) {
  ModelBuilder plane(2);
  EXPECT_THROW(plane.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2), with_sections()),
               std::invalid_argument);
  ModelBuilder space(3);
  space.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3), with_sections());
  space.add_beam(ReferenceCurve({line_cubic({0, 1, 0}, {2, 1, 0})}, 3), BeamProperties{300, 2, 0.7});
  EXPECT_THROW(space.fork(1, 0), std::invalid_argument);
  Rider& joint = space.slide(space.add_body("bead", 1), 0, 1);
  EXPECT_NO_THROW(space.build());
  joint.follows_section = true;
  EXPECT_NO_THROW(space.build());
  joint.continuous_slope = false;
  EXPECT_THROW(space.build(), std::invalid_argument);
  joint.follows_section = false;
  EXPECT_NO_THROW(space.build());
}

}  // namespace
}  // namespace nurbeam
