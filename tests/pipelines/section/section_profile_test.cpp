#include "pipelines/section/section_profile.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "pipelines/command/check.h"
#include "pipelines/command/inspect.h"
#include "pipelines/model/build_model.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/profiles.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

SectionProfile profile_of(const std::vector<ImportedCurve>& curves) {
  const ProfileReport report = section_profile(curves, "profile.step");
  if (!report.value) throw std::runtime_error(report.diagnostics.at(0).message);
  return *report.value;
}

TEST(SectionProfile, OfAnEllipseHasItsAreaCentroidAndSecondMoments) {
  const SectionProfile p = profile_of(imported({ellipse(0.02, 0.05, {0.3, -0.1})}));
  EXPECT_NEAR(p.area, pi * 0.001, 1e-17);
  EXPECT_LE((p.centroid - Eigen::Vector3d(0.3, -0.1, 0)).norm(), 1e-16);
  EXPECT_NEAR(p.second_x / (pi / 4 * 0.02 * std::pow(0.05, 3)), 1, 1e-13);
  EXPECT_NEAR(p.second_y / (pi / 4 * 0.05 * std::pow(0.02, 3)), 1, 1e-13);
  EXPECT_NEAR(p.product, 0, 1e-20);
  EXPECT_EQ(p.principal_angle(), 0);
}

TEST(SectionProfile, AHoleIsTakenAwayHoweverItIsDrawn) {
  Outline hole = ellipse(0.01, 0.01, {0.05, 0});
  for (int drawn = 0; drawn < 2; ++drawn) {
    const SectionProfile p = profile_of(imported({hole, rectangle(0.2, 0.1)}));
    const double hole_area = pi * 1e-4, area = 0.02 - hole_area, shift = -hole_area * 0.05 / area;
    EXPECT_NEAR(p.area, area, 1e-16);
    EXPECT_NEAR(p.centroid.x(), shift, 1e-16);
    EXPECT_NEAR(p.second_x / (0.2 * 1e-3 / 12 - pi / 4 * 1e-8), 1, 1e-13);
    EXPECT_NEAR(
        p.second_y / (0.1 * 8e-3 / 12 - pi / 4 * 1e-8 - hole_area * 0.05 * 0.05 - area * shift * shift), 1,
        1e-13);
    ASSERT_EQ(p.loops.size(), 2u);
    hole[0] = hole[0].reversed();
  }
}

TEST(SectionProfile, AnAngleHasItsPrincipalAxesAt45Degrees) {
  // Two legs of 1 x 0.1; by parts: a = 0.1 x 1 upright, b = 0.9 x 0.1 lying.
  const SectionProfile p =
      profile_of(imported({polygon({{0, 0}, {1, 0}, {1, 0.1}, {0.1, 0.1}, {0.1, 1}, {0, 1}})}));
  const double area = 0.19, c = (0.1 * 0.05 + 0.09 * 0.55) / area;
  const double second = 0.1 * std::pow(0.1, 2) / 12 + 0.1 * std::pow(c - 0.05, 2) +
                        0.09 * std::pow(0.9, 2) / 12 + 0.09 * std::pow(c - 0.55, 2);
  const double product = 0.1 * (0.05 - c) * (0.5 - c) + 0.09 * (0.55 - c) * (0.05 - c);
  EXPECT_NEAR(p.area, area, 1e-15);
  EXPECT_LE((p.centroid - Eigen::Vector3d(c, c, 0)).norm(), 1e-15);
  EXPECT_NEAR(p.second_x, second, 1e-15);
  EXPECT_NEAR(p.second_y, second, 1e-15);
  EXPECT_NEAR(p.product, product, 1e-15);
  EXPECT_NEAR(p.principal_1(), second - product, 1e-15);  // the product is negative
  EXPECT_NEAR(p.principal_2(), second + product, 1e-15);
  EXPECT_NEAR(p.principal_angle(), pi / 4, 1e-12);
}

TEST(SectionProfile, ATurnedRectangleHasItsPrincipalAxesAlongItsSides) {
  const double angle = 0.3;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const SectionProfile p = profile_of(imported({rectangle(0.2, 0.1)}, turn, {100, -50, 7}));
  // The axis of the greater moment, 0.1 * 0.2^3 / 12, is that of y.
  EXPECT_NEAR(p.principal_1() / (0.1 * 8e-3 / 12), 1, 1e-10);
  EXPECT_NEAR(p.principal_2() / (0.2 * 1e-3 / 12), 1, 1e-10);
  EXPECT_NEAR(p.principal_angle(), angle - pi / 2, 1e-10);
}

