#include "fem/motion/remesh/transfer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "fem/system/material_points.h"
#include "solver/system/consistent.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;
using testing::line_cubic;
using testing::one_beam;
using testing::uneven_axis;

// Integrals over a beam by a rule fine enough that the quadrature does not show, from the fields at material
// points and no formula of the element.
struct Integrals {
  double mass = 0, kinetic = 0, axial = 0, bending = 0, length = 0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  double scale = 0;  // of the momentum: int rho A |v| ds
};

template <int D>
Integrals integrate(const BeamSystem& system, const State& state, std::vector<double> cuts) {
  constexpr int parts = 60;
  const Beam& beam = system.model().beams[0];
  Integrals sum;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c)
    for (int i = 0; i < parts; ++i)
      for (int g = 0; g < GaussRule::size; ++g) {
        const double width = (cuts[c + 1] - cuts[c]) / parts,
                     s = cuts[c] + width * (i + GaussRule::points[g]);
        const double w = width * GaussRule::weights[g];
        const MaterialPoint<3> p = material_point(system, state, 0, s);
        const int segment = beam.curve.segment_at(s);
        const double kappa0 = beam.curve.geometry(segment, beam.curve.parameter(segment, s)).curvature[0];
        const Eigen::Vector3d &rs = p.rs, &rss = p.rss, &v = p.velocity;
        const Eigen::Vector3d cross = rs.cross(rss);
        const double K = (D == 2 ? cross.z() : cross.norm()) / rs.squaredNorm();
        const double strain = (rs.squaredNorm() - 1) / 2;
        sum.mass += w * beam.properties.mass_per_length;
        sum.kinetic += w * beam.properties.mass_per_length * v.squaredNorm() / 2;
        sum.axial += w * beam.properties.axial_stiffness * strain * strain / 2;
        sum.bending += w * beam.properties.bending_stiffness * (K - kappa0) * (K - kappa0) / 2;
        sum.length += w * rs.norm();
        sum.momentum += w * beam.properties.mass_per_length * v;
        sum.scale += w * beam.properties.mass_per_length * v.norm();
      }
  return sum;
}

// Every place where a field or the drawing has a joint.
std::vector<double> all_cuts(const BeamSystem& system, const State& state) {
  const Beam& beam = system.model().beams[0];
  std::vector<double> cuts = beam.curve.breaks();
  for (const HomeNode& node : beam.home) cuts.push_back(node.s);
  cuts.push_back(*place(system, state, 0));
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < 1e-9; }),
             cuts.end());
  return cuts;
}

// A free beam with its joint between home nodes, and the plan without one more node.
template <int D>
struct SplitModel {
  BeamModel model;
  MeshPlan full, coarse;

  SplitModel(std::mt19937& random, bool moving, bool straight, AxialStrain strain) {
    BeamProperties properties(300, 2, 0.7, 0, {});
    properties.axial_strain = strain;
    model = one_beam(uneven_axis(random, D), D, properties, 8, {});
    if (straight) model.beams[0].curve = model.beams[0].curve.straightened();
    const auto& home = model.beams[0].home;
    testing::add_slider(model, 0.8, home[2].s + 0.3 * (home[3].s - home[2].s));
    full = initial_plan(model);
    full.beams[0].present.assign(home.size(), true);
    coarse = full;
    // Node 3 is beside the joint; node 6 lies between fixed ends of the second segment.
    coarse.beams[0].present[moving ? 3 : 6] = false;
  }
};

template <int D>
void check_split(bool moving, int seed) {
  std::mt19937 random(seed);
  const SplitModel<D> split(random, moving, D == 3, AxialStrain::pointwise);
  const BeamSystem from(split.model, split.coarse), to(split.model, split.full);
  const State before = disturbed_state(from, random);
  const State after = interpolated(from, before, to);
  const std::vector<double> cuts = all_cuts(from, before);
  for (int i = 0; i < 200; ++i) {
    const double s = split.model.beams[0].curve.length() * (i + 0.5) / 200;
    const MaterialPoint<3> p = material_point(from, before, 0, s), q = material_point(to, after, 0, s);
    EXPECT_LT((p.r - q.r).norm(), 1e-12);
    EXPECT_LT((p.velocity - q.velocity).norm(), 1e-12 * std::max(1.0, p.velocity.norm()));
  }
  const Integrals a = integrate<D>(from, before, cuts), b = integrate<D>(to, after, cuts);
  EXPECT_NEAR(b.mass, a.mass, 1e-12 * a.mass);
  EXPECT_NEAR(b.kinetic, a.kinetic, 1e-12 * a.kinetic);
  EXPECT_NEAR(b.axial, a.axial, 1e-12 * a.axial);
  EXPECT_NEAR(b.bending, a.bending, 1e-12 * a.bending);
  EXPECT_NEAR(b.length, a.length, 1e-12 * a.length);
  EXPECT_LT((b.momentum - a.momentum).norm(), 1e-12 * a.scale);
}

