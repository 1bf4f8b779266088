#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "pipelines/model/build_model.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

using std::numbers::pi;

/// A circle of radius 0.5 m about the origin as four rational quadratic quarters, from an angle on that is a
/// multiple of 90 degrees.
std::string circle(int quarters) {
  std::ostringstream points;
  for (int i = 0; i < 9; ++i) {
    const int corner = (i + 2 * quarters) % 8;
    const double x[] = {1, 1, 0, -1, -1, -1, 0, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1};
    points << (i ? ", " : "") << '[' << 0.5 * x[corner] << ", " << 0.5 * y[corner] << ", 0]";
  }
  return R"({"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], "control_points": [)" +
         points.str() +
         R"(], "weights": [1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1]}})";
}

std::string ring_case(const std::string& axis, const std::string& rest) {
  return R"({"nurbeam": 1, "gravity": [0, 0, 0], "beams": [{"name": "ring", "closed": true, "axis": )" +
         axis +
         R"(, "section": {"radius": "5 mm"}, "material": {"density": 7800, "youngs_modulus": "20 GPa"},
             "elements": {"count": 24}}], )" +
         rest + "}";
}

CaseRun run_ring(const std::string& axis, const std::string& rest,
                 const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("ring.json", ring_case(axis, rest)), overrides);
}

TEST(RingRun, PulledByTwoForcesItGivesWayAsTheFormulasSay) {
  // Timoshenko, Strength of Materials II: diameters change by (pi/4 - 2/pi) P R^3 / EI along the forces and
  // (2/pi - 1/2) P R^3 / EI across them, but for the stretch, which is of the order (r/R)^2 = 1e-4 of that.
  const double R = 0.5, EI = 20e9 * pi * std::pow(0.005, 4) / 4, P = 0.01;
  const CaseRun run = run_ring(circle(0), R"(
    "supports": [{"beam": "ring", "at": {"near": [0, -0.5, 0]}, "type": "clamped"}],
    "loads": [{"beam": "ring", "at": {"near": [0, 0.5, 0]}, "force": [0, 0.01, 0]}],
    "analysis": {"type": "static"},
    "output": {"probes": [{"name": "top", "beam": "ring", "at": {"near": [0, 0.5, 0]}},
                          {"name": "right", "beam": "ring", "at": "start"},
                          {"name": "left", "beam": "ring", "at": {"fraction": 0.5}}]})",
                               {"beams[0].elements.count=96"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double unit = P * R * R * R / EI;
  EXPECT_NEAR((run.last("top.y [m]") - R) / unit, pi / 4 - 2 / pi, 3e-5);
  EXPECT_NEAR((run.last("right.x [m]") - run.last("left.x [m]") - 2 * R) / unit, -(2 / pi - 0.5), 3e-5);
  EXPECT_NEAR(run.last("top.x [m]") / unit, 0, 1e-9);
}

const char* const slider_rest = R"("bodies": [{"name": "bead", "mass": 0.5}],
    "sliding_joints": [{"body": "bead", "beam": "ring", "at": {"near": [0, 0.5, 0]}, "speed": 6}],
    "analysis": {"end_time": 1.6, "step": "0.5 ms"},
    "output": {"every": 0.01, "probes": [{"name": "p", "beam": "ring", "at": {"near": [-0.5, 0, 0]}}]})";

TEST(RingRun, ABeadGoesRoundAFreeRingSeveralTimesAndKeepsItsEnergy) {
  const CaseRun run = run_ring(circle(0), slider_rest);
  ASSERT_EQ(run.code, 0) << run.messages;
  const double L = pi, start = run.value(0, "energy.total [J]");
  int seams = 0;
  double before = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double s = run.value(i, "bead.s [m]");
    ASSERT_GE(s, 0);
    ASSERT_LT(s, L);
    if (s < before - L / 2) ++seams;
    before = s;
    EXPECT_NEAR(run.value(i, "energy.total [J]"), start, 2e-3 * start);
  }
  EXPECT_GE(seams, 3);
  EXPECT_EQ(run.messages.find("end"), std::string::npos) << run.messages;
}

