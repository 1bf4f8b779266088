// Long because its tests share what they build.
#include "nurbs/smooth/smooth_nurbs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"
#include "nurbs/smooth/drawn_conic.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

double size_of(const NurbsCurve& curve) {
  const Eigen::Matrix3Xd points = curve.control_points().colwise().hnormalized();
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// The curve as cubics, each cut into `count` at places that are not evenly spread; weights scaled at will.
BezierPath in_pieces(Generator& generator, const NurbsCurve& curve, int count) {
  const BezierPath whole = BezierPath::from_nurbs(curve, 1e-6);
  BezierPath cut{{}, {whole.breaks.front()}, 0};
  for (const RationalCubic& segment : whole.segments)
    for (int i = 0; i < count; ++i) {
      const auto at = [count](int k) { return std::pow(double(k) / count, 1.3); };
      const RationalCubic piece = segment.piece(at(i), at(i + 1));
      cut.segments.emplace_back(piece.points() * uniform(generator, 0.5, 2));
      cut.breaks.push_back(cut.breaks.back() + length(piece));
    }
  return cut;
}

/// Distance both ways, seen by projection, independent of the bound that comes with the curve.
double distance(const NurbsCurve& a, const BezierPath& b) {
  return hausdorff_distance(BezierPath::from_nurbs(a, 1e-6).segments, b.segments);
}

/// A polynomial B-spline of degree p with simple interior knots.
NurbsCurve smooth_spline(Generator& generator, int degree, int spans) {
  std::vector<double> knots(degree + 1, 0);
  for (int i = 1; i < spans; ++i) knots.push_back(knots.back() + uniform(generator, 0.2, 1));
  knots.insert(knots.end(), degree + 1, knots.back() + uniform(generator, 0.2, 1));
  Eigen::Matrix3Xd points(3, degree + spans);
  for (int i = 0; i < points.cols(); ++i)
    points.col(i) = Eigen::Vector3d(i, 0, 0) + 0.6 * random_point(generator);
  return make_nurbs_curve(KnotVector(degree, knots), points, Eigen::VectorXd::Ones(points.cols()));
}

/// The same with weights in [low, high].
NurbsCurve weighted(Generator& generator, const NurbsCurve& curve, double low, double high) {
  Eigen::Matrix4Xd points = curve.control_points();
  for (int i = 0; i < points.cols(); ++i) points.col(i) *= uniform(generator, low, high);
  return {curve.knots(), points};
}

/// A chain of random cubics that share tangents, with weights in [low, high] and lengths of their own.
BezierPath smooth_chain(Generator& generator, int count, double low, double high) {
  BezierPath path{{}, {0}, 0};
  Eigen::Vector3d point = random_point(generator), tangent(1, 0, 0);
  for (int j = 0; j < count; ++j) {
    const Eigen::Vector3d next = point + Eigen::Vector3d(3, 0, 0) + random_point(generator);
    const Eigen::Vector3d next_tangent = (Eigen::Vector3d(2, 0, 0) + random_point(generator)).normalized();
    Eigen::Matrix3Xd controls(3, 4);
    controls << point, point + uniform(generator, 0.3, 1.2) * tangent,
        next - uniform(generator, 0.3, 1.2) * next_tangent, next;
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const double weight = uniform(generator, low, high);
      points.col(i) << weight * controls.col(i), weight;
    }
    path.segments.emplace_back(points);
    path.breaks.push_back(path.breaks.back() + length(path.segments.back()));
    point = next;
    tangent = next_tangent;
  }
  return path;
}

int largest_interior_multiplicity(const NurbsCurve& curve) {
  int most = 0;
  for (const double u : curve.knots().breaks())
    if (u != curve.knots().start() && u != curve.knots().end())
      most = std::max(most, curve.knots().multiplicity(u));
  return most;
}

double ratio_of_weights(const NurbsCurve& curve) {
  const Eigen::RowVectorXd weights = curve.control_points().row(3);
  return weights.maxCoeff() / weights.minCoeff();
}

double ratio_of_speeds(const NurbsCurve& curve) {
  Eigen::VectorXd speeds(1001);
  for (int i = 0; i < speeds.size(); ++i) {
    const double share = i / double(speeds.size() - 1);
    speeds(i) =
        curve.derivatives(std::lerp(curve.knots().start(), curve.knots().end(), share), 1).col(1).norm();
  }
  return speeds.maxCoeff() / speeds.minCoeff();
}

