// What results say of the sections of beams with torsion, against closed forms of small loads.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/rational_cubic.h"
#include "pipelines/results/results.h"
#include "pipelines/section/cgal_geometry.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/profile_file.h"

namespace nurbeam::test {
namespace {

using std::numbers::pi;

constexpr double E = 210e9, G = 80e9;

class SectionResults : public ::testing::Test {
 protected:
  /// A static case of one clamped beam with probes at both ends.
  int run(const std::string& beam, const std::string& load, const std::string& output = "") {
    directory.write("case.json",
                    R"({"nurbeam": 1, "name": "case", "gravity": [0, 0, 0], "beams": [{"name": "bar",
      "material": {"density": 7850, "youngs_modulus": 210e9, "shear_modulus": 80e9}, )" +
                        beam +
                        R"(}], "supports": [{"beam": "bar", "at": "start", "type": "clamped"}],
      "loads": [)" + load +
                        R"(], "analysis": {"type": "static"}, "output": {)" + output + R"("probes": [
        {"name": "root", "beam": "bar", "at": "start"}, {"name": "tip", "beam": "bar", "at": "end"}]}})");
    std::ostringstream out, err;
    const CapturedErrors errors;
    const int code = run_command_line(
        {"run", (directory.path() / "case.json").string(), "--quiet", "--out", results().string()}, out, err);
    messages = err.str() + errors.text();
    read_histories(results() / "histories.csv", histories);
    return code;
  }
  std::filesystem::path results() const { return directory.path() / "results"; }
  std::string text_of(const std::string& file) const {
    std::ifstream stream(results() / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryDirectory directory;
  CaseRun histories{};
  std::string messages;
};

TEST_F(SectionResults, ASkewLoadBendsARectangleAboutBothItsAxes) {
  if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  const double b = 0.03, h = 0.05, L = 1, F_y = 30, F_z = 80;
  write_profile(directory.path() / "profile.step", {rectangle(b, h)});
  ASSERT_EQ(run(R"("axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "elements": {"count": 4},
                   "section": {"profile": {"file": "profile.step"}}, "orientation": {"up": [0, 0, 1]})",
                R"({"beam": "bar", "at": "end", "force": [0, 30, 80]})"),
            0)
      << messages;
  // The section's x axis is the world's y here.
  EXPECT_NEAR(histories.last("root.moment_1 [N m]"), -F_z * L, 1e-4 * F_z);
  EXPECT_NEAR(histories.last("root.moment_2 [N m]"), F_y * L, 1e-4 * F_y);
  const double I_x = b * h * h * h / 12, I_y = h * b * b * b / 12;
  const double stress = F_z * L * h / 2 / I_x + F_y * L * b / 2 / I_y;
  EXPECT_NEAR(std::abs(histories.last("root.stress [Pa]")), stress, 1e-4 * stress);
  EXPECT_NEAR(histories.last("root.von_mises [Pa]"), stress, 1e-4 * stress);
  EXPECT_NEAR(histories.last("bar.von_mises.max [Pa]"), stress, 1e-4 * stress);
  EXPECT_NEAR(histories.last("tip.moment_1 [N m]"), 0, 1e-6);
  EXPECT_NE(text_of("run.json").find("bar.von_mises.max"), std::string::npos);
  EXPECT_NE(text_of("report.html").find("section outline [m]"), std::string::npos);
}

