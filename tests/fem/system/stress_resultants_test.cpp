#include "fem/system/stress_resultants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "fem/motion/run/simulation.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"
#include "tests/fem/random_models.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::line_cubic;

Snapshot at_rest(const BeamModel& model, const std::vector<ProbePlace>& probes = {}) {
  std::optional<Snapshot> last;
  const SimulationReport report =
      simulate(model, probes, {.statics = true}, {.snapshot = [&](const Snapshot& frame) { last = frame; }});
  EXPECT_EQ(report.status, SimulationStatus::done);
  return last.value();
}

// A stiff straight cantilever of 2 m along x, which small loads hardly bend.
ModelBuilder cantilever(int dimension, int elements, double EI = 1e6) {
  ModelBuilder builder(dimension);
  const int beam = builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, dimension),
                                    BeamProperties{1e3 * EI, EI, 1}, {elements});
  builder.clamp(beam, 0);
  return builder;
}

double place(const ElementRecord& e, int sample) { return e.s_start + (e.s_end - e.s_start) * sample / 3; }

TEST(StressResultants, AreExactUnderAConstantLoadWithAnyMesh) {
  for (const int elements : {1, 2, 5}) {
    ModelBuilder builder = cantilever(2, elements);
    builder.add(LineLoad{0, {0, -3, 0}});
    const Snapshot rest = at_rest(builder.build());
    for (const ElementRecord& e : rest.beams[0].elements)
      for (int i = 0; i < 4; ++i) {
        const double left = 2 - place(e, i);
        EXPECT_NEAR(e.bending_moment[i], -3 * left * left / 2, 1e-5) << elements;
        EXPECT_NEAR(e.shear_force[i], -3 * left, 1e-5) << elements;
      }
  }
}

TEST(StressResultants, HaveTheKinkOfAForceInsideAnElement) {
  ModelBuilder builder = cantilever(2, 3);
  builder.force(0, 0.9, {0, 5, 0});
  builder.moment(0, 1.7, {0, 0, 2});
  for (const double s : {0.0, 0.5, 0.85, 0.95, 1.2, 1.6, 1.8, 2.0}) {
    const Snapshot rest = at_rest(builder.build(), {{0, s}});
    const double moment = (s < 0.9 ? 5 * (0.9 - s) : 0) + (s < 1.7 ? 2 : 0);
    EXPECT_NEAR(rest.probes[0].section.bending_moment, moment, 1e-4) << s;
    EXPECT_NEAR(rest.probes[0].section.shear_force, s < 0.9 ? 5 : 0, 1e-4) << s;
  }
}

// Largest difference of a quantity at places that are nodes of no mesh, between two meshes.
double largest_difference(const Snapshot& a, const Snapshot& b, double SectionRecord::*quantity) {
  double largest = 0;
  for (std::size_t i = 0; i < a.probes.size(); ++i)
    largest = std::max(largest, std::abs(a.probes[i].section.*quantity - b.probes[i].section.*quantity));
  return largest;
}

// At rest, with probes all along it, a beam with so many elements: moments of fourth order, shear forces,
// which between nodes are their derivative, of third.
template <class Build>
void expect_orders(Build build, double accurate) {
  const auto at = [&](int elements) {
    const BeamModel model = build(elements);
    const double L = model.beams[0].curve.length();
    return at_rest(model, {{0, 0}, {0, 0.123 * L}, {0, 0.477 * L}, {0, 0.71 * L}, {0, 0.94 * L}});
  };
  const Snapshot truth = at(128), coarse = at(8), fine = at(16);
  for (const auto& [quantity, order] :
       {std::pair{&SectionRecord::bending_moment, 4.0}, {&SectionRecord::shear_force, 3.0}}) {
    const double first = largest_difference(coarse, truth, quantity),
                 second = largest_difference(fine, truth, quantity);
    EXPECT_LT(second, accurate);
    EXPECT_GT(std::log2(first / second), order - 0.5) << first << " " << second;
  }
}

TEST(StressResultants, ConvergeWhereABeamBendsFar) {
  for (const int dimension : {2, 3})
    expect_orders(
        [&](int elements) {
          ModelBuilder builder = cantilever(dimension, elements, 1);
          builder.force(0, 2, {0, -5.0 / 4, 0}).add(LineLoad{0, {0.3, 0.4, 0}});
          return builder.build();
        },
        1e-5);
}

TEST(StressResultants, OfADrawnArchConverge) {
  expect_orders(
      [](int elements) {
        ModelBuilder builder(2);
        const ReferenceCurve arc(testing::arc_cubics({0, 0, 0}, 1, 0, std::numbers::pi / 2, 1), 2);
        builder.add_beam(arc, BeamProperties{1e4, 1, 1}, {elements});
        builder.clamp(0, 0).force(0, arc.length(), {1, -0.6, 0}).force(0, 0.625 * arc.length(), {0, 0.8, 0});
        return builder.build();
      },
      1e-5);
}