TEST(SmoothNurbs, APieceMealSplineGetsItsOwnControlPointsBack) {
  Generator generator(70);
  for (int i = 0; i < 120; ++i) {
    const NurbsCurve source = smooth_spline(generator, 1 + i % 3, 1 + i % 12);
    const BezierPath path = in_pieces(generator, source, 1 + i % 5);
    const double size = size_of(source);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 2e-13 * size);
    ASSERT_EQ(smooth.curve.degree(), source.degree()) << i;
    ASSERT_EQ(smooth.curve.control_points().cols(), source.control_points().cols()) << i;
    EXPECT_FALSE(smooth.curve.is_rational());
    ASSERT_LE((smooth.curve.control_points() - source.control_points()).cwiseAbs().maxCoeff(), 1e-12 * size);
    ASSERT_LE(smooth.deviation, 2e-13 * size);
    ASSERT_LE(distance(smooth.curve, path), smooth.deviation + 1e-14 * size);
  }
}

TEST(SmoothNurbs, APieceMealRationalSplineGetsAsManyControlPointsAsItHad) {
  Generator generator(71);
  for (int i = 0; i < 120; ++i) {
    const NurbsCurve source = weighted(generator, smooth_spline(generator, 2 + i % 2, 1 + i % 9), 0.6, 1.4);
    const BezierPath path = in_pieces(generator, source, 1 + i % 4);
    const double size = size_of(source);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 2e-13 * size);
    ASSERT_EQ(smooth.curve.degree(), source.degree()) << i;
    ASSERT_EQ(smooth.curve.control_points().cols(), source.control_points().cols()) << i;
    ASSERT_LE(smooth.deviation, 2e-13 * size);
    ASSERT_LE(distance(smooth.curve, path), smooth.deviation + 1e-14 * size);
  }
}

TEST(SmoothNurbs, ALineIsTwoPolesOfDegreeOne) {
  Generator generator(72);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d a = 10 * random_point(generator), b = 10 * random_point(generator);
    const BezierPath path = in_pieces(generator, line(a, b), 1 + 10 * i);
    for (const CurveParameter parameter : {CurveParameter::free, CurveParameter::material}) {
      const SmoothNurbs smooth = smooth_nurbs(path, parameter, 1e-13 * (b - a).norm());
      ASSERT_EQ(smooth.curve.degree(), 1);
      ASSERT_EQ(smooth.curve.control_points().cols(), 2);
      EXPECT_LE((smooth.curve.point(smooth.curve.knots().start()) - a).norm(), 4e-15);
      EXPECT_LE((smooth.curve.point(smooth.curve.knots().end()) - b).norm(), 4e-15);
    }
  }
}

TEST(SmoothNurbs, AnArcIsOneRationalQuadratic) {
  Generator generator(73);
  for (const double degrees : {10.0, 90.0, 120.0, 170.0}) {
    const BezierPath path = in_pieces(generator, circular_arc(2, degrees * pi / 180), 7);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 1e-13);
    EXPECT_EQ(smooth.curve.degree(), 2);
    EXPECT_EQ(smooth.curve.control_points().cols(), 3) << degrees;
    EXPECT_LE(distance(smooth.curve, path), 1e-13);
  }
}