TEST(RingRun, WhereTheSeamLiesChangesNothing) {
  const std::vector<std::string> shorter = {"analysis.end_time=0.5"};
  const CaseRun first = run_ring(circle(0), slider_rest, shorter);
  for (const int quarters : {1, 3}) {
    const CaseRun other = run_ring(circle(quarters), slider_rest, shorter);
    ASSERT_EQ(other.rows.size(), first.rows.size());
    for (const char* column : {"bead.x [m]", "bead.y [m]", "p.x [m]", "p.y [m]", "ring.length [m]"})
      EXPECT_NEAR(other.last(column), first.last(column), 1e-7) << column;
  }
}

TEST(RingRun, TheDeformedRingIsExportedAsOneSmoothClosedCurve) {
  const TemporaryDirectory directory;
  const auto file = directory.write("ring.json", ring_case(circle(0), slider_rest));
  std::ostringstream out, err;
  const CapturedErrors errors;
  ASSERT_EQ(run_command_line({"run", file.string(), "--quiet", "--out", (directory.path() / "r").string(),
                              "--set", "analysis.end_time=0.1", "--set", R"(output.cad={"times": [0.1]})"},
                             out, err),
            0);
  const ImportReport report = import_curves(directory.path() / "r" / "deformed_t0.1.step");
  ASSERT_EQ(report.curves.size(), 1u);
  const NurbsCurve& curve = report.curves[0].curve;
  EXPECT_TRUE(is_closed(curve, 1e-12));
  const Eigen::Vector3d start = curve.derivatives(curve.knots().start(), 1).col(1).normalized();
  const Eigen::Vector3d end = curve.derivatives(curve.knots().end(), 1).col(1).normalized();
  EXPECT_LT((start - end).norm(), 1e-9);
}

std::string nurbs_axis(const NurbsCurve& curve) {
  std::ostringstream knots, points, weights;
  for (auto* stream : {&knots, &points, &weights}) stream->precision(17);
  for (const double u : curve.knots().knots()) knots << (knots.tellp() > 0 ? ", " : "") << u;
  for (const auto& column : curve.control_points().colwise()) {
    const Eigen::Vector3d p = column.head<3>() / column(3);
    points << (points.tellp() > 0 ? ", [" : "[") << p.x() << ", " << p.y() << ", " << p.z() << ']';
    weights << (weights.tellp() > 0 ? ", " : "") << column(3);
  }
  return R"({"nurbs": {"degree": )" + std::to_string(curve.degree()) + R"(, "knots": [)" + knots.str() +
         R"(], "control_points": [)" + points.str() + R"(], "weights": [)" + weights.str() + "]}}";
}

/// An ellipse about the origin from its rightmost point on, in quarters, as wide and high as given [m].
NurbsCurve oval(double width, double height) {
  Eigen::Matrix4Xd points(4, 9);
  for (int i = 0; i < 9; ++i) {
    const double x[] = {1, 1, 0, -1, -1, -1, 0, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1};
    const double weight = i % 2 ? std::sqrt(0.5) : 1;
    points.col(i) << weight * 0.5 * width * x[i % 8], weight * 0.5 * height * y[i % 8], 0, weight;
  }
  return {KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), points};
}

/// A closed cubic spline of eight spans that is C2 everywhere, at its seam too, and a mirror image of itself
/// in x; in space where `rise` is not 0 [m].
NurbsCurve closed_spline(double rise) {
  // d(k) = f(k - 1, k, k + 1), the blossom of the periodic spline.
  const auto d = [&](int k) {
    const double angle = 0.25 * pi * k;
    return Eigen::Vector3d((0.5 + 0.05 * std::cos(2 * angle)) * std::cos(angle), 0.4 * std::sin(angle),
                           rise * std::cos(2 * angle));
  };
  const Eigen::Vector3d seam = (d(-1) + 4 * d(0) + d(1)) / 6;  // f(0, 0, 0)
  Eigen::Matrix3Xd points(3, 11);
  points << seam, (2 * d(0) + d(1)) / 3, d(1), d(2), d(3), d(4), d(5), d(6), d(7), (d(7) + 2 * d(8)) / 3,
      seam;
  return make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8}), points,
                          Eigen::VectorXd::Ones(11));
}

