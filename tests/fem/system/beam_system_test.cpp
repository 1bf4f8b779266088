#include "fem/system/beam_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "fem/system/material_points.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"
#include "solver/system/tangent_rows.h"
#include "tests/fem/axial_laws.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using testing::add_slider;
using testing::cornered_model;
using testing::disturbed_state;
using testing::joined_model;
using testing::line_cubic;
using testing::model_with_everything;
using testing::one_beam;
using testing::other_laws;
using testing::torsion_model;
using testing::torsion_sliding_model;
using testing::uneven_axis;
using testing::with_law;

Eigen::VectorXd random_vector(Eigen::Index size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return unit(random); });
}

Eigen::VectorXd residual(const BeamSystem& system, const State& state) {
  const int n = system.coordinate_count(), m = system.constraint_count();
  Eigen::VectorXd dynamics(n), constraints(m), both(n + m);
  system.residual(state, dynamics, constraints);
  both << dynamics, constraints;
  return both;
}

Eigen::SparseMatrix<double> tangent(const BeamSystem& system, const State& state, const TangentWeights& w) {
  return tangent_matrix(system, state, w);
}

// The state moved by h along a direction of (q, v, a, lambda).
State moved(State state, const State& direction, double h) {
  state.q += h * direction.q;
  state.v += h * direction.v;
  state.a += h * direction.a;
  state.lambda += h * direction.lambda;
  return state;
}

// Central differences of f about 0 with steps h and h/2: their distance to the derivative must be small, or
// fall with the square of the step.
template <class F>
void expect_second_order(const F& f, const Eigen::VectorXd& derivative, double h) {
  const auto error = [&](double step) { return ((f(step) - f(-step)) / (2 * step) - derivative).norm(); };
  const double coarse = error(h), fine = error(h / 2);
  EXPECT_LT(coarse, 0.02 * derivative.norm());
  EXPECT_NEAR(coarse / fine, 4, 0.25) << coarse << " " << fine;
}

void expect_tangent(const BeamSystem& system, const State& state, std::mt19937& random, double step = 5e-4) {
  const int n = system.coordinate_count(), m = system.constraint_count();
  State direction = state;
  direction.q = random_vector(n, random);
  direction.v = random_vector(n, random);
  direction.a = random_vector(n, random);
  direction.lambda = random_vector(m, random);
  Eigen::VectorXd by_q(n + m), by_v(n + m), by_a(n + m);
  by_q << direction.q, direction.lambda;
  by_v << direction.v, Eigen::VectorXd::Zero(m);
  by_a << direction.a, Eigen::VectorXd::Zero(m);
  const auto constraint_rows = [&](const Eigen::VectorXd& x) {  // G and G' stand in every tangent
    return Eigen::VectorXd(tangent(system, state, {}) * x);
  };
  const Eigen::VectorXd derivative = tangent(system, state, {.stiffness = 1}) * by_q +
                                     tangent(system, state, {.damping = 1}) * by_v - constraint_rows(by_v) +
                                     tangent(system, state, {.mass = 1}) * by_a - constraint_rows(by_a);
  expect_second_order([&](double h) { return residual(system, moved(state, direction, h)); }, derivative,
                      step);
}

template <int D>
void check_tangent(int seed, const auto& make_model, double step = 5e-4) {
  std::mt19937 random(seed);
  const BeamModel model = make_model(random, D);
  for (const bool held : {false, true}) {
    std::vector<bool> all_held(model.riders.size(), false);
    std::fill_n(all_held.begin(), std::min<std::size_t>(all_held.size(), 2), held);
    const BeamSystem system(model, initial_plan(model), all_held);
    State state = disturbed_state(system, random);
    state.t = 0.3;
    expect_tangent(system, state, random, step);
  }
}

TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentInThePlane) {
  check_tangent<2>(1, model_with_everything);
  check_tangent<2>(5, joined_model);
  check_tangent<2>(9, cornered_model);
}
TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentInSpace) {
  check_tangent<3>(2, model_with_everything);
  check_tangent<3>(6, joined_model);
  check_tangent<3>(10, cornered_model);
}

TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentWithTorsion) {
  for (const int seed : {14, 15}) check_tangent<3>(seed, torsion_model);
  for (const int seed : {18, 19})
    check_tangent<3>(seed, [](std::mt19937& random, int) { return torsion_sliding_model(random, 0); });
}

TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentByEveryAxialLaw) {
  for (const AxialLaw& law : other_laws()) {
    const auto by_law = [&](const auto& make) {
      return [&law, &make](std::mt19937& random, int dimension) {
        return with_law(make(random, dimension), law);
      };
    };
    check_tangent<2>(21, by_law(model_with_everything), 2e-4);
    check_tangent<3>(22, by_law(model_with_everything), 2e-4);
    check_tangent<3>(23, by_law(torsion_model), 2e-4);
  }
}

TEST(BeamSystem, FindsTwoTangentsAtOnce) {
  const std::array<TangentWeights, 2> weights{TangentWeights{.stiffness = 1},
                                              {.mass = 0.3, .damping = 0.7, .stiffness = 0.1}};
  for (const bool torsion : {false, true})
    for (const int dimension : {2, 3}) {
      std::mt19937 random(30 + dimension);
      const BeamSystem system(torsion ? torsion_sliding_model(random, 0)
                                      : model_with_everything(random, dimension));
      const State state = disturbed_state(system, random);
      std::array<Eigen::SparseMatrix<double>, 2> found{system.tangent_pattern().matrix(),
                                                       system.tangent_pattern().matrix()};
      system.tangents(state, weights, {&found[0], &found[1]});
      for (const std::size_t k : {0, 1}) {
        const Eigen::SparseMatrix<double> one = tangent(system, state, weights[k]);
        EXPECT_LE((found[k] - one).norm(), 1e-14 * one.norm());
      }
    }
}

TEST(TangentRows, AreThoseOfTheWholeTangent) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(50 + dimension);
    const BeamSystem system(model_with_everything(random, dimension));
    const State state = disturbed_state(system, random);
    const TangentWeights w{.mass = 0.9, .damping = 0.2, .stiffness = 0.05};
    const Eigen::MatrixXd whole = tangent(system, state, w);
    const int n = system.coordinate_count();
    const std::vector<int> rows{3, 4, n / 2, n / 2 + 1, n - 1, n + 1};
    const TangentRows found(system, state, w, rows);
    std::vector<int> columns(static_cast<std::size_t>(whole.cols()));
    std::iota(columns.begin(), columns.end(), 0);
    const Eigen::MatrixXd expected = whole(rows, Eigen::all);
    EXPECT_LE((found.entries(columns) - expected).norm(), 1e-13 * expected.norm());
    const Eigen::MatrixXd x = Eigen::MatrixXd::Random(n, 3), product = expected.leftCols(n) * x;
    EXPECT_LE((found.product(x) - product).norm(), 1e-13 * product.norm());
  }
}

// Where places alone differ, whole tangents differ by that of the moving part, and nowhere else.
void check_moving_part(int seed, int dimension, double damping) {
  std::mt19937 random(seed);
  BeamModel model = testing::one_beam(testing::uneven_axis(random, dimension), dimension,
                                      {300, 2, 0.7, damping, {}}, 40, {{0, true}});
  const double L = model.beams[0].curve.length();
  testing::add_slider(model, 0.8, 0.33 * L);
  testing::add_slider(model, 0.5, 0.7 * L);
  const BeamSystem system(model);
  const std::vector<int>& unknowns = system.moving_unknowns();
  EXPECT_EQ(unknowns.size(), 2u * (3 * 2 * static_cast<unsigned>(dimension) + 1));
  State state = testing::disturbed_state(system, random);
  State moved = state;
  for (const MeshRider& joint : system.mesh().riders) {
    moved.q[joint.place] += 0.1 * L / 40;
    moved.v[joint.place] += 0.3;
  }
  const TangentWeights w{.mass = 0.9, .damping = 0.2, .stiffness = 0.05};
  Eigen::MatrixXd change, before;
  system.moving_tangent(moved, w, change);
  system.moving_tangent(state, w, before);
  change -= before;
  Eigen::MatrixXd rest =
      Eigen::MatrixXd(tangent(system, moved, w)) - Eigen::MatrixXd(tangent(system, state, w));
  EXPECT_GT(rest.norm(), 0.1);
  const double size = rest.norm();
  rest(unknowns, unknowns) -= change;
  EXPECT_LT(rest.norm(), 1e-12 * size);
}

TEST(BeamSystem, KnowsThePartOfItsTangentThatMoves) {
  for (const double damping : {0.0, 0.02})
    for (const int dimension : {2, 3}) check_moving_part(40 + dimension, dimension, damping);
}

// The roll of a body on a point: where nothing moves over the material its tangent is exact.
TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentWithABodyThatRollsOnAPoint) {
  std::mt19937 random(22);
  const BeamModel model = torsion_sliding_model(random, 0.3);
  const BeamSystem system(model);
  State state = disturbed_state(system, random);
  for (const MeshRider& joint : system.mesh().riders) state.v[joint.place] = 0;
  expect_tangent(system, state, random);
}