// A quadratic on the unit circle is x + iy = z^2, w = |z|^2 with z linear in the parameter. Two of them that
// are C1 in homogeneous coordinates share z and z z', and so z': they are one, whose angle 2 arg z stays
// below a full turn, and on a span with positive weights below half of one. So no circle of degree 2 is C1
// throughout. Of degree 3 it is, made of two half turns, with one control point less than three arcs of
// degree 2 have.
TEST(SmoothNurbs, AWholeCircleIsC1ThroughoutWithMildWeights) {
  Generator generator(73);
  for (const int parts : {3, 4})
    for (const int cuts : {1, 2, 3, 5, 8, 25}) {
      SCOPED_TRACE(::testing::Message() << parts << " arcs in " << cuts << " pieces");
      BezierPath arcs{{}, {0}, 0};
      for (int i = 0; i < parts; ++i) {
        const double angle = 2 * pi / parts;
        const Eigen::AngleAxisd turn(i * angle, Eigen::Vector3d::UnitZ());
        Eigen::Matrix4Xd points = circular_arc(1, angle).control_points();
        points.topRows<3>() = (turn * points.topRows<3>()).eval();
        const BezierPath part = in_pieces(generator, {KnotVector(2, {0, 0, 0, 1, 1, 1}), points}, cuts);
        for (const RationalCubic& segment : part.segments) {
          arcs.segments.push_back(segment);
          arcs.breaks.push_back(arcs.breaks.back() + length(segment));
        }
      }
      const NurbsCurve circle = smooth_nurbs(arcs, CurveParameter::free, 1e-12).curve;
      EXPECT_EQ(circle.degree(), 3);
      EXPECT_EQ(circle.control_points().cols(), 6);
      EXPECT_EQ(largest_interior_multiplicity(circle), 2);
      EXPECT_LE(ratio_of_weights(circle), 9 * (1 + 1e-9));
      EXPECT_LE(ratio_of_speeds(circle), 2.1);
      EXPECT_LE((circle.derivatives(circle.knots().start(), 1) - circle.derivatives(circle.knots().end(), 1))
                    .norm(),
                1e-12);
      const double start = circle.knots().start(), all = circle.knots().end() - start;
      for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(circle.point(start + all * (0.001 * i)).norm(), 1, 2e-13);
    }
}

/// A whole ellipse about a centre as so many quadratic arcs.
NurbsCurve drawn_ellipse(const Eigen::Vector3d& centre, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         int parts) {
  Eigen::Matrix4Xd points(4, 2 * parts + 1);
  std::vector<double> knots(3, 0);
  for (int i = 0; i <= 2 * parts; ++i) {
    const double angle = i * pi / parts, weight = i % 2 == 0 ? 1 : std::cos(pi / parts);
    const Eigen::Vector3d at = centre + (std::cos(angle) * a + std::sin(angle) * b) / weight;
    points.col(i) << weight * at, weight;
    if (i % 2 == 0 && i > 0 && i < 2 * parts) knots.insert(knots.end(), 2, i / 2);
  }
  knots.insert(knots.end(), 3, parts);
  return {KnotVector(2, knots), points};
}

