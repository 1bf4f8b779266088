// A frame drawn as one beam whose corner is kept: from its case file to its CAD file.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "cad_import/import_curves.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

using test::CaseRun;
using test::TemporaryDirectory;

// A column of 1 m, clamped at its foot, and an arm of 1 m from its top; steel rods of radius 10 mm.
constexpr const char* frame = R"({
  "nurbeam": 1,
  "gravity": [0, 0, 0],
  "beams": [{ "name": "frame", "axis": { "polyline": [[0, 0, 0], [0, 1, 0], [1, 1, 0]] }, "corners": "rigid",
              "section": { "radius": 0.01 }, "material": { "density": 7800, "youngs_modulus": 210e9 },
              "elements": { "count": 16 } }],
  "supports": [{ "beam": "frame", "at": "start", "type": "clamped" }],
  "analysis": { "type": "static" },
  "output": { "probes": [{ "name": "corner", "beam": "frame", "at": { "fraction": 0.5 } },
                         { "name": "tip", "beam": "frame", "at": "end" }] }
})";

constexpr double corner_EA = 210e9 * std::numbers::pi * 1e-4, EI = 210e9 * std::numbers::pi * 1e-8 / 4;

CaseRun run_frame(const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return test::run_file(directory.write("frame.json", frame), overrides);
}

TEST(RigidCornerRun, ACornerCarriesTheMomentAsTheTheoryOfFramesSays) {
  const CaseRun run = run_frame({R"(loads=[{"beam": "frame", "at": "end", "force": [0, -0.01, 0]}])"});
  ASSERT_EQ(run.code, 0) << run.messages;
  // The moment P L bends the column, which turns the corner by P L h/(E I) and moves it by P L h²/(2 E I).
  const double P = 0.01, corner = P / (2 * EI);
  EXPECT_NEAR(run.last("corner.x [m]"), corner, 1e-5 * corner);
  EXPECT_NEAR(run.last("tip.y [m]") - 1, -(P / (3 * EI) + P / EI + P / corner_EA), 1e-5 * P / EI);
}

TEST(RigidCornerRun, AMomentAtTheCornerTurnsTheArmWithTheColumn) {
  const double M = 0.01;
  const CaseRun run =
      run_frame({R"(loads=[{"beam": "frame", "at": {"fraction": 0.5}, "moment": [0, 0, 0.01]}])"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("corner.x [m]"), -M / (2 * EI), 1e-5 * M / EI);
  EXPECT_NEAR(run.last("tip.y [m]") - 1, M / EI, 1e-5 * M / EI);
}

// Out of its plane an arm of 1 m bends and twists its column of 1 m: P (L³/3 EI + h³/3 EI + h L²/GJ).
TEST(RigidCornerRun, AnArmInSpaceIsHeldAcrossToo) {
  const double P = 0.01, GJ = 210e9 / 2.6 * std::numbers::pi * 1e-8 / 2, across = P * (2 / (3 * EI) + 1 / GJ);
  const std::vector<std::string> load = {R"(loads=[{"beam": "frame", "at": "end", "force": [0, 0, 0.01]}])"};
  const CaseRun one = run_frame(load);
  ASSERT_EQ(one.code, 0) << one.messages;
  EXPECT_NEAR(one.last("tip.z [m]"), across, 1e-3 * across);
  const TemporaryDirectory directory;
  const CaseRun two = test::run_file(
      directory.write("frame.json", frame),
      {R"(beams=[{"name": "column", "axis": {"polyline": [[0, 0, 0], [0, 1, 0]]}, "section": {"radius": 0.01},
                  "material": {"density": 7800, "youngs_modulus": 210e9}, "elements": {"count": 8}},
                 {"name": "arm", "axis": {"polyline": [[0, 1, 0], [1, 1, 0]]}, "section": {"radius": 0.01},
                  "material": {"density": 7800, "youngs_modulus": 210e9}, "elements": {"count": 8}}])",
       R"(joints=[{"beams": ["column", "arm"], "type": "rigid"}])",
       R"(supports=[{"beam": "column", "at": "start", "type": "clamped"}])",
       R"(output.probes=[{"name": "tip", "beam": "arm", "at": "end"}])",
       R"(loads=[{"beam": "arm", "at": "end", "force": [0, 0, 0.01]}])"});
  ASSERT_EQ(two.code, 0) << two.messages;
  EXPECT_NEAR(two.last("tip.z [m]"), across, 1e-3 * across);
}

// The frame falls in space: what moves it.
std::vector<std::string> falling(const std::string& analysis) {
  return {"gravity=[3, -5, 8]", "beams[0].material.youngs_modulus=2e8", "output.every=0.02",
          "analysis=" + analysis};
}

