#include "fem/mesh/mesh.h"

#include <gtest/gtest.h>

#include <set>

#include "fem/mesh/drawn_coordinates.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

BeamModel bar(int dimension, int elements = 10) {
  return testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, dimension, {300, 2, 0.7}, elements,
                           {{0, true}});
}

TEST(Mesh, WithoutJointsHasPositionAndSlopePerNode) {
  for (const int D : {2, 3}) {
    const BeamModel model = bar(D);
    const Mesh mesh = make_mesh(model, initial_plan(model));
    EXPECT_EQ(mesh.coordinate_count, 11 * 2 * D);
    EXPECT_EQ(mesh.spans.size(), 10u);
    EXPECT_EQ(mesh.first_span, (std::vector<int>{0, 10}));
    for (const MeshSpan& span : mesh.spans) EXPECT_EQ(span.place_a, -1);
  }
}

TEST(Mesh, NumbersEveryCoordinateOnce) {
  BeamModel model = bar(3);
  testing::add_slider(model, 1, 0.33).continuous_slope = false;
  testing::add_slider(model, 1, 0.999);  // near the end: a point
  model.bodies.push_back({.name = "free", .mass = 1, .position = {3, 4, 5}});
  const Mesh mesh = make_mesh(model, initial_plan(model));
  std::multiset<int> taken;
  const auto take = [&](int first, int n) {
    for (int i = 0; i < n; ++i) taken.insert(first + i);
  };
  for (const MeshNode& node : mesh.nodes[0]) {
    if (node.rider < 0) take(node.r, 3);
    take(node.slope_left, 3);
    if (node.slope_right != node.slope_left) take(node.slope_right, 3);
  }
  for (const int body : mesh.bodies) take(body, 3);
  for (const MeshRider& joint : mesh.riders) take(joint.place, 1);
  EXPECT_EQ(static_cast<int>(taken.size()), mesh.coordinate_count);
  for (int i = 0; i < mesh.coordinate_count; ++i) EXPECT_EQ(taken.count(i), 1u) << i;
  const Eigen::VectorXd q = drawn_coordinates(model, mesh);
  EXPECT_EQ(q.segment<3>(mesh.bodies[2]), Eigen::Vector3d(3, 4, 5));
}

TEST(Mesh, AMovingNodeTakesThePlaceOfTheHomeNodeNearestToIt) {
  BeamModel model = bar(2);
  testing::add_slider(model, 1, 0.33);
  const Mesh mesh = make_mesh(model, initial_plan(model));
  ASSERT_EQ(mesh.nodes[0].size(), 11u);
  EXPECT_EQ(mesh.nodes[0][3].rider, 0);
  EXPECT_EQ(mesh.nodes[0][3].home, -1);
  EXPECT_EQ(mesh.bodies[0], mesh.nodes[0][3].r);
  EXPECT_EQ(mesh.spans[2].place_b, mesh.riders[0].place);
  EXPECT_EQ(mesh.spans[3].place_a, mesh.riders[0].place);
  Eigen::VectorXd q = drawn_coordinates(model, mesh);
  EXPECT_NEAR(mesh.spans[2].end(q), 0.33, 1e-15);
  q[mesh.riders[0].place] = 0.36;
  EXPECT_EQ(find_span(model, mesh, q, 0, 0.35), 2);
  EXPECT_EQ(find_span(model, mesh, q, 0, 0.37), 3);
}

TEST(MeshPlan, NearAnEndOrAPermanentNodeAJointIsAPoint) {
  BeamModel model =
      testing::one_beam({line_cubic({0, 0, 0}, {0.5, 0, 0}), line_cubic({0.5, 0, 0}, {1, 0, 0})}, 2,
                        {300, 2, 0.7}, 10, {{0, true}});
  for (const auto& [s, mode] : {std::pair{0.015, Carried::point},
                                {0.025, Carried::node},
                                {0.497, Carried::point},
                                {0.49, Carried::node},
                                {0.985, Carried::point}}) {
    model.riders.clear();
    testing::add_slider(model, 1, s);
    EXPECT_EQ(initial_plan(model).modes[0], mode) << s;
  }
}

}  // namespace
}  // namespace nurbeam