TEST(DrawnConic, IsTheArcsThatItWasDrawnOf) {
  Generator generator(79);
  for (const int parts : {3, 4})
    for (const int cuts : {1, 2, 3, 5, 8, 25}) {
      SCOPED_TRACE(::testing::Message() << parts << " arcs in " << cuts << " pieces");
      for (const auto& [centre, a, b] :
           {std::tuple(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)),
            std::tuple(Eigen::Vector3d(30, -5, 2), Eigen::Vector3d(3, 1, 0), Eigen::Vector3d(0.5, 0.2, 2))}) {
        const NurbsCurve drawn = drawn_ellipse(centre, a, b, parts);
        const BezierPath path = in_pieces(generator, drawn, cuts);
        const auto found = drawn_conic(path, 1e-12 * length(drawn));
        ASSERT_TRUE(found);
        const NurbsCurve& back = found->curve;
        ASSERT_EQ(back.control_points().cols(), drawn.control_points().cols());
        EXPECT_LE((back.control_points() - drawn.control_points()).norm(), 1e-12 * length(drawn));
        EXPECT_EQ(back.knots().multiplicity(back.knots().breaks()[1]), 2);
      }
    }
  // Of more arcs than four, of half a circle, and of other shapes there is none.
  const NurbsCurve many = drawn_ellipse({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8);
  EXPECT_FALSE(drawn_conic(BezierPath::from_nurbs(many, 1e-9), 1e-12));
  EXPECT_FALSE(drawn_conic(BezierPath::from_nurbs(circular_arc(1, 2), 1e-9), 1e-12));
  BezierPath bent = BezierPath::from_nurbs(drawn_ellipse({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4), 1e-9);
  Eigen::Matrix4d points = bent.segments[1].points();
  points(2, 1) += 1e-3;
  bent.segments[1] = RationalCubic(points);
  EXPECT_FALSE(drawn_conic(bent, 1e-12));
}

TEST(SmoothNurbs, AWholeEllipseFarAwayIsSoToo) {
  Generator generator(75);
  BezierPath arcs{{}, {0}, 0};
  const Eigen::Vector3d centre(1000, -500, 20), a(3, 1, 0), b(0.5, 0.2, 2);
  for (int i = 0; i < 3; ++i) {
    const double from = i * 2 * pi / 3, half = pi / 3, middle = from + half;
    Eigen::Matrix4Xd points(4, 3);
    points << centre + std::cos(from) * a + std::sin(from) * b,
        0.5 * centre + std::cos(middle) * a + std::sin(middle) * b,
        centre + std::cos(from + 2 * half) * a + std::sin(from + 2 * half) * b, 1, 0.5, 1;
    const BezierPath part = in_pieces(generator, {KnotVector(2, {0, 0, 0, 1, 1, 1}), points}, 4);
    for (const RationalCubic& segment : part.segments) {
      arcs.segments.push_back(segment);
      arcs.breaks.push_back(arcs.breaks.back() + length(segment));
    }
  }
  const SmoothNurbs ellipse = smooth_nurbs(arcs, CurveParameter::free, 1e-10);
  EXPECT_EQ(ellipse.curve.control_points().cols(), 6);
  EXPECT_LE(distance(ellipse.curve, arcs), 1e-10);
  EXPECT_LE(ellipse.deviation, 1e-10);
}

TEST(SmoothNurbs, AClosedRunThatIsNoWholeConicIsNone) {
  // Two half circles of a slot, and the lines between them.
  BezierPath slot{{}, {0}, 0};
  const auto add = [&](const NurbsCurve& curve) {
    for (const RationalCubic& segment : BezierPath::from_nurbs(curve, 0).segments) {
      slot.segments.push_back(segment);
      slot.breaks.push_back(slot.breaks.back() + length(segment));
    }
  };
  for (const double side : {1.0, -1.0}) {
    Eigen::Matrix3Xd line(3, 2);
    line << -side, side, -side, -side, 0, 0;
    add(make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), line, Eigen::Vector2d::Ones()));
    for (const double from : {-pi / 2, 0.0}) {
      Eigen::Matrix4Xd points = circular_arc(1, pi / 2).control_points();
      const Eigen::AngleAxisd turn(from + (side > 0 ? 0 : pi), Eigen::Vector3d::UnitZ());
      points.topRows<3>() = (turn * points.topRows<3>()).eval() + Eigen::Vector3d(side, 0, 0) * points.row(3);
      add({KnotVector(2, {0, 0, 0, 1, 1, 1}), points});
    }
  }
  const NurbsCurve curve = smooth_nurbs(slot, CurveParameter::free, 1e-12).curve;
  EXPECT_NEAR(length(curve), 4 + 2 * pi, 1e-11);
}

/// What a pipe run is made of: a line, or an arc about an axis at right angles to where it starts.
struct RunPart {
  double size;              // length of the line, radius of the arc [m]
  double angle = 0;         // of the arc, at most 90 degrees [rad]; 0 is a line
  bool same_plane = false;  // as the arc before; else its plane is turned by 90 degrees
};

/// The parts end to end with a common tangent, each cut into `cuts` cubics (arcs of more than 45 degrees
/// twice as many).
BezierPath pipe_run(const std::vector<RunPart>& parts, int cuts) {
  BezierPath path{{}, {0}, 0};
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  // x runs ahead, arcs turn towards y
  for (const RunPart& part : parts) {
    if (part.angle > 0 && !part.same_plane) frame.rotate(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitX()));
    Eigen::Isometry3d here = frame, step = Eigen::Isometry3d::Identity();
    if (part.angle > 0) {  // circular_arc() starts on its x axis and runs ahead along its y axis
      here = frame * Eigen::Translation3d(0, part.size, 0) *
             Eigen::AngleAxisd(-pi / 2, Eigen::Vector3d::UnitZ());
      step = Eigen::Translation3d(0, part.size, 0) * Eigen::AngleAxisd(part.angle, Eigen::Vector3d::UnitZ()) *
             Eigen::Translation3d(0, -part.size, 0);
    } else {
      step.translate(Eigen::Vector3d(part.size, 0, 0));
    }
    const NurbsCurve drawn =
        part.angle > 0 ? circular_arc(part.size, part.angle) : line({0, 0, 0}, {part.size, 0, 0});
    const int count = part.angle > pi / 4 ? 2 * cuts : cuts;
    for (const RationalCubic& whole : BezierPath::from_nurbs(drawn, 1e-9).segments)
      for (int i = 0; i < count; ++i) {
        const RationalCubic cubic = whole.piece(double(i) / count, double(i + 1) / count);
        path.segments.emplace_back(here.matrix() * cubic.points());
        path.breaks.push_back(path.breaks.back() + length(cubic));
      }
    frame = frame * step;
  }
  return path;
}