// Its two parts as beams of their own, joined.
const std::vector<std::string> parts = {
    R"(beams=[{"name": "column", "axis": {"polyline": [[0, 0, 0], [0, 1, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 7800, "youngs_modulus": 2e8}, "elements": {"count": 8}},
              {"name": "arm", "axis": {"polyline": [[0, 1, 0], [1, 1, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 7800, "youngs_modulus": 2e8}, "elements": {"count": 8}}])",
    R"(joints=[{"beams": ["column", "arm"], "type": "rigid"}])",
    R"(supports=[{"beam": "column", "at": "start", "type": "clamped"}])",
    R"(output.probes=[{"name": "corner", "beam": "arm", "at": "start"},
                      {"name": "tip", "beam": "arm", "at": "end"}])"};

constexpr const char* generalized_alpha =
    R"({"end_time": 0.2, "step": 5e-4, "integrator": {"type": "generalized-alpha", "rho_infinity": 1}})";

double largest_difference(const CaseRun& a, const CaseRun& b) {
  double largest = 0;
  for (std::size_t row = 0; row < a.rows.size(); ++row)
    for (const char* column :
         {"corner.x [m]", "corner.y [m]", "corner.z [m]", "tip.x [m]", "tip.y [m]", "tip.z [m]"})
      largest = std::max(largest, std::abs(a.value(row, column) - b.value(row, column)));
  return largest;
}

TEST(RigidCornerRun, OneBeamMovesInSpaceAsTwoThatAreJoined) {
  std::vector<std::string> joined = falling(generalized_alpha);
  joined.insert(joined.end(), parts.begin(), parts.end());
  const CaseRun one = run_frame(falling(generalized_alpha)), two = run_frame(joined);
  ASSERT_EQ(one.code, 0) << one.messages;
  ASSERT_EQ(two.code, 0) << two.messages;
  ASSERT_EQ(one.rows.size(), 11u);
  ASSERT_EQ(two.rows.size(), 11u);
  EXPECT_LT(largest_difference(one, two), 1e-11);
  EXPECT_GT(one.last("tip.z [m]"), 0.1);
}

TEST(RigidCornerRun, TheIntegratorsAgree) {
  const CaseRun radau =
      run_frame(falling(R"({"end_time": 0.2, "tolerance": 1e-9, "integrator": {"type": "radau"}})"));
  ASSERT_EQ(radau.code, 0) << radau.messages;
  const CaseRun rk4 = run_frame(falling(R"({"end_time": 0.2, "step": 1e-4, "integrator": {"type": "rk4"}})"));
  ASSERT_EQ(rk4.code, 0) << rk4.messages;
  const CaseRun alpha = run_frame(falling(
      R"({"end_time": 0.2, "step": 1e-4, "integrator": {"type": "generalized-alpha", "rho_infinity": 1}})"));
  ASSERT_EQ(alpha.code, 0) << alpha.messages;
  EXPECT_LT(largest_difference(radau, rk4), 1e-7);
  EXPECT_LT(largest_difference(radau, alpha), 2e-6);
}

// Runs the frame with overrides into `results`, and keeps what it says to itself.
int run_into(const std::filesystem::path& results, const std::vector<std::string>& overrides) {
  const TemporaryDirectory directory;
  std::vector<std::string> words = {"run", directory.write("frame.json", frame), "--quiet", "--out", results};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  std::ostringstream out, err;
  const test::CapturedErrors errors;
  return run_command_line(words, out, err);
}

NurbsCurve only_curve(const std::filesystem::path& file) { return import_curves(file).curves.at(0).curve; }

// Of the unit tangents on both sides of a parameter.
double cosine_across(const NurbsCurve& curve, double s) {
  const double beside = 1e-9 * curve.knots().end();
  const auto tangent = [&](double at) -> Eigen::Vector3d {
    return curve.derivatives(at, 1).col(1).normalized();
  };
  return tangent(s - beside).dot(tangent(s + beside));
}

TEST(RigidCornerRun, TheCornerIsStillInTheCurveThatIsWritten) {
  const TemporaryDirectory results;
  std::vector<std::string> overrides = falling(generalized_alpha);
  overrides.push_back(R"(output.cad={"times": [0.2], "parameter": "material"})");
  ASSERT_EQ(run_into(results.path() / "results", overrides), 0);
  CaseRun run{};
  test::read_histories(results.path() / "results" / "histories.csv", run);
  const NurbsCurve curve = only_curve(results.path() / "results" / "deformed_t0.2.step");
  // The parameter is the material point: the corner is where it was drawn, and as sharp.
  const Eigen::Vector3d corner(run.last("corner.x [m]"), run.last("corner.y [m]"), run.last("corner.z [m]"));
  EXPECT_LT((curve.point(1) - corner).norm(), 1e-9);
  EXPECT_GT((corner - Eigen::Vector3d(0, 1, 0)).norm(), 0.1);
  EXPECT_NEAR(cosine_across(curve, 1), 0, 1e-7);
}