// With the pointwise strain: the node stays on the curve.
TEST(Split, OfAnElementWithFixedEndsChangesNothingInThePlane) { check_split<2>(false, 1); }
TEST(Split, OfAnElementWithFixedEndsChangesNothingInSpace) { check_split<3>(false, 2); }
TEST(Split, OfAnElementWithAMovingEndChangesNothingInThePlane) { check_split<2>(true, 3); }
TEST(Split, OfAnElementWithAMovingEndChangesNothingInSpace) { check_split<3>(true, 4); }

// With the assumed strain: both halves carry what the whole did.
template <int D>
void check_matched_split(bool moving, int seed) {
  std::mt19937 random(seed);
  const SplitModel<D> split(random, moving, D == 3, AxialStrain::ends_and_mean);
  const BeamSystem from(split.model, split.coarse), to(split.model, split.full);
  const State before = disturbed_state(from, random, 0.01);
  const State after = interpolated(from, before, to);
  const double axial = energy(from, before).axial;
  EXPECT_NEAR(energy(to, after).axial, axial, 1e-12 * axial);
  const auto carried = [&](const BeamSystem& system, const State& state, double s) {
    const int i = find_span(system.model(), system.mesh(), state.q, 0, s);
    const MeshSpan& span = system.mesh().spans[i];
    const double start = span.start(state.q);
    return assumed_strain(system, state, i)->at((s - start) / (span.end(state.q) - start));
  };
  double moved = 0;
  for (int i = 0; i < 200; ++i) {
    const double s = split.model.beams[0].curve.length() * (i + 0.5) / 200;
    EXPECT_NEAR(carried(to, after, s), carried(from, before, s), 1e-12);
    moved =
        std::max(moved, (material_point(from, before, 0, s).r - material_point(to, after, 0, s).r).norm());
  }
  EXPECT_GT(moved, 1e-9);  // there was something to match
  EXPECT_LT(moved, 5e-3);
}

TEST(MatchedSplit, OfAnElementWithFixedEndsKeepsItsAxialStrainInThePlane) {
  check_matched_split<2>(false, 21);
}
TEST(MatchedSplit, OfAnElementWithFixedEndsKeepsItsAxialStrainInSpace) { check_matched_split<3>(false, 22); }
TEST(MatchedSplit, OfAnElementWithAMovingEndKeepsItsAxialStrainInThePlane) {
  check_matched_split<2>(true, 23);
}
TEST(MatchedSplit, OfAnElementWithAMovingEndKeepsItsAxialStrainInSpace) { check_matched_split<3>(true, 24); }

// The change of momentum over a merge must come from the supports; a free beam has none.
template <int D>
void check_merge(bool moving, int seed) {
  std::mt19937 random(seed);
  const SplitModel<D> split(random, moving, D == 3, AxialStrain::ends_and_mean);
  const BeamSystem from(split.model, split.full), to(split.model, split.coarse);
  const State before = disturbed_state(from, random, 0.02);
  const std::optional<Transferred> after = projected(from, before, to);
  ASSERT_TRUE(after);
  const Integrals a = integrate<D>(from, before, all_cuts(from, before));
  const Integrals b = integrate<D>(to, after->state, all_cuts(from, before));
  Eigen::Vector3d body_change = Eigen::Vector3d::Zero();
  body_change.head<D>() =
      0.8 * (after->state.v.segment<D>(to.mesh().bodies[0]) - before.v.segment<D>(from.mesh().bodies[0]));
  // What is left is the quadrature of the mass.
  EXPECT_LT((b.momentum - a.momentum + body_change).norm(), 2e-6 * a.scale);
  EXPECT_GT((b.momentum - a.momentum).norm() + std::abs(b.kinetic - a.kinetic), 1e-6);  // something happened
}

TEST(Merge, OfAFreeBeamKeepsItsMomentumInThePlane) {
  check_merge<2>(false, 5);
  check_merge<2>(true, 6);
}
TEST(Merge, OfAFreeBeamKeepsItsMomentumInSpace) {
  check_merge<3>(false, 7);
  check_merge<3>(true, 8);
}

// A state on its constraints near the drawn shape.
State disturbed_within_constraints(const BeamSystem& system, std::mt19937& random, double amount) {
  State state = disturbed_state(system, random, amount);
  EXPECT_TRUE(close_constraints(system, 1e-13, state));
  EXPECT_EQ(project_velocities(system, state).status, ConsistencyStatus::done);
  return state;
}