TEST(Reactions, BalanceLoadsAtRest) {
  std::mt19937 random(7);
  for (const int dimension : {2, 3})
    for (int trial = 0; trial < 4; ++trial) {
      BeamModel model = testing::one_beam(testing::uneven_axis(random, dimension), dimension,
                                          BeamProperties{3e4, 20, 0.7}, 8, {{0, true}, {1.4, false}});
      const double L = model.beams[0].curve.length();
      const Eigen::Vector3d F(1, -2, dimension == 3 ? 0.7 : 0), q(0.4, 0.3, 0);
      model.forces = {PointLoad{{0, 0.9 * L, 0, F, false, {}}}, LineLoad{0, q}};
      const Snapshot rest = at_rest(model);
      const Eigen::Vector3d load = F + L * q + 0.7 * L * model.gravity;
      Eigen::Vector3d sum = load;
      for (const ReactionRecord& reaction : rest.reactions) sum += reaction.force;
      EXPECT_LT(sum.norm(), 1e-8 * load.norm()) << dimension << " " << trial;
    }
}

TEST(Reactions, OfAClampAreForceAndCouple) {
  for (const int dimension : {2, 3}) {
    ModelBuilder builder = cantilever(dimension, 4);
    const Eigen::Vector3d F(0, -5, dimension == 3 ? 2 : 0);
    builder.force(0, 2, F);
    const Snapshot rest = at_rest(builder.build(), {{0, 2}});
    const ReactionRecord& clamp = rest.reactions.at(0);
    EXPECT_LT((clamp.force + F).norm(), 1e-7);
    EXPECT_LT((clamp.couple + rest.probes[0].position.cross(F)).norm(), 1e-5);
  }
}

// A body that slides over a disturbed beam in motion, with accelerations and multipliers that belong to it.
struct SlidingMass {
  BeamSystem system;
  State state;
};
SlidingMass sliding(std::mt19937& random, int dimension) {
  BeamModel model = testing::one_beam(testing::uneven_axis(random, dimension), dimension,
                                      BeamProperties{300, 2, 0.7, 0.02}, 8, {{0, true}, {9, false}});
  testing::add_slider(model, 0.8, 0.4 * model.beams[0].curve.length());
  SlidingMass at{BeamSystem(model), {}};
  at.state = testing::disturbed_state(at.system, random, 0.01);
  EXPECT_EQ(project_velocities(at.system, at.state).status, ConsistencyStatus::done);
  EXPECT_EQ(make_accelerations_consistent(at.system, at.state), ConsistencyStatus::done);
  return at;
}

TEST(Reactions, BalanceWeightAndInertiaInMotion) {
  std::mt19937 random(11);
  for (const int dimension : {2, 3}) {
    const auto [system, state] = sliding(random, dimension);
    const auto momentum_after = [&](double h) {
      State later = state;
      later.q += h * state.v + h * h / 2 * state.a;
      later.v += h * state.a;
      return momentum(system, later);
    };
    Eigen::Vector3d given = (0.8 + 0.7 * system.model().beams[0].curve.length()) * system.model().gravity;
    for (int i = 0; i < 2; ++i) given += reaction(system, state, state.lambda, i).force;
    const auto error = [&](double h) {
      return ((momentum_after(h) - momentum_after(-h)) / (2 * h) - given).norm() / given.norm();
    };
    EXPECT_LT(error(1e-4), 1e-4) << dimension;
    EXPECT_NEAR(error(2e-4) / error(1e-4), 4, 0.5) << dimension;
  }
}

TEST(StressResultants, JumpByTheForceOfABodyThatSlidesOverItsNode) {
  std::mt19937 random(12);
  for (const int dimension : {2, 3}) {
    const auto [system, state] = sliding(random, dimension);
    const double s = *place(system, state, 0);
    const int right = find_span(system.model(), system.mesh(), state.q, 0, s);
    const CarriedBySpans carried(system, state);
    const MaterialPoint<3> p = material_point_in(system, state, right, s);
    const StressResultants before = carried[right - 1].at(s, p.r, p.rs),
                           after = carried[right].at(s, p.r, p.rs);
    const Eigen::Vector3d t = p.rs.normalized(), force = joint_force(system, state, 0);
    const Eigen::Vector3d across = force - force.dot(t) * t;
    EXPECT_LT((after.force - before.force - across).norm(), 1e-8 * force.norm()) << dimension;
    EXPECT_LT((after.couple - before.couple).norm(), 1e-8 * (before.couple.norm() + force.norm()));
  }
}

// A free straight beam flies sideways while a body runs along it: nothing is stressed, whatever momentum
// flows over the node that slides.
TEST(StressResultants, VanishInABeamThatFliesFreelyUnderASlidingNode) {
  const Eigen::Vector2d flight(0, 3);
  const double speed = 2;
  ModelBuilder builder(2);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {4, 0, 0})}, 2), BeamProperties{1e4, 5, 0.6}, {8});
  builder.slide(builder.add_body("bead", 1.5), 0, 1.1);
  const BeamSystem system(builder.build());
  State state = drawn_state(system);
  for (const MeshNode& node : system.mesh().nodes[0]) {
    state.v.segment<2>(node.r) = flight;
    if (node.place < 0) continue;
    state.v[node.place] = speed;
    state.v[node.r] += speed;
  }
  const CarriedBySpans spans(system, state);
  for (int i = 0; i < static_cast<int>(system.mesh().spans.size()); ++i)
    for (const double s : {0.3, 1.1, 2.6}) {
      const StressResultants carried = spans[i].at(s, {s, 0, 0}, Eigen::Vector3d::UnitX());
      EXPECT_LT(carried.force.norm(), 1e-12);
      EXPECT_LT(carried.couple.norm(), 1e-12);
    }
}

}  // namespace
}  // namespace nurbeam