TEST_F(SectionResults, AShaftTwistsByTorqueOverStiffness) {
  const double r = 0.01, J = pi / 2 * std::pow(r, 4), T = 50, L = 1.5;
  ASSERT_EQ(
      run(R"("axis": {"polyline": [[0, 0, 0], [0, 0, 1.5]]}, "section": {"radius": 0.01}, "torsion": true,
                   "elements": {"count": 3})",
          R"({"beam": "bar", "at": "end", "moment": [0, 0, 50]})", R"("paraview": true, )"),
      0)
      << messages;
  const double twist = T * L / (G * J), stress = std::sqrt(3.0) * T * r / J;
  EXPECT_NEAR(histories.last("tip.twist [rad]"), twist, 1e-9 * twist);
  EXPECT_NEAR(histories.last("root.twist [rad]"), 0, 1e-12);
  EXPECT_NEAR(histories.last("bar.twist.max [rad]"), twist, 1e-9 * twist);
  EXPECT_NEAR(histories.last("bar.torque.max [N m]"), T, 1e-9 * T);
  EXPECT_NEAR(histories.last("tip.von_mises [Pa]"), stress, 1e-9 * stress);
  const std::string beams = text_of("frames/beams_000000.vtu");
  for (const char* const name : {"section_d1", "section_d2", "moment_1", "twist", "von_mises"})
    EXPECT_NE(beams.find(name), std::string::npos) << name;

  // The triad at the tip: that at the root turned by the twist.
  const StoredResults stored = read_results(results());
  ASSERT_TRUE(stored.names.sections);
  const std::vector<ElementRecord>& elements = stored.frames.back().beams[0].elements;
  const Eigen::Vector3d from = elements.front().d1.col(0), to = elements.back().d1.col(3);
  EXPECT_NEAR(std::atan2(from.cross(to).z(), from.dot(to)), std::remainder(twist, 2 * pi), 1e-9);
}

// Out of its plane: M = F R sin(phi), T = F R (1 - cos(phi)) from the free end (Timoshenko, Strength of
// Materials, part II).
TEST_F(SectionResults, AQuarterOfACircleBendsAndTwists) {
  const double R = 1, r = 0.01, I = pi / 4 * std::pow(r, 4), J = 2 * I, F = 1;
  ASSERT_EQ(run(R"("axis": {"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0],
                   "normal": [0, 0, 1]}}, "section": {"radius": 0.01}, "elements": {"count": 12})",
                R"({"beam": "bar", "at": "end", "force": [0, 0, 1]})"),
            0)
      << messages;
  EXPECT_NEAR(histories.last("tip.uz [m]"), F * R * R * R * (pi / 4 / (E * I) + (3 * pi / 4 - 2) / (G * J)),
              1e-5 * R);
  const double twist = F * R * R * (pi / 2 - 1) / (G * J);
  EXPECT_NEAR(histories.last("tip.twist [rad]"), twist, 1e-3 * twist);
  EXPECT_NEAR(histories.last("root.torque [N m]"), F * R, 1e-3);
  // Without an orientation the section's y axis is the world's z, and its x axis looks outwards.
  EXPECT_NEAR(std::abs(histories.last("root.moment_1 [N m]")), F * R, 1e-3);
  EXPECT_NEAR(histories.last("root.moment_2 [N m]"), 0, 1e-3);
  const double sigma = F * R * r / I, tau = F * R * r / J;
  EXPECT_NEAR(histories.last("root.von_mises [Pa]"), std::sqrt(sigma * sigma + 3 * tau * tau), 1e-3 * sigma);

  const StoredResults stored = read_results(results());
  for (const ElementRecord& e : stored.frames.back().beams[0].elements)
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d t = RationalCubic(e.control_points).derivatives(i / 3.0).col(1).normalized();
      EXPECT_NEAR(e.d1.col(i).norm(), 1, 1e-12);
      EXPECT_LT((e.d1.col(i).cross(e.d2.col(i)) - t).norm(), 1e-9);
    }
}

TEST_F(SectionResults, SayWhatOfADrawnSectionTheBeamDoesNotKnow) {
  if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  const double b = 0.05, y = 0.05, x = 0.002;
  write_profile(directory.path() / "profile.step", {polygon({{-x, -y - x},
                                                             {b, -y - x},
                                                             {b, -y + x},
                                                             {x, -y + x},
                                                             {x, y - x},
                                                             {b, y - x},
                                                             {b, y + x},
                                                             {-x, y + x}})});
  const std::string beam = R"("axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "elements": {"count": 4},
      "section": {"profile": {"file": "profile.step"}}, "orientation": {"up": [0, 0, 1]})";
  ASSERT_EQ(run(beam, R"({"beam": "bar", "at": "end", "force": [0, 0, 1]})"), 0) << messages;
  EXPECT_NE(messages.find("shear centre at (-0.0"), std::string::npos) << messages;
  EXPECT_NE(messages.find("warping, which is not modelled"), std::string::npos) << messages;

  write_profile(directory.path() / "profile.step", {rectangle(0.05, 0.03), ellipse(0.01, 0.01)});
  ASSERT_EQ(run(beam, R"({"beam": "bar", "at": "end", "force": [0, 0, 1]})"), 0) << messages;
  EXPECT_EQ(messages.find("shear centre"), std::string::npos) << messages;
  EXPECT_EQ(messages.find("warping"), std::string::npos) << messages;
}