/// The path as it may look in motion: at every joint the points around it are moved and turned together.
BezierPath deformed(Generator& generator, const BezierPath& path, double turn) {
  BezierPath moved = path;
  const auto carry = [&](int segment, int first, const Eigen::Isometry3d& motion) {
    Eigen::Matrix4d points = moved.segments[segment].points();
    points.middleCols(first, 2) = (motion.matrix() * points.middleCols(first, 2)).eval();
    moved.segments[segment] = RationalCubic(points);
  };
  const int count = int(path.segments.size());
  for (int node = 0; node <= count; ++node) {
    const Eigen::Vector3d about =
        node < count ? path.segments[node].control_point(0) : path.segments[node - 1].control_point(3);
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(about + 0.01 * random_point(generator)) *
        Eigen::AngleAxisd(uniform(generator, -turn, turn), random_point(generator).normalized()) *
        Eigen::Translation3d(-about);
    if (node > 0) carry(node - 1, 2, motion);
    if (node < count) carry(node, 0, motion);
  }
  return moved;
}

const std::vector<RunPart> three_bends{{0.42}, {0.08, pi / 2}, {0.24}, {0.08, pi / 2},
                                       {0.44}, {0.08, pi / 2}, {0.32}};

TEST(SmoothNurbs, ARunOfLinesAndArcsIsC1OfDegreeTwoWithMildWeights) {
  const std::vector<RunPart> uneven{{10}, {0.1, pi / 2}, {100},  {0.1, pi / 6},
                                    {5},  {0.3, pi / 2}, {0.01}, {0.1, 1}};
  const std::vector<RunPart> return_bend{{1}, {0.1, pi / 2}, {0.1, pi / 2, true}, {1}};
  std::vector<RunPart> twenty_bends;
  for (int i = 0; i < 20; ++i) twenty_bends.insert(twenty_bends.end(), {{0.3}, {0.1, pi / 2}});
  for (const std::vector<RunPart>& parts : {three_bends, uneven, return_bend, twenty_bends})
    for (const int cuts : {1, 3}) {
      SCOPED_TRACE(::testing::Message() << parts.size() << " parts in " << cuts << " pieces");
      const BezierPath path = pipe_run(parts, cuts);
      const double tolerance = 2e-13 * path.length();
      const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, tolerance);
      const auto arcs =
          std::count_if(parts.begin(), parts.end(), [](const RunPart& p) { return p.angle > 0; });
      EXPECT_EQ(smooth.curve.degree(), 2);
      EXPECT_EQ(largest_interior_multiplicity(smooth.curve), 1);
      EXPECT_LE(smooth.curve.control_points().cols(), 1.5 * double(1 + int(parts.size()) + arcs));
      EXPECT_LE(ratio_of_weights(smooth.curve), 10);
      EXPECT_LE(ratio_of_speeds(smooth.curve), 4);
      EXPECT_LE(smooth.deviation, tolerance);
      EXPECT_LE(distance(smooth.curve, path), tolerance);
    }
}

TEST(SmoothNurbs, ArcsThatMeetWithoutALineAreC1OfDegreeThree) {
  for (const int turns : {1, 2, 5}) {  // in quarters
    std::vector<RunPart> parts;
    for (int i = 0; i < 4 * turns; ++i) parts.push_back({0.1 + 0.05 * (i % 2), pi / 2});
    const BezierPath path = pipe_run(parts, 2);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 1e-12);
    EXPECT_EQ(smooth.curve.degree(), 3);
    EXPECT_EQ(largest_interior_multiplicity(smooth.curve), 2);
    EXPECT_LE(ratio_of_weights(smooth.curve), 10);
    EXPECT_LE(ratio_of_speeds(smooth.curve), 4);
    EXPECT_LE(distance(smooth.curve, path), 1e-12);
  }
}