// Bodies with friction on a kink, on a smooth node, on a point and on a guide, in a wind.
BeamModel rubbing_model(std::mt19937& random, int dimension, Friction::Law law) {
  BeamModel model = model_with_everything(random, dimension);
  const ReferenceCurve guide(uneven_axis(random, dimension), dimension);
  model.beams.push_back(
      {.name = "guide", .curve = guide, .properties = {}, .rigid = true, .home = guide_nodes(guide)});
  model.riders[2].motion.reset();
  add_slider(model, 0.7, 0.6 * guide.length()).beam = 1;
  for (Rider& joint : model.riders)
    joint.friction = Friction{
        .coefficient = 0.4, .law = law, .force = {{0, 40}, {1, 80}}, .viscous = 2, .stick_stiffness = 100};
  model.air = {1.2, {3, -1, dimension == 3 ? 2.0 : 0.0}};
  for (Body& body : model.bodies) body.drag_area = 0.5;
  return model;
}

template <int D>
void check_rubbing_tangent(int seed, Friction::Law law) {
  std::mt19937 random(seed);
  const BeamModel model = rubbing_model(random, D, law);
  const BeamSystem system(model);
  ASSERT_TRUE(system.forces_depend_on_multipliers());
  for (const int way : {0, 1, -1}) {
    State state = disturbed_state(system, random);
    state.t = 0.3;
    state.lambda *= 10;
    state.memory = Eigen::VectorXd::Zero(12);
    for (int j = 0; j < 4; ++j) {
      const double s = state.q[system.mesh().riders[j].place];
      state.memory.segment<3>(3 * j) << 0.02 * (j - 1), s - 0.01, way;
      const FrictionForce friction = *sliding_friction(system, state, j);
      EXPECT_EQ(std::abs(friction.trial) < friction.bound, true) << "one that sticks holds";
    }
    expect_tangent(system, state, random);
  }
}

TEST(BeamSystem, HasTheDerivativeOfItsResidualAsTangentWithFrictionAndDrag) {
  for (const auto law : {Friction::Law::coulomb, Friction::Law::capstan}) {
    check_rubbing_tangent<2>(31, law);
    check_rubbing_tangent<3>(32, law);
  }
}

TEST(BeamSystem, WithoutItsMemoryFrictionDoesNothing) {
  std::mt19937 random(33);
  BeamModel model = rubbing_model(random, 2, Friction::Law::coulomb);
  const BeamSystem rubbing(model);
  const State state = disturbed_state(rubbing, random);
  for (Rider& joint : model.riders) joint.friction = Friction{};
  const BeamSystem smooth(model);
  EXPECT_EQ(residual(rubbing, state), residual(smooth, state));
}

template <int D>
void check_constraints(int seed, const auto& make_model) {
  std::mt19937 random(seed);
  const BeamModel model = make_model(random, D);
  const BeamSystem system(model, initial_plan(model));
  State state = disturbed_state(system, random);
  state.t = 0.3;
  const int n = system.coordinate_count(), m = system.constraint_count();
  // Along q(t) = q + v t + a t^2/2: dg/dt = G v + rate, d2g/dt2 = G a + curvature.
  const auto constraints = [&](double h) -> Eigen::VectorXd {
    State later = state;
    later.t += h;
    later.q += h * state.v + h * h / 2 * state.a;
    return residual(system, later).tail(m);
  };
  const Eigen::MatrixXd G = Eigen::MatrixXd(tangent(system, state, {})).bottomLeftCorner(m, n);
  expect_second_order(constraints, G * state.v + system.constraint_rate(state), 1e-3);
  EXPECT_LT((system.constraint_product(state, state.a) - G * state.a).norm(), 1e-14 * G.norm());
  const double h = 1e-3;
  const Eigen::VectorXd second = (constraints(h) - 2 * constraints(0) + constraints(-h)) / (h * h);
  const Eigen::VectorXd expected = G * state.a + system.constraint_curvature(state);
  EXPECT_LT((second - expected).norm(), 1e-3 * expected.norm());
  // Rows that are left out have the same gradient in all states.
  Eigen::VectorXd turning(m);
  system.turning_speeds(state, turning);
  const Eigen::VectorXd speeds = G * state.v + system.constraint_rate(state);
  State other = state;
  other.q += h * state.v;
  other.t += h;
  const Eigen::MatrixXd other_G = Eigen::MatrixXd(tangent(system, other, {})).bottomLeftCorner(m, n);
  for (int row = 0; row < m; ++row)
    if (turning[row] == 0)
      EXPECT_LT((other_G.row(row) - G.row(row)).norm(), 1e-14 * G.row(row).norm()) << row;
    else
      EXPECT_NEAR(turning[row], speeds[row], 1e-14 * G.norm()) << row;
}