TEST_F(SectionResults, AProfileIsSweptAsTheBeamTwists) {
  if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  write_profile(directory.path() / "profile.step", {rectangle(0.03, 0.05), ellipse(0.01, 0.01)});
  ASSERT_EQ(run(R"("axis": {"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0],
                   "normal": [0, 0, 1]}}, "elements": {"count": 12}, "orientation": {"up": [0, 0, 1]},
                   "section": {"profile": {"file": "profile.step"}})",
                R"({"beam": "bar", "at": "end", "moment": [-4000, 0, 0], "follower": true})",
                R"("cad": {"formats": ["step", "step-solid", "step-section-lines"]}, )"),
            0)
      << messages;
  EXPECT_EQ(messages.find("not written"), std::string::npos) << messages;
  EXPECT_GT(std::abs(histories.last("bar.twist.max [rad]")), 0.1);
  EXPECT_TRUE(std::filesystem::exists(results() / "deformed_solid.step"));

  // The lines are where the triads say that the corners are.
  const ImportReport lines = import_curves(results() / "deformed_section_lines.step");
  ASSERT_EQ(lines.curves.size(), 4u);
  EXPECT_EQ(lines.curves[0].name, "bar line 1");
  const ElementRecord tip = read_results(results()).frames.back().beams[0].elements.back();
  const Eigen::Vector3d centre = RationalCubic(tip.control_points).point(1);
  for (const ImportedCurve& line : lines.curves) {
    const Eigen::Vector3d off = line.curve.point(line.curve.knots().end()) - centre;
    EXPECT_NEAR(std::abs(off.dot(tip.d1.col(3))), 0.015, 1e-9);
    EXPECT_NEAR(std::abs(off.dot(tip.d2.col(3))), 0.025, 1e-9);
  }
}

TEST_F(SectionResults, AProfileIsSweptFromMitreToMitreAndRoundARing) {
  if (!has_cgal()) GTEST_SKIP() << "this build is without CGAL";
  write_profile(directory.path() / "profile.step", {rectangle(0.03, 0.05)});
  for (
      const std::string axis :
      {R"("axis": {"polyline": [[0, 0, 0], [1, 0, 0], [1, 0.8, 0.2]]}, "corners": "rigid",
           "elements": {"count": 12})",
       R"("closed": true, "axis": {"nurbs": {"degree": 3, "knots": [-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
           "control_points": [[1, 0, 0], [0.5, 0.9, 0.2], [-0.5, 0.9, -0.2], [-1, 0, 0], [-0.5, -0.9, 0.2],
           [0.5, -0.9, -0.2], [1, 0, 0], [0.5, 0.9, 0.2], [-0.5, 0.9, -0.2]]}}, "elements": {"per_segment": 4})"}) {
    ASSERT_EQ(run(axis + R"(, "section": {"profile": {"file": "profile.step"}})",
                  R"({"beam": "bar", "at": {"fraction": 0.6}, "force": [0, 0, 100]})",
                  R"("cad": {"formats": ["step", "step-solid", "step-section-lines"]}, )"),
              0)
        << messages;
    EXPECT_EQ(messages.find("not written"), std::string::npos) << messages;
    EXPECT_TRUE(std::filesystem::exists(results() / "deformed_solid.step"));
    EXPECT_TRUE(std::filesystem::exists(results() / "deformed_section_lines.step"));
  }
}

TEST_F(SectionResults, BeamsWithoutTorsionHaveNoColumnsOfIt) {
  ASSERT_EQ(run(R"("axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
                   "elements": {"count": 2})",
                R"({"beam": "bar", "at": "end", "force": [0, 0, 1]})"),
            0)
      << messages;
  for (const std::string& column : histories.header) EXPECT_EQ(column.find("von_mises"), std::string::npos);
  EXPECT_FALSE(read_results(results()).names.sections);
}

}  // namespace
}  // namespace nurbeam::test
