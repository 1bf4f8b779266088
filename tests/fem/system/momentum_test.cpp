#include "fem/system/momentum.h"

#include <gtest/gtest.h>

#include <memory>

#include "fem/motion/remesh/transfer.h"
#include "solver/system/tangent_matrix.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;
using testing::one_beam;
using testing::uneven_axis;

BeamModel clamped_beam_of_twelve(std::mt19937& random, int dimension) {
  return one_beam(uneven_axis(random, dimension), dimension, {300, 2, 0.7, 0.02, {}}, 12, {{0, true}});
}

Eigen::MatrixXd block_of_coordinates(const BeamSystem& system, const State& state, const TangentWeights& w) {
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, w);
  const int n = system.coordinate_count();
  return Eigen::MatrixXd(kkt).topLeftCorner(n, n);
}

// Of fixed elements, of those beside a body, which move over the material, and of the body.
TEST(CarriedMomentum, OntoItsOwnMeshIsTheMassMatrixTimesTheVelocity) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(60 + dimension);
    BeamModel model = clamped_beam_of_twelve(random, dimension);
    testing::add_slider(model, 0.8, 0.37 * model.beams[0].curve.length());
    const BeamSystem system(model), again(model);
    const State state = disturbed_state(system, random, 0.01);
    const Eigen::VectorXd expected = block_of_coordinates(system, state, {.mass = 1}) * state.v;
    const Eigen::VectorXd p = CarriedMomentum(system, state, again).on(state);
    EXPECT_LT((p - expected).norm(), 1e-13 * expected.norm()) << dimension;
  }
}

// A body that becomes a node does so where it is, wherever the mesh was planned for it.
TEST(BecomingANode, IsThatOfTheMeshPlannedForThePlace) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(70 + dimension);
    BeamModel model = clamped_beam_of_twelve(random, dimension);
    const double L = model.beams[0].curve.length(), s = 0.41 * L;
    testing::add_slider(model, 0.8, s);
    const auto shared = std::make_shared<const BeamModel>(model);
    MeshPlan as_point = initial_plan(model), planned = as_point, planned_elsewhere = as_point;
    as_point.beams[0].present.assign(as_point.beams[0].present.size(), true);
    as_point.modes[0] = Carried::point;
    planned_elsewhere.places[0] = s - 0.004 * L;
    const BeamSystem from(shared, as_point), to(shared, planned), elsewhere(shared, planned_elsewhere);
    const State state = disturbed_state(from, random, 0.001);
    const State expected = interpolated(from, state, to), found = interpolated(from, state, elsewhere);
    EXPECT_LT((found.q - expected.q).norm(), 1e-12 * expected.q.norm()) << dimension;
    EXPECT_LT((found.v - expected.v).norm(), 1e-12 * expected.v.norm()) << dimension;
    const Eigen::VectorXd p = CarriedMomentum(from, state, to).on(expected);
    EXPECT_LT((CarriedMomentum(from, state, elsewhere).on(expected) - p).norm(), 1e-12 * p.norm())
        << dimension;
  }
}

TEST(ConstantInertia, IsToldOfBeamsWhoseMassNeverChanges) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(80 + dimension);
    BeamModel model = clamped_beam_of_twelve(random, dimension);
    model.beams[0].properties.damping = 0;
    model.forces.push_back(PointLoad{{.s = 0.3, .value = {0, -1, 0}}});
    const BeamSystem still(model);
    ASSERT_TRUE(still.has_constant_inertia());
    const State one = disturbed_state(still, random, 0.01), other = disturbed_state(still, random, 0.01);
    EXPECT_EQ(block_of_coordinates(still, one, {.mass = 1}), block_of_coordinates(still, other, {.mass = 1}));
    EXPECT_TRUE(block_of_coordinates(still, one, {.damping = 1}).isZero(0));

    BeamModel damped = model;
    damped.beams[0].properties.mass_damping = 0.1;
    EXPECT_FALSE(BeamSystem(damped).has_constant_inertia());
    testing::add_slider(model, 0.8, 0.37 * model.beams[0].curve.length());
    EXPECT_FALSE(BeamSystem(model).has_constant_inertia());
  }
}

}  // namespace
}  // namespace nurbeam