TEST(BeamSystem, KnowsTheRateAndCurvatureOfItsConstraintsInThePlane) {
  check_constraints<2>(3, model_with_everything);
  check_constraints<2>(7, joined_model);
  check_constraints<2>(11, cornered_model);
}
TEST(BeamSystem, KnowsTheRateAndCurvatureOfItsConstraintsInSpace) {
  check_constraints<3>(4, model_with_everything);
  check_constraints<3>(8, joined_model);
  check_constraints<3>(12, cornered_model);
}

TEST(BeamSystem, KnowsTheRateAndCurvatureOfItsConstraintsWithTorsion) {
  for (const int seed : {16, 17}) check_constraints<3>(seed, torsion_model);
  for (const int seed : {20, 21})
    check_constraints<3>(seed, [](std::mt19937& random, int) { return torsion_sliding_model(random, 0); });
}

// The coordinates after r -> A r + b of the whole model.
template <int D>
Eigen::VectorXd affine_image(const BeamSystem& system, const Eigen::VectorXd& q,
                             const Eigen::Matrix<double, D, D>& A, const Eigen::Matrix<double, D, 1>& b) {
  Eigen::VectorXd image = q;
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) {
      image.segment<D>(node.r) = A * q.segment<D>(node.r) + b;
      image.segment<D>(node.slope_left) = A * q.segment<D>(node.slope_left);
      if (node.slope_right != node.slope_left)
        image.segment<D>(node.slope_right) = A * q.segment<D>(node.slope_right);
    }
  return image;
}

template <int D>
Eigen::Matrix<double, D, D> rotation() {
  return Eigen::AngleAxisd(1.1, D == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, 2, -2) / 3)
      .toRotationMatrix()
      .topLeftCorner<D, D>();
}

// A free beam with a mass on it.
template <int D>
BeamModel free_beam(std::mt19937& random, WeightRule weights, bool straight) {
  BeamModel model = one_beam(uneven_axis(random, D), D, {300, 2, 0.7, 0, {}}, 6, {});
  model.beams[0].weights = weights;
  if (straight) model.beams[0].curve = model.beams[0].curve.straightened();
  model.gravity.setZero();
  testing::add_slider(model, 0.8, 0.4);
  return model;
}