TEST(SmoothNurbs, ADeformedRunOfLinesAndArcsIsC1OfDegreeFour) {
  // No cubic is: through arcs the slope of the weight can only grow, and a cubic that bends has no other
  // weights (up to w_i -> c^i w_i).
  Generator generator(81);
  for (const int cuts : {2, 5}) {
    const BezierPath path = deformed(generator, pipe_run(three_bends, cuts), 0.05);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 1e-12);
    EXPECT_EQ(smooth.curve.degree(), 4);
    EXPECT_EQ(smooth.curve.control_points().cols(), 3 * int(path.segments.size()) + 2);
    EXPECT_EQ(largest_interior_multiplicity(smooth.curve), 3);
    EXPECT_LE(ratio_of_weights(smooth.curve), 10);
    EXPECT_LE(smooth.deviation, 1e-12);
    // Every joint of the cubics is a break of the curve, and from one to the next both are the same points.
    const std::vector<double> breaks = smooth.curve.knots().breaks();
    ASSERT_EQ(breaks.size(), path.segments.size() + 1);
    for (std::size_t j = 0; j < path.segments.size(); ++j) {
      const std::vector<RationalCubic> cubic{path.segments[j]};
      for (double u = 0; u <= 1; u += 0.125)
        EXPECT_LE(
            closest_point(cubic, smooth.curve.point(breaks[j] + u * (breaks[j + 1] - breaks[j]))).distance,
            1e-12);
    }
  }
}

TEST(SmoothNurbs, AMildSmoothChainGetsDoubleKnotsThroughout) {
  Generator generator(74);
  for (int i = 0; i < 80; ++i) {
    const int count = 2 + i % 20;
    const BezierPath path = smooth_chain(generator, count, 1, 1.01);
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 1e-12);
    ASSERT_EQ(smooth.curve.degree(), 3);
    ASSERT_EQ(smooth.curve.control_points().cols(), 2 * count + 2) << i;
    ASSERT_EQ(largest_interior_multiplicity(smooth.curve), 2);
    ASSERT_LE(smooth.deviation, 1e-12);
    ASSERT_LE(distance(smooth.curve, path), 1e-12);
  }
}

TEST(SmoothNurbs, AWildSmoothChainStaysWhereItIsWithFullKnotsWhereItMust) {
  Generator generator(75);
  int smooth_joints = 0, joints = 0;
  for (int i = 0; i < 80; ++i) {
    const int count = 2 + i % 40;
    const BezierPath path = smooth_chain(generator, count, 0.3, 1.5);
    const double tolerance = 1e-13 * path.length();
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, tolerance);
    ASSERT_LE(smooth.deviation, tolerance);
    const auto on_curve = [&](double t) {
      return smooth.curve.point(std::lerp(smooth.curve.knots().start(), smooth.curve.knots().end(), t));
    };
    ASSERT_LE(largest_distance(on_curve, path.segments), tolerance);
    const int degree = smooth.curve.degree(), poles = int(smooth.curve.control_points().cols());
    ASSERT_LE(poles, 3 * count + (degree == 4 ? 2 : 1));
    smooth_joints += degree == 4 ? count - 1 : 3 * count + 1 - poles;
    joints += count - 1;
    const Eigen::RowVectorXd weights = smooth.curve.control_points().row(3);
    ASSERT_GT(weights.minCoeff(), 0);
  }
  EXPECT_GT(smooth_joints, joints / 2);
}

TEST(SmoothNurbs, TheSpeedIsContinuousEvenAcrossFullKnots) {
  Generator generator(76);
  for (int i = 0; i < 100; ++i) {
    const SmoothNurbs smooth =
        smooth_nurbs(smooth_chain(generator, 10, 0.3, 1.5), CurveParameter::free, 1e-12);
    const NurbsCurve& curve = smooth.curve;
    const NurbsCurve back = curve.reversed();  // its derivative at a knot is that from the other side
    const std::vector<double> breaks = curve.knots().breaks(), breaks_back = back.knots().breaks();
    for (std::size_t j = 1; j + 1 < breaks.size(); ++j) {
      const Eigen::Vector3d after = curve.derivatives(breaks[j], 1).col(1);
      const Eigen::Vector3d before = -back.derivatives(breaks_back[breaks.size() - 1 - j], 1).col(1);
      ASSERT_LE((before - after).norm(), 1e-9 * after.norm());
    }
  }
}