// The home node before or after the joint goes, and the new element reaches to a place that is held.
void check_merge_beside(BeamModel model, int home, int direction, std::mt19937& random) {
  const auto& nodes = model.beams[0].home;
  model.riders.clear();
  testing::add_slider(model, 0.8, nodes[home].s - direction * 0.3 * (nodes[home + 1].s - nodes[home].s));
  MeshPlan full = initial_plan(model), coarse = full;
  full.beams[0].present.assign(nodes.size(), true);
  coarse.beams[0].present = full.beams[0].present;
  coarse.beams[0].present[home] = false;
  const BeamSystem from(model, full), to(model, coarse);
  const State before = disturbed_within_constraints(from, random, 0.01);
  const std::optional<Transferred> after = projected(from, before, to);
  ASSERT_TRUE(after);
  EXPECT_LT(open_constraints(to, after->state), 1e-11);
  const double old = energy(from, before).mechanical();
  EXPECT_NEAR(energy(to, after->state).mechanical(), old, 1e-8 * std::abs(old));
}

TEST(Merge, BesideJoinedBeamsOpensNoJoint) {
  std::mt19937 random(31);
  for (const int dimension : {2, 3}) {
    const BeamModel model = testing::joined_model(random, dimension);
    check_merge_beside(model, static_cast<int>(model.beams[0].home.size()) - 2, 1, random);
    check_merge_beside(model, 1, -1, random);
  }
}

TEST(Merge, BesideARigidCornerKeepsItsAngle) {
  std::mt19937 random(32);
  for (const int dimension : {2, 3}) {
    const BeamModel model = testing::cornered_model(random, dimension);
    const auto& home = model.beams[0].home;
    const auto corner = std::find_if(home.begin(), home.end(),
                                     [](const HomeNode& node) { return node.kind == NodeKind::rigid; });
    ASSERT_NE(corner, home.end());
    const int before = static_cast<int>(corner - home.begin()) - 1;
    check_merge_beside(model, before, 1, random);
    check_merge_beside(model, before + 2, -1, random);
  }
}

// Ten elements of 0.1 m, a break in the middle: home node 5.
BeamModel two_lines() {
  return one_beam({line_cubic({0, 0, 0}, {0.5, 0, 0}), line_cubic({0.5, 0, 0}, {1, 0, 0})}, 2,
                  {300, 2, 0.7, 0, {}}, 10, {});
}

// The plan after all changes due with the joint of a chain of two lines at s, moving with speed.
NextPlan settled(const BeamModel& model, MeshPlan plan, double s, double speed) {
  plan.places[0] = s;
  NextPlan last;
  last.plan = std::move(plan);
  while (true) {
    const BeamSystem system(model, last.plan);
    State state = drawn_state(system);
    state.v[system.mesh().riders[0].place] = speed;
    const NextPlan next = next_plan(system, state, LengthControl{});
    if (next.change == MeshChange::none) return last;
    last = next;
  }
}

TEST(PermanentNode, IsPassedAsAPointAndNeverRemoved) {
  BeamModel model = two_lines();
  for (const double speed : {1.0, -1.0}) {
    model.riders.clear();
    testing::add_slider(model, 0.8, 0.5 - speed * 0.15);
    MeshPlan plan = initial_plan(model);
    const auto mode_at = [&](double ahead) {
      plan = settled(model, plan, 0.5 + speed * ahead, speed).plan;
      EXPECT_TRUE(plan.beams[0].present[5]) << ahead;
      return plan.modes[0];
    };
    EXPECT_EQ(mode_at(-0.0055), Carried::node);
    EXPECT_EQ(mode_at(-0.0041), Carried::node);
    EXPECT_EQ(mode_at(-0.0039), Carried::point);
    EXPECT_EQ(mode_at(0.001), Carried::point);
    EXPECT_EQ(mode_at(0.0049), Carried::point);
    EXPECT_EQ(mode_at(0.0051), Carried::node);
  }
}

TEST(PermanentNode, MakesAPointOfAJointThatStartsOnIt) {
  BeamModel model = two_lines();
  testing::add_slider(model, 0.8, 0.5);
  EXPECT_EQ(initial_plan(model).modes[0], Carried::point);
  EXPECT_TRUE(initial_plan(model).beams[0].present[5]);
}

TEST(PermanentNode, GivesWayToAJointWhoseSlopeMayBeDiscontinuous) {
  BeamModel model = two_lines();
  testing::add_slider(model, 0.8, 0.35);
  model.riders[0].continuous_slope = false;
  MeshPlan plan = initial_plan(model);
  for (const auto& [s, present] : {std::pair{0.4955, true}, {0.4961, false}, {0.504, false}, {0.506, true}}) {
    plan = settled(model, plan, s, 1).plan;
    EXPECT_EQ(plan.modes[0], Carried::node) << s;
    EXPECT_EQ(plan.beams[0].present[5], present) << s;
  }
}

}  // namespace
}  // namespace nurbeam