/// Position, unit tangent and curvature vector where a span of a curve begins.
struct Contact {
  Eigen::Vector3d point, tangent, curvature;
};

Contact contact(const NurbsCurve& curve, double u) {
  const Eigen::Matrix3Xd r = curve.derivatives(u, 2);
  const Eigen::Vector3d first = r.col(1), second = r.col(2), tangent = first.normalized();
  return {r.col(0), tangent, (second - second.dot(tangent) * tangent) / first.squaredNorm()};
}

/// Where a ring of one file, a mirror image of itself in x, closes.
struct Seam {
  double gap;        // [m]
  double turn;       // of the unit tangent
  double curvature;  // [1/m]
  double jump;       // of the curvature vector [1/m]
  double jump_opposite = 0;
  double largest_jump = 0;  // at the other knots
};

Seam seam_of(const std::filesystem::path& file) {
  const ImportReport report = import_curves(file);
  EXPECT_EQ(report.curves.size(), 1u);
  const NurbsCurve curve = report.curves.at(0).curve, back = curve.reversed();
  const std::vector<double> breaks = curve.knots().breaks(), breaks_back = back.knots().breaks();
  const std::size_t last = breaks.size() - 1;
  const Contact start = contact(curve, breaks.front()), end = contact(back, breaks_back.front());
  Seam seam{(start.point - end.point).norm(), (start.tangent + end.tangent).norm(), start.curvature.norm(),
            (start.curvature - end.curvature).norm()};
  const Eigen::Vector3d opposite(-start.point.x(), start.point.y(), start.point.z());
  for (std::size_t j = 1; j < last; ++j) {
    const Contact left = contact(back, breaks_back[last - j]), right = contact(curve, breaks[j]);
    const double jump = (left.curvature - right.curvature).norm();
    seam.largest_jump = std::max(seam.largest_jump, jump);
    if ((left.point - opposite).norm() < 1e-6) seam.jump_opposite = jump;
  }
  return seam;
}

TEST(RingRun, IsExportedAsSmoothAtItsSeamAsAtItsOtherNodes) {
  // Held at the bottom and pulled at the top each ring stays a mirror image of itself in x: what the seam, at
  // the right, is, the node at the left must be, too.
  for (const NurbsCurve& drawn : {oval(1, 0.6), closed_spline(0), closed_spline(0.05)}) {
    const TemporaryDirectory directory;
    const auto file = directory.write("ring.json", ring_case(nurbs_axis(drawn), R"(
        "supports": [{"beam": "ring", "at": {"fraction": 0.75}, "type": "pinned"}],
        "loads": [{"beam": "ring", "at": {"fraction": 0.25}, "force": [0, 200, 0]}],
        "analysis": {"end_time": 0.05, "step": "0.5 ms"},
        "output": {"every": 0.05, "cad": {"formats": ["step", "iges"], "times": [0, 0.05]}})"));
    const auto results = directory.path() / "r";
    std::ostringstream out, err;
    const CapturedErrors errors;
    ASSERT_EQ(run_command_line({"run", file.string(), "--quiet", "--out", results.string()}, out, err), 0)
        << err.str() << errors.text();
    for (const char* const format : {".step", ".igs"}) {
      SCOPED_TRACE(format);
      const Seam before = seam_of(results / ("deformed_t0" + std::string(format)));
      EXPECT_LE(before.gap, 1e-14);
      EXPECT_LE(before.turn, 1e-11);
      EXPECT_LE(before.jump, 1e-11 * before.curvature);  // as drawn it is C2
      const Seam after = seam_of(results / ("deformed_t0.05" + std::string(format)));
      EXPECT_LE(after.gap, 1e-14);
      EXPECT_LE(after.turn, 1e-11);
      EXPECT_GT(std::abs(after.curvature - before.curvature), 0.2 * before.curvature);
      EXPECT_NEAR(after.jump, after.jump_opposite, 1e-5 * after.curvature);
      EXPECT_LT(after.jump, after.largest_jump);
    }
  }
}

TEST(RingRun, APrescribedMotionGoesRoundAsOftenAsItSays) {
  const CaseRun run = run_ring(circle(0), R"("bodies": [{"name": "bead", "mass": 0.1}],
    "supports": [{"beam": "ring", "at": "start", "type": "clamped"}, {"beam": "ring", "at": {"fraction": 0.5}, "type": "clamped"}],
    "sliding_joints": [{"body": "bead", "beam": "ring", "at": {"fraction": 0.25}, "motion": {"speed": -2}}],
    "analysis": {"end_time": 3.5, "step": "5 ms"}, "output": {"every": 0.1})");
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double s = pi / 4 - 2 * run.value(i, "time [s]");
    EXPECT_NEAR(std::remainder(run.value(i, "bead.s [m]") - s, pi), 0, 1e-8);
  }
}