TEST(SectionProfile, TheAxesFollowThePlaneOfTheDrawing) {
  const std::vector<Outline> tall = {rectangle(0.1, 0.3)};
  Eigen::Matrix3d to_xz, to_yz;
  to_xz << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // x to x, y to z
  to_yz << 0, 0, 1, 1, 0, 0, 0, 1, 0;   // x to y, y to z
  for (const Eigen::Matrix3d& plane : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), to_xz, to_yz}) {
    const SectionProfile p = profile_of(imported(tall, plane, {1, 2, 3}));
    EXPECT_LE((p.x_axis - plane.col(0)).norm(), 1e-12);
    EXPECT_LE((p.y_axis - plane.col(1)).norm(), 1e-12);
    EXPECT_NEAR(p.second_x / (0.1 * 0.027 / 12), 1, 1e-12);
    EXPECT_NEAR(p.second_y / (0.3 * 0.001 / 12), 1, 1e-12);
  }
}

TEST(SectionProfile, AnUnevenSectionMayLieInAnyPlane) {
  // A triangle with legs of 3 and 4, whose box has its middle off the plane.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const SectionProfile p = profile_of(imported({polygon({{0, 0}, {3, 0}, {0, 4}})}, turn, {7, 8, 9}));
  EXPECT_NEAR(p.area, 6, 1e-13);
  EXPECT_LE((p.centroid - turn * Eigen::Vector3d(1, 4.0 / 3, 0) - Eigen::Vector3d(7, 8, 9)).norm(), 1e-13);
  EXPECT_NEAR(p.second_x + p.second_y, 3 * 64 / 36.0 + 4 * 27 / 36.0, 1e-12);
  EXPECT_NEAR(p.principal_1() * p.principal_2(), 3 * 64 / 36.0 * (4 * 27 / 36.0) - std::pow(144 / 72.0, 2),
              1e-12);
}

TEST(SectionProfile, AnIpe200FromStepOrIgesHasItsTableValues) {
  // EN 10365: h = 200, b = 100, t_w = 5.6, t_f = 8.5, r = 12 mm; A = 28.48 cm^2, I_y = 1943 cm^4,
  // I_z = 142.4 cm^4, to the digits printed.
  std::vector<NamedCurve> curves;
  for (const NurbsCurve& curve : i_section(0.2, 0.1, 0.0056, 0.0085, 0.012)) curves.push_back({"IPE", curve});
  const test::TemporaryDirectory directory;
  for (const char* name : {"ipe.step", "ipe.igs"}) {
    const std::filesystem::path file = directory.path() / name;
    ASSERT_TRUE(export_curves(file, curves, LengthUnit::millimetre).empty());
    const SectionProfile p = profile_of(import_curves(file).curves);
    EXPECT_NEAR(p.area, 28.48e-4, 0.005e-4);
    EXPECT_NEAR(p.second_x, 1943e-8, 0.5e-8);
    EXPECT_NEAR(p.second_y, 142.4e-8, 0.05e-8);
    EXPECT_NEAR(p.product, 0, 1e-17);
  }
}

struct Refused {
  const char* what;
  std::vector<Outline> outlines;
  std::vector<const char*> parts;
};

TEST(SectionProfile, WhatIsNoProfileIsRefusedWithThePlace) {
  Outline open = rectangle(2, 1);
  open[0] = line({-1, -0.5, 0}, {0.9, -0.5, 0});
  Outline bent = rectangle(2, 1);
  bent[0] = make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}),
                             (Eigen::Matrix3d() << -1, 0, 1, -0.5, -0.5, -0.5, 0, 0.1, 0).finished(),
                             Eigen::Vector3d(1, 1, 1));
  Outline star = rectangle(2, 1);
  star.push_back(line({-1, -0.5, 0}, {0, 0, 0}));
  const std::vector<Refused> cases = {
      {"a gap", {open}, {"curve", "0.1 m from the nearest other end", "(0.9, -0.5, 0) m"}},
      {"a curve out of the plane", {bent}, {"not planar", "draw the profile in one plane"}},
      {"three curves in a point", {star}, {"more than two ends meet", "(-1, -0.5, 0) m"}},
      {"two outlines", {rectangle(1, 1), rectangle(1, 1, {3, 0})}, {"has 2 outlines"}},
      {"an island in a hole", {rectangle(3, 3), rectangle(2, 2), rectangle(1, 1)}, {"has 2 outlines"}},
      {"crossing outlines", {rectangle(1, 1), rectangle(1, 1, {0.5, 0.5})}, {"crosses or touches itself"}},
      {"a figure of eight", {polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})}, {"near (0.5, 0.5, 0) m"}},
      {"nothing", {}, {"has no curves"}}};
  for (const Refused& refused : cases) {
    const ProfileReport report = section_profile(imported(refused.outlines), "profile.step");
    EXPECT_FALSE(report.value) << refused.what;
    ASSERT_EQ(report.diagnostics.size(), 1u) << refused.what;
    EXPECT_EQ(report.diagnostics[0].where, "profile.step");
    for (const char* part : refused.parts)
      EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
  }
}

