#include "fem/mesh/stop_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/mesh/drawn_coordinates.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

constexpr double gap = 0.3;

// Two bodies on a bent beam, nearer than twice their gap.
BeamModel two_bodies(int dimension) {
  Eigen::Matrix4d points;  // homogeneous, a column each
  points.col(0) = Eigen::Vector4d(0, 0, 0, 1);
  points.col(1) = 1.4 * Eigen::Vector4d(0.5, 0.4, dimension == 3 ? 0.3 : 0, 1);
  points.col(2) = 0.8 * Eigen::Vector4d(1.2, 0.5, 0, 1);
  points.col(3) = Eigen::Vector4d(1.6, 0, 0, 1);
  const RationalCubic bent(points);
  BeamModel model = testing::one_beam({bent}, dimension, {300, 2, 0.7}, 16, {{0, true}});
  testing::add_slider(model, 1, 0.61);
  testing::add_slider(model, 2, 1.02);
  model.stops.push_back({.rider = 0, .other = 1, .place = gap});
  return model;
}

Eigen::VectorXd moved(Eigen::VectorXd q, double by) {
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += by * std::sin(3.7 * static_cast<double>(i) + 1);
  return q;
}

TEST(StopDistance, OfTwoBodiesIsThatAlongTheDrawnBeam) {
  for (const int D : {2, 3}) {
    const BeamModel model = two_bodies(D);
    const Mesh mesh = make_mesh(model, initial_plan(model));
    const StopDistance distance(model, mesh, model.stops[0]);
    EXPECT_EQ(distance.dofs().size(), 2u + 2u * D);
    EXPECT_NEAR(distance.value(drawn_coordinates(model, mesh)), 1.02 - 0.61 - gap, 1e-14);
  }
}

TEST(StopDistance, HasTheDerivativesOfItsValue) {
  constexpr double h = 1e-5;
  for (const int D : {2, 3}) {
    const BeamModel model = two_bodies(D);
    const Mesh mesh = make_mesh(model, initial_plan(model));
    const StopDistance distance(model, mesh, model.stops[0]);
    const Eigen::VectorXd q = moved(drawn_coordinates(model, mesh), 0.02);
    const auto& dofs = distance.dofs();
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(dofs.size()); ++i) {
      Eigen::VectorXd more = q, less = q;
      more[dofs[i]] += h;
      less[dofs[i]] -= h;
      EXPECT_NEAR(distance.gradient(q)[i], (distance.value(more) - distance.value(less)) / (2 * h), 1e-9);
      EXPECT_LT(
          (distance.hessian(q).col(i) - (distance.gradient(more) - distance.gradient(less)) / (2 * h)).norm(),
          1e-8);
    }
    const Eigen::VectorXd v = moved(Eigen::VectorXd::Zero(q.size()), 1), a = moved(v, 0.4);
    const auto at = [&](double t) -> Eigen::VectorXd { return q + t * v + t * t / 2 * a; };
    EXPECT_NEAR(distance.rate(q, v), (distance.value(at(h)) - distance.value(at(-h))) / (2 * h), 1e-8);
    EXPECT_NEAR(distance.acceleration(q, v, a),
                (distance.rate(at(h), v + h * a) - distance.rate(at(-h), v - h * a)) / (2 * h), 1e-7);
  }
}

// Both bodies get the whole of it, and nothing else does where the beam is straight.
TEST(StopDistance, PressesBodiesAgainstEachOther) {
  BeamModel model = testing::one_beam({line_cubic({0, 0, 0}, {3, 0, 0})}, 3, {300, 2, 0.7}, 16, {{0, true}});
  testing::add_slider(model, 1, 1.1);
  testing::add_slider(model, 2, 1.5);
  model.stops.push_back({.rider = 0, .other = 1, .place = gap});
  const Mesh mesh = make_mesh(model, initial_plan(model));
  const StopDistance distance(model, mesh, model.stops[0]);
  const Eigen::VectorXd q = drawn_coordinates(model, mesh);
  StopDistance::Vector along(8);
  along << 0, 0, -1, 0, 0, 1, 0, 0;
  EXPECT_LT((distance.gradient(q) - along).norm(), 1e-14);
  EXPECT_LT((distance.on_body(1, q, 5) - Eigen::Vector3d(5, 0, 0)).norm(), 1e-14);
  EXPECT_LT((distance.on_body(0, q, 5) + Eigen::Vector3d(5, 0, 0)).norm(), 1e-14);
}

// Far from each other they are as far as their places, however the beam between them folds.
TEST(StopDistance, OfBodiesFarApartIsThatOfTheirPlaces) {
  BeamModel model = two_bodies(3);
  model.stops[0].place = 0.1;
  const Mesh mesh = make_mesh(model, initial_plan(model));
  const StopDistance distance(model, mesh, model.stops[0]);
  Eigen::VectorXd q = drawn_coordinates(model, mesh);
  q.segment<3>(mesh.bodies[1]) = q.segment<3>(mesh.bodies[0]);
  EXPECT_NEAR(distance.value(q), 1.02 - 0.61 - 0.1, 1e-14);
  EXPECT_EQ(distance.on_body(1, q, 5), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace nurbeam
