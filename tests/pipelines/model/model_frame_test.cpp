#include "pipelines/model/model_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace nurbeam {
namespace {

using Eigen::Vector3d;

RationalCubic cubic(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Eigen::Matrix4d points;
  points << a, b, c, d, 1, 2, 0.5, 1;
  for (int i = 0; i < 4; ++i) points.col(i).head<3>() *= points(3, i);
  return RationalCubic(points);
}

/// A curve with its control points in the plane through `origin` that e1 and e2 span.
RationalCubic in_plane(const Vector3d& origin, const Vector3d& e1, const Vector3d& e2) {
  return cubic(origin, origin + e1, origin + 2 * e1 + e2, origin + 3 * e1 - e2);
}

RationalCubic frame_line(const Vector3d& a, const Vector3d& b) {
  return cubic(a, a + (b - a) / 3, a + (b - a) * 2 / 3, b);
}

TEST(ModelFrame, APlaneOfAnyDirectionFarFromTheOriginIsFound) {
  const Vector3d origin(1e4, -2e4, 5e3), normal = Vector3d(1, -2, 3).normalized();
  const Vector3d e1 = normal.unitOrthogonal(), e2 = normal.cross(e1);
  const RationalCubic axis = in_plane(origin, e1, e2);
  const ModelFrame frame = model_frame({axis}, {e1 + 9.81 * e2}, {2 * normal});
  EXPECT_EQ(frame.dimension, 2);
  EXPECT_LT((frame.rotation * frame.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(frame.rotation.determinant(), 1, 1e-14);
  EXPECT_LT((frame.rotation.row(2).transpose() - normal).norm(), 1e-10);
  EXPECT_EQ(frame.to_local(origin), Vector3d::Zero().eval());
  EXPECT_LT((frame.to_world(frame.to_local(Vector3d(1, 2, 3))) - Vector3d(1, 2, 3)).norm(), 1e-11);
}

TEST(ModelFrame, AForceOutOfThePlaneMakesTheModelSpatialAndItsFrameThatOfTheWorld) {
  const Vector3d origin(1, 2, 3);
  const RationalCubic axis = in_plane(origin, Vector3d::UnitX(), Vector3d::UnitZ());
  EXPECT_EQ(model_frame({axis}, {-Vector3d::UnitZ()}, {}).dimension, 2);
  EXPECT_EQ(model_frame({axis}, {Vector3d::Zero()}, {Vector3d::Zero()}).dimension, 2);
  const ModelFrame frame = model_frame({axis}, {-Vector3d::UnitZ(), Vector3d(0, 1e-6, 1)}, {});
  EXPECT_EQ(frame.dimension, 3);
  EXPECT_EQ(frame.rotation, Eigen::Matrix3d::Identity().eval());
  EXPECT_EQ(frame.origin, origin);
}

TEST(ModelFrame, AMomentInThePlaneMakesTheModelSpatial) {
  const RationalCubic axis = in_plane(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY());
  EXPECT_EQ(model_frame({axis}, {}, {-5 * Vector3d::UnitZ()}).dimension, 2);
  EXPECT_EQ(model_frame({axis}, {}, {Vector3d::UnitX()}).dimension, 3);
}

// What is off a line by round-off is on it.
TEST(ModelFrame, AMomentAcrossALineOfAnyDirectionIsNormalToThePlane) {
  for (const Vector3d& end : {Vector3d(1.4367410316447358, 1.2369841043843008, -0.636903080137779),
                              Vector3d(0.3, -2.7, 1.1), Vector3d(-1, 1e-3, 0.2)}) {
    const Vector3d normal = end.cross(Vector3d(0.2, 0.5, 0.9)).normalized();
    const ModelFrame frame =
        model_frame({frame_line(Vector3d(1, 2, 3), Vector3d(1, 2, 3) + end)}, {}, {7 * normal});
    EXPECT_EQ(frame.dimension, 2);
    EXPECT_LT(frame.rotation.row(2).transpose().cross(normal).norm(), 1e-9);
  }
}

TEST(ModelFrame, AnAxisOutOfThePlaneOfTheOthersMakesTheModelSpatial) {
  const RationalCubic first = in_plane(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY());
  const RationalCubic second = in_plane(Vector3d(0, 0, 1), Vector3d::UnitX(), Vector3d::UnitY());
  EXPECT_EQ(model_frame({first, first}, {}, {}).dimension, 2);
  EXPECT_EQ(model_frame({first, second}, {}, {}).dimension, 3);
}

TEST(ModelFrame, OfThePlanesThroughALineTheOneIsTakenThatTheFirstMomentIsNormalTo) {
  const RationalCubic axis = frame_line(Vector3d(1, 1, 1), Vector3d(4, 1, 1));
  const Vector3d moment(0, 3, 4);
  const ModelFrame asked = model_frame({axis}, {}, {moment});
  EXPECT_EQ(asked.dimension, 2);
  EXPECT_LT((asked.rotation.row(2).transpose() - moment / 5).norm(), 1e-12);
  const ModelFrame horizontal = model_frame({axis}, {}, {});
  EXPECT_EQ(horizontal.rotation, Eigen::Matrix3d::Identity().eval());
  const ModelFrame upright = model_frame({frame_line(Vector3d::Zero(), Vector3d::UnitZ())}, {}, {});
  EXPECT_EQ(upright.rotation.row(2), Vector3d::UnitY().transpose().eval());
}

TEST(ModelFrame, ACurveKeepsItsWeightsAndItsDistances) {
  const Vector3d origin(3, -1, 2);
  const RationalCubic axis =
      in_plane(origin, Vector3d(1, 1, 0).normalized(), Vector3d(-1, 1, 2).normalized());
  const ModelFrame frame = model_frame({axis}, {}, {});
  const RationalCubic local = frame.to_local(axis);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(local.weight(i), axis.weight(i));
    EXPECT_EQ(local.control_point(i).z(), 0);
    EXPECT_LT((frame.to_world(local.control_point(i)) - axis.control_point(i)).norm(), 1e-14);
  }
}

TEST(ModelFrame, ThePlaneTakesTheForcesInItAndTheMomentsAcrossIt) {
  const RationalCubic axis = in_plane(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitZ());
  const ModelFrame plane = model_frame({axis}, {}, {});
  const Vector3d v(1, 2, 3);
  // The plane's normal is y with its positive direction: x stays x, and the second axis is -z.
  EXPECT_EQ(plane.direction_to_local(v), Vector3d(1, -3, 0));
  EXPECT_EQ(plane.moment_to_local(v), Vector3d(0, 0, 2));
  EXPECT_EQ(plane.direction_to_world(Vector3d(1, -3, 2)), v);
  const ModelFrame space = model_frame({axis}, {v}, {});
  EXPECT_EQ(space.direction_to_local(v), v);
  EXPECT_EQ(space.moment_to_local(v), v);
}

}  // namespace
}  // namespace nurbeam