/// A planar cantilever along x in the x-y plane, or one with a load across it, with a drawn section.
class DrawnSection : public ::testing::Test {
 protected:
  BuildReport build(const Outline& outline, const std::string& in_plane, bool spatial,
                    const std::string& more = "") {
    std::vector<NamedCurve> curves;
    for (const NurbsCurve& curve : outline) curves.push_back({"profile", curve});
    EXPECT_TRUE(export_curves(directory_.path() / "profile.step", curves, LengthUnit::millimetre).empty());
    std::vector<std::string> overrides = {
        R"(beams[0].section={"profile": {"file": "profile.step", "in_plane": ")" + in_plane + "\"}}",
        R"(gravity=[0, -9.81, 0])"};
    if (spatial) overrides.emplace_back(R"(loads=[{"beam": "cable", "at": "end", "force": [0, 0, 1]}])");
    if (!more.empty()) overrides.push_back(more);
    case_ = read_case_file(directory_.write("case.json", test::smallest_case), overrides).value.value();
    return build_model(case_);
  }

  test::TemporaryDirectory directory_;
  CaseFile case_;
};

TEST_F(DrawnSection, APlanarModelBendsAlongTheAxisInItsPlane) {
  const double E = 20e6, tall = 0.1 * 0.027 / 12, flat = 0.3 * 0.001 / 12;
  for (const auto& [in_plane, second] : {std::pair{"y", tall}, {"x", flat}}) {
    const BuildReport report = build(rectangle(0.1, 0.3), in_plane, false);
    const BeamProperties& properties = report.value.value().model.beams[0].properties;
    EXPECT_NEAR(properties.bending_stiffness / (E * second), 1, 1e-12);
    EXPECT_NEAR(properties.axial_stiffness / (E * 0.03), 1, 1e-12);
    EXPECT_NEAR(properties.mass_per_length / (7200 * 0.03), 1, 1e-12);
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(report.value->inputs.at(0), directory_.path() / "profile.step");
  }
}

TEST_F(DrawnSection, ASpatialModelGivesASectionThatBendsUnlikeInTwoDirectionsTorsion) {
  const BuildReport given = build(rectangle(0.1, 0.3), "y", true, "beams[0].section.torsion_constant=5e-5");
  ASSERT_TRUE(given.value);
  const std::optional<SectionStiffness>& sections = given.value->model.beams[0].properties.sections;
  ASSERT_TRUE(sections);
  EXPECT_NEAR(sections->bending_1 / (20e6 * 0.000225), 1, 1e-12);
  EXPECT_NEAR(sections->bending_2 / (20e6 * 2.5e-5), 1, 1e-12);
}

TEST_F(DrawnSection, ABeamInSpaceThatIsToHaveNoTorsionRefusesASectionThatBendsUnlikeInTwoDirections) {
  const BuildReport refused = build(rectangle(0.1, 0.3), "y", true, "beams[0].torsion=false");
  EXPECT_FALSE(refused.value);
  ASSERT_EQ(refused.diagnostics.size(), 1u);
  EXPECT_NE(refused.diagnostics[0].where.find("beams[0].section.profile"), std::string::npos);
  for (const char* part : {"0.000225 and 2.5e-05 m^4", "\"area\" and \"second_moment\"", "\"torsion\": true"})
    EXPECT_NE(refused.diagnostics[0].message.find(part), std::string::npos) << refused.diagnostics[0].message;
  const BuildReport square = build(rectangle(0.1, 0.1), "y", true);
  ASSERT_TRUE(square.value);
  EXPECT_NEAR(square.value->model.beams[0].properties.bending_stiffness / (20e6 * 1e-4 / 12), 1, 1e-12);
}

TEST_F(DrawnSection, APlanarModelSaysThatAnAngleWouldBendOutOfThePlane) {
  const BuildReport report =
      build(polygon({{0, 0}, {0.1, 0}, {0.1, 0.01}, {0.01, 0.01}, {0.01, 0.1}, {0, 0.1}}), "y", false);
  ASSERT_TRUE(report.value);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].message.find("turned by 45 degrees"), std::string::npos);
}

TEST_F(DrawnSection, CheckAndInspectPrintItsProperties) {
  ASSERT_TRUE(build(rectangle(0.1, 0.3), "y", false).value);
  std::ostringstream checking, out, err;
  EXPECT_EQ(check_case(case_, checking, err), 0);
  const std::string checked = checking.str();
  EXPECT_EQ(inspect_profiles({directory_.path() / "profile.step"}, out, err), 0);
  EXPECT_EQ(err.str(), "");
  for (const char* part :
       {"area              0.03 m^2", "I_x 0.000225, I_y 2.5e-05", "I_1 0.000225", "torsion constant"}) {
    EXPECT_NE(checked.find(part), std::string::npos) << checked;
    EXPECT_NE(out.str().find(part), std::string::npos) << out.str();
  }
}

}  // namespace
}  // namespace nurbeam
