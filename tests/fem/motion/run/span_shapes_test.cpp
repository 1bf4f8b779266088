#include "fem/motion/run/span_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/model/build.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

// A straight beam in space, with more spans than stand side by side.
BeamSystem straight(int elements) {
  ModelBuilder builder(3);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3), BeamProperties(1e5, 2, 1),
                   {.elements = elements});
  builder.clamp(0, 0);
  return BeamSystem(builder.build());
}

// Gives the nodes the places and tangents of a curve r(s).
template <class Place, class Tangent>
State on_curve(const BeamSystem& system, const Place& place, const Tangent& tangent) {
  State state = drawn_state(system);
  for (const MeshNode& node : system.mesh().nodes[0]) {
    state.q.segment<3>(node.r) = place(node.s);
    state.q.segment<3>(node.slope_left) = tangent(node.s);
  }
  return state;
}

ShapeExtremes extremes(const BeamSystem& system, const State& state, double radius) {
  const Beam& beam = system.model().beams[0];
  SpanShapes shapes(beam, system.mesh(), 0, state);
  return shapes.extremes<3>(beam, state, radius);
}

TEST(SpanShapes, OfTheDrawingAreZero) {
  for (const int elements : {1, 7, 8, 9, 20}) {
    const BeamSystem system = straight(elements);
    const ShapeExtremes found = extremes(system, drawn_state(system), 0.1);
    for (const double each : {found.tension, found.compression, found.bending, found.stress,
                              found.squared_strain, found.squared_bending})
      EXPECT_NEAR(each, 0, 1e-12) << elements;
  }
}

TEST(SpanShapes, OfAStretchedBeamHaveGreensStrain) {
  const double stretch = 1.2, strain = (stretch * stretch - 1) / 2;
  for (const int elements : {3, 8, 13}) {
    const BeamSystem system = straight(elements);
    const State state = on_curve(
        system, [&](double s) { return Eigen::Vector3d(0, stretch * s, 0); },
        [&](double) { return Eigen::Vector3d(0, stretch, 0); });
    const ShapeExtremes found = extremes(system, state, 0.1);
    EXPECT_NEAR(found.tension, strain, 1e-12);
    EXPECT_EQ(found.compression, 0);
    EXPECT_NEAR(found.bending, 0, 1e-5) << "the root of round-off";
    EXPECT_NEAR(found.squared_strain, strain * strain * 2, 1e-12) << "over 2 m, each span once";
  }
}

// r = (s, 0, c s^2/2) has the curvature c to first order, and is one cubic.
TEST(SpanShapes, OfABentBeamHaveItsCurvature) {
  const double c = 1e-4, radius = 30;
  const BeamSystem system = straight(11);
  const State state = on_curve(
      system, [&](double s) { return Eigen::Vector3d(s, 0, c * s * s / 2); },
      [&](double s) { return Eigen::Vector3d(1, 0, c * s); });
  const ShapeExtremes found = extremes(system, state, radius);
  EXPECT_NEAR(found.bending, c, 1e-9);
  EXPECT_NEAR(found.squared_bending, c * c * 2, 0.01 * c * c) << "curvatures are roots of differences";
  EXPECT_NEAR(found.stress, radius * c, 1e-4 * radius * c) << "the strain is a part of 10^4 of it";
}

// Where a place moves along the drawing with its nodes on it, nothing is strained or bent.
TEST(SpanShapes, BesideAPlaceThatMovesAreThoseOfItsPlace) {
  ModelBuilder builder(2);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2), BeamProperties(1e5, 2, 1),
                   {.elements = 4});
  builder.clamp(0, 0);
  BeamModel model = builder.build();
  model.bodies.push_back({.name = "body", .mass = 1});
  Rider rider{};
  rider.s = 0.7;
  model.riders.push_back(rider);
  const BeamSystem system(model);
  State state = drawn_state(system);
  const Beam& beam = system.model().beams[0];
  SpanShapes shapes(beam, system.mesh(), 0, state);
  for (const double s : {0.7, 0.72, 0.9, 0.6}) {
    bool moves = false;
    for (const MeshNode& node : system.mesh().nodes[0]) {
      if (node.place < 0) continue;
      moves = true;
      state.q[node.place] = s;
      state.q.segment<2>(node.r) = Eigen::Vector2d(s, 0);
    }
    ASSERT_TRUE(moves);
    const ShapeExtremes found = shapes.extremes<2>(beam, state, 0.1);
    EXPECT_NEAR(found.tension, 0, 1e-12) << s;
    EXPECT_NEAR(found.compression, 0, 1e-12) << s;
    EXPECT_NEAR(found.bending, 0, 1e-5) << s << ": the root of round-off";
  }
  state.q[system.mesh().nodes[0].back().r] = 2.2;  // 20 % in the last of four spans
  EXPECT_GT(shapes.extremes<2>(beam, state, 0.1).tension, 0.2);
}

}  // namespace
}  // namespace nurbeam