TEST(SmoothNurbs, ACornerKeepsItsFullKnot) {
  Eigen::Matrix3Xd points(3, 3);
  points << 0, 1, 1, 0, 0, 1, 0, 0, 0;
  const NurbsCurve corner = make_nurbs_curve(KnotVector(1, {0, 0, 1, 2, 2}), points, Eigen::Vector3d::Ones());
  Generator generator(77);
  const SmoothNurbs smooth = smooth_nurbs(in_pieces(generator, corner, 5), CurveParameter::free, 1e-13);
  EXPECT_EQ(smooth.curve.degree(), 1);
  EXPECT_EQ(smooth.curve.control_points().cols(), 3);
  EXPECT_LE((smooth.curve.point(1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-14);
}

TEST(SmoothNurbs, MaterialParameterKeepsEveryPointAtItsParameter) {
  Generator generator(78);
  for (int i = 0; i < 80; ++i) {
    const NurbsCurve source = smooth_spline(generator, 3, 1 + i % 12);
    // The source's own parameter, in thirds of spans: every knot but the source's is removable.
    const BezierPath whole = BezierPath::from_nurbs(source, 0);
    BezierPath path{{}, {whole.breaks.front()}, 0};
    for (std::size_t j = 0; j < whole.segments.size(); ++j)
      for (int k = 0; k < 3; ++k) {
        path.segments.push_back(whole.segments[j].piece(k / 3.0, (k + 1) / 3.0));
        path.breaks.push_back(whole.breaks[j] + (k + 1) / 3.0 * (whole.breaks[j + 1] - whole.breaks[j]));
      }
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::material, 1e-12);
    ASSERT_EQ(smooth.curve.control_points().cols(), source.control_points().cols());
    for (double t = 0; t <= 1; t += 0.01) {
      const double u = source.knots().start() + t * (source.knots().end() - source.knots().start());
      ASSERT_LE((smooth.curve.point(u) - source.point(u)).norm(), 1e-12);
    }
    // In an uneven parameter of the same shape the joints of the lossless form stay.
    const BezierPath chain = smooth_chain(generator, 1 + i % 12, 0.9, 1.1);
    const SmoothNurbs kept = smooth_nurbs(chain, CurveParameter::material, 1e-12);
    for (std::size_t j = 0; j < chain.segments.size(); ++j)
      for (double t = 0; t <= 1; t += 0.25) {
        const double u = chain.breaks[j] + t * (chain.breaks[j + 1] - chain.breaks[j]);
        ASSERT_LE((kept.curve.point(u) - chain.segments[j].point(t)).norm(), 1e-12);
      }
  }
}

TEST(SmoothNurbs, TheBoundIsAboveEveryMeasuredDistanceAndNotIdle) {
  // Tolerances far above round-off make the bound work for its living.
  Generator generator(79);
  double largest_share = 0;
  for (int i = 0; i < 80; ++i) {
    BezierPath path = in_pieces(generator, weighted(generator, smooth_spline(generator, 3, 4), 0.7, 1.3), 2);
    for (RationalCubic& segment : path.segments) {
      Eigen::Matrix4d points = segment.points();
      for (int k = 1; k < 3; ++k) points.col(k).head<3>() += 1e-6 * points(3, k) * random_point(generator);
      segment = RationalCubic(points);
    }
    const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 2e-5);
    ASSERT_LE(smooth.deviation, 2e-5);
    const double measured = distance(smooth.curve, path);
    ASSERT_LE(measured, smooth.deviation * (1 + 1e-6) + 1e-13);
    ASSERT_LT(smooth.curve.control_points().cols(), 3 * int(path.segments.size()) + 1);
    largest_share = std::max(largest_share, measured / smooth.deviation);
  }
  EXPECT_GT(largest_share, 0.02);
}

TEST(SmoothNurbs, APlaceFarFromTheOriginCostsNoControlPoints) {
  Generator generator(80);
  const NurbsCurve source = smooth_spline(generator, 3, 6);
  Eigen::Matrix4Xd points = source.control_points();
  points.topRows<3>() += Eigen::Vector3d(1000, -2000, 500) * points.row(3);
  const BezierPath path = in_pieces(generator, {source.knots(), points}, 3);
  const SmoothNurbs smooth = smooth_nurbs(path, CurveParameter::free, 1e-11);
  EXPECT_EQ(smooth.curve.control_points().cols(), source.control_points().cols());
  EXPECT_LE(distance(smooth.curve, path), 1e-11);
}

TEST(SmoothNurbs, RefusesAnEmptyPath) {
  EXPECT_THROW(smooth_nurbs(BezierPath{}, CurveParameter::free, 1e-9), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