TEST(RingRun, APrescribedSpeedIsThatOfTheLastMomentToo) {
  for (const char* end : {"0.3", "0.35", "0.4", "0.8"}) {
    const CaseRun run = run_ring(circle(0), R"("bodies": [{"name": "bead", "mass": 0.1}],
      "supports": [{"beam": "ring", "at": "start", "type": "clamped"}],
      "sliding_joints": [{"body": "bead", "beam": "ring", "at": {"fraction": 0.25}, "motion": {"speed": 3.3}}],
      "analysis": {"end_time": )" + std::string(end) +
                                                R"(, "step": "1 ms"}, "output": {"every": 0.05})");
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("bead.speed [m/s]"), 3.3, 0.5) << end;  // the ring gives way
  }
}

struct Refused {
  std::vector<std::string> overrides;
  const char* place;
  std::vector<const char*> parts;
};

TEST(RingRun, WhatIsNoRingIsRefused) {
  const std::string arc =
      R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, -1, 0], "normal": [0, 0, 1]}})";
  const std::vector<Refused> cases = {
      {{arc}, "beams[0].closed", {"starts at (1, 0, 0) m", "1.414213562 m apart", "leave \"closed\" out"}},
      {{R"(beams[0].axis={"nurbs": {"degree": 3, "knots": [0,0,0,0,1,1,1,1], "control_points": [[0,0,0],[1,1,0],[-1,1,0],[0,0,0]]}})"},
       "beams[0].closed",
       {"corner of 90 degrees at its seam"}},
      {{"beams[0].weights=constant"}, "beams[0].weights", {"a ring needs \"material\""}},
      {{"beams[0].metric=none", "beams[0].curvature=spatial"}, "beams[0].metric", {"a ring needs"}},
      {{"beams[0].corners=hinge"}, "beams[0].corners", {"\"hinge\" is not available on a ring"}},
      {{"beams[0].corners=rigid"}, "beams[0].corners", {"\"rigid\" is not available on a ring"}},
      {{"beams[0].elements.count=4"}, "beams[0].elements", {"gives 4 elements", "at least 6"}}};
  for (const Refused& refused : cases) {
    const CaseRun run = run_ring(circle(0), slider_rest, refused.overrides);
    EXPECT_EQ(run.code, 2) << run.messages;
    EXPECT_TRUE(run.says(refused.place)) << run.messages;
    for (const char* part : refused.parts) EXPECT_TRUE(run.says(part)) << run.messages;
  }
}

TEST(RingRun, ACornerIsNotOfferedWhatARingHasNot) {
  const CaseRun run =
      run_ring(R"({"polyline": [[0.5, 0, 0], [1, 0, 0], [0.5, 1, 0], [0, 0, 0], [0.5, 0, 0]]})", slider_rest);
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("round the corner")) << run.messages;
  EXPECT_FALSE(run.says("\"rigid\"")) << run.messages;
}

TEST(RingRun, AClosedAxisWithoutTheKeyIsOpenAndSaysSo) {
  const TemporaryDirectory directory;
  const CaseFileReport report =
      read_case_file(directory.write("ring.json", ring_case(circle(0), R"("analysis": {"end_time": 1})")),
                     {"beams[0].closed=false"});
  const BuildReport built = build_model(report.value.value());
  ASSERT_TRUE(built.value);
  EXPECT_FALSE(built.value->model.beams[0].is_ring());
  ASSERT_EQ(built.diagnostics.size(), 1u);
  EXPECT_EQ(built.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(built.diagnostics[0].message.find("\"closed\": true makes it a ring"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam::test