template <int D>
void check_rigid_motion() {
  std::mt19937 random(5);
  for (WeightRule weights : {WeightRule::material, WeightRule::constant, WeightRule::ones}) {
    const BeamModel model = free_beam<D>(random, weights, D == 3);
    const BeamSystem system(model, initial_plan(model));
    State state = disturbed_state(system, random, 0.02);
    state.v.setZero();
    state.a.setZero();
    State turned = state;
    turned.q = affine_image<D>(system, state.q, rotation<D>(), Eigen::Matrix<double, D, 1>::Constant(3));
    const SystemEnergy start = energy(system, state), after = energy(system, turned);
    EXPECT_NEAR(after.axial, start.axial, 1e-12 * start.mechanical());
    EXPECT_NEAR(after.bending, start.bending, 1e-12 * start.mechanical());
    // The forces turn too.
    const Eigen::VectorXd force = residual(system, state);
    const Eigen::VectorXd expected =
        affine_image<D>(system, force, rotation<D>(), Eigen::Matrix<double, D, 1>::Zero());
    EXPECT_LT((residual(system, turned) - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(BeamSystem, TurnsItsForcesWithARigidMotionInThePlane) { check_rigid_motion<2>(); }
TEST(BeamSystem, TurnsItsForcesWithARigidMotionInSpace) { check_rigid_motion<3>(); }

TEST(BeamSystem, HasNoElasticForceInARigidlyMovedDrawnShape) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 5; ++trial) {
    const BeamModel model = free_beam<2>(random, WeightRule::material, false);
    const BeamSystem system(model, initial_plan(model));
    State state = drawn_state(system);
    state.q = affine_image<2>(system, state.q, rotation<2>(), Eigen::Vector2d(3, -1));
    const SystemEnergy turned = energy(system, state);
    EXPECT_LT(turned.axial + turned.bending, 1e-20);
    EXPECT_LT(residual(system, state).norm(), 1e-9 * model.beams[0].properties.axial_stiffness);
  }
}

// Weights that follow the material hold every affine image of the drawn curve exactly: strain and length at
// any point are those of the image.
template <int D>
void check_patch() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const BeamModel model = free_beam<D>(random, WeightRule::material, true);
  const BeamSystem system(model, initial_plan(model));
  const Eigen::Matrix<double, D, D> A = Eigen::Matrix<double, D, D>::NullaryExpr(
      [&](Eigen::Index i, Eigen::Index j) { return (i == j) + 0.2 * unit(random); });
  State state = drawn_state(system);
  state.q = affine_image<D>(system, state.q, A, Eigen::Matrix<double, D, 1>::Constant(0.5));
  const ReferenceCurve& curve = model.beams[0].curve;
  for (int i = 0; i <= 50; ++i) {
    const double s = curve.length() * i / 50;
    const MaterialPoint<3> p = material_point(system, state, 0, s);
    const Eigen::Matrix<double, D, 1> r =
        A * curve.position(s).template head<D>() + Eigen::Matrix<double, D, 1>::Constant(0.5);
    EXPECT_LT((p.r.head<D>() - r).norm(), 1e-12);
    EXPECT_LT((p.rs.head<D>() - A * curve.tangent(s).template head<D>()).norm(), 1e-11);
  }
}

TEST(BeamSystem, HoldsAffineImagesOfTheDrawnCurveExactlyInThePlane) { check_patch<2>(); }
TEST(BeamSystem, HoldsAffineImagesOfTheDrawnCurveExactlyInSpace) { check_patch<3>(); }

template <int D>
void check_mass() {
  std::mt19937 random(8);
  const BeamModel model = free_beam<D>(random, WeightRule::material, true);
  const BeamSystem system(model, initial_plan(model));
  State state = disturbed_state(system, random);
  const double total = model.beams[0].properties.mass_per_length * model.beams[0].curve.length() + 0.8;
  const Eigen::SparseMatrix<double> M = tangent(system, state, {.mass = 1});
  for (int d = 0; d < D; ++d) {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(system.coordinate_count());
    for (const MeshNode& node : system.mesh().nodes[0]) shift[node.r + d] = 1;
    EXPECT_NEAR(shift.dot(M * shift), total, 1e-9 * total);
    // The material at rest but for a shift has that momentum.
    state.v = shift;
    EXPECT_NEAR(momentum(system, state)[d], total, 1e-9 * total);
    EXPECT_NEAR(shift.dot(M * state.v), total, 1e-9 * total);
  }
  // Kinetic energy is the quadratic form of the mass, whatever moves.
  state.v = random_vector(system.coordinate_count(), random);
  EXPECT_NEAR(energy(system, state).kinetic, state.v.dot(M * state.v) / 2, 1e-12 * state.v.dot(M * state.v));
}

TEST(BeamSystem, HasAMassWhoseRowsSumToTheWholeInThePlane) { check_mass<2>(); }
TEST(BeamSystem, HasAMassWhoseRowsSumToTheWholeInSpace) { check_mass<3>(); }

// A soft clamped beam with a sliding mass, over a time without event.
State run(const BeamModel& model, int steps, double end) {
  const BeamSystem system(model, initial_plan(model));
  State start = drawn_state(system);
  start_moving(system, start);
  EXPECT_EQ(make_accelerations_consistent(system, start), ConsistencyStatus::done);
  GeneralizedAlphaIntegrator integrator({.rho_infinity = 0.6, .newton_tolerance = 1e-12}, system, start);
  for (int i = 0; i < steps; ++i) EXPECT_EQ(integrator.advance(end / steps).status, StepStatus::converged);
  return integrator.state();
}

TEST(BeamSystem, IsIntegratedToSecondOrderInPositionVelocityAndMultiplier) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {60, 0.5, 2, 0, {}}, 4, {{0, true}});
  testing::add_slider(model, 0.8, 0.4);
  model.riders[0].speed = 0.2;
  const double end = 0.1;
  const State fine = run(model, 4800, end);
  std::vector<Eigen::Vector3d> errors;
  for (int steps : {150, 300, 600}) {
    const State state = run(model, steps, end);
    errors.emplace_back((state.q - fine.q).norm(), (state.v - fine.v).norm(),
                        (state.lambda - fine.lambda).norm());
  }
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(std::log2(errors[i][k] / errors[i + 1][k]), 2, 0.35) << "quantity " << k << " at " << i;
}

}  // namespace
}  // namespace nurbeam