// A line, a quarter of a circle and a spline that meet at 90 and 61 degrees.
TEST(RigidCornerRun, ACompositeCurveOfACadFileComesBackWithItsCorners) {
  const TemporaryDirectory directory;
  const auto results = directory.path() / "results";
  const std::string file = test::source_directory() / "tests/corpus/iges-102-composite.igs";
  const std::vector<std::string> wire = {R"(beams[0].axis={"file": ")" + file + "\"}",
                                         "beams[0].section.radius=3e-4",
                                         "beams[0].material.youngs_modulus=2e9",
                                         "beams[0].stress_free=as-drawn-without-torsion",
                                         "gravity=[0, -9.81, 4]",
                                         R"(analysis={"end_time": 0.02, "tolerance": 1e-4})",
                                         R"(output.cad={"times": [0, 0.02], "parameter": "material"})"};
  ASSERT_EQ(run_into(results, wire), 0);
  std::ostringstream out, err;
  const std::string first = results / "deformed_t0.step";
  // Its spline has a kink of 4e-7 rad, which is made smooth.
  EXPECT_EQ(run_command_line({"compare", first, file, "--tolerance", "1e-9"}, out, err), 0) << out.str();
  const NurbsCurve drawn = only_curve(first), deformed = only_curve(results / "deformed_t0.02.step");
  const double inch = 0.0254, line = inch / 2, arc = line + inch / 2 * std::numbers::pi / 2;
  for (const NurbsCurve& curve : {drawn, deformed}) {
    EXPECT_NEAR(cosine_across(curve, line), 0, 1e-6);
    EXPECT_NEAR(cosine_across(curve, arc), std::cos(60.94531807 * std::numbers::pi / 180), 1e-6);
  }
  EXPECT_GT((deformed.point(line) - drawn.point(line)).norm(), 1e-4);
}

TEST(RigidCornerRun, CheckListsTheCorners) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("frame.json", frame);
  const auto listed = [&](const std::vector<std::string>& words) {
    std::ostringstream out, err;
    EXPECT_EQ(run_command_line(words, out, err), 0) << err.str();
    return out.str();
  };
  const std::string corner = "corner    of frame at s = 1 m, ";
  EXPECT_NE(listed({"check", file}).find(corner + "rigid\n"), std::string::npos);
  EXPECT_NE(listed({"check", file, "--set", "beams[0].corners=hinge"}).find(corner + "a hinge\n"),
            std::string::npos);
}

void expect_corner_refused(const std::vector<std::string>& overrides, const std::vector<std::string>& said) {
  const CaseRun run = run_frame(overrides);
  EXPECT_EQ(run.code, 2) << run.messages;
  for (const std::string& part : said) EXPECT_TRUE(run.says(part)) << part << "\n" << run.messages;
}

TEST(RigidCornerRun, ABodyDoesNotSlideOverACorner) {
  expect_corner_refused({R"(bodies=[{"name": "bead", "mass": 1}])",
                         R"(sliding_joints=[{"body": "bead", "beam": "frame", "at": {"fraction": 0.2}}])"},
                        {"beams[0].corners: the axis has a corner of 90 degrees at (0, 1, 0) m",
                         "cannot slide over a rigid corner", "divide the beam there", "\"joints\""});
}

TEST(RigidCornerRun, InSpaceACornerThatHardlyTurnsOrTurnsBackIsRefused) {
  const std::string spatial = "gravity=[0, 0, -1]";
  expect_corner_refused({spatial, "beams[0].axis.polyline=[[0, 0, 0], [0, 1, 0], [0.01, 2, 0]]"},
                        {"beams[0].corners: is \"rigid\", but the corner at (0, 1, 0) m turns by 0.57",
                         "corners of 1.1459", "\"smooth_up_to\": 2", "\"hinge\""});
  expect_corner_refused({spatial, "beams[0].axis.polyline=[[0, 0, 0], [0, 1, 0], [0.01, 0, 0]]"},
                        {"turns by 179.4", "round it, or use \"hinge\""});
  // In the plane every angle can be kept.
  EXPECT_EQ(run_frame({"beams[0].axis.polyline=[[0, 0, 0], [0, 1, 0], [0.01, 2, 0]]"}).code, 0);
  EXPECT_EQ(run_frame({"beams[0].axis.polyline=[[0, 0, 0], [0, 1, 0], [0.01, 0, 0]]"}).code, 0);
}

}  // namespace
}  // namespace nurbeam
