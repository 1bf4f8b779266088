// Standard materials, and sections by their sizes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "pipelines/command/check.h"
#include "pipelines/model/build_model.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

const std::string bar_of_steel = R"({
  "nurbeam": 1, "gravity": [0, -9.81, 0],
  "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.01 },
              "material": "steel" }],
  "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }],
  "analysis": { "type": "static" } })";

class SectionsTest : public ::testing::Test {
 protected:
  CaseFileReport read_bar(const std::vector<std::string>& overrides) {
    return read_case_file(directory_.write("case.json", bar_of_steel), overrides);
  }
  BuiltModel built_bar(const std::vector<std::string>& overrides) {
    const CaseFileReport report = read_bar(overrides);
    for (const Diagnostic& d : report.diagnostics) EXPECT_NE(d.severity, Severity::error) << d.message;
    return build_model(report.value.value()).value.value();
  }
  BeamProperties bar(const std::vector<std::string>& overrides) {
    return built_bar(overrides).model.beams[0].properties;
  }
  void refuses(const std::vector<std::string>& overrides, const std::string& where, const std::string& part) {
    const CaseFileReport report = read_bar(overrides);
    EXPECT_FALSE(report.value);
    ASSERT_EQ(report.diagnostics.size(), 1u);
    EXPECT_NE(report.diagnostics[0].where.find(": " + where), std::string::npos)
        << report.diagnostics[0].where;
    EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
  }

  test::TemporaryDirectory directory_;
};

TEST_F(SectionsTest, MaterialsHaveTheirNumbersByName) {
  const double A = pi * 1e-4;
  EXPECT_NEAR(bar({}).axial_stiffness, 210e9 * A, 1);
  EXPECT_NEAR(bar({}).mass_per_length, 7850 * A, 1e-12);
  EXPECT_NEAR(bar({"beams[0].material=aluminium"}).mass_per_length, 2700 * A, 1e-12);
  const BeamProperties other =
      bar({"beams[0].material={\"name\": \"steel\", \"youngs_modulus\": \"200 GPa\", \"mass_damping\": 3}"});
  EXPECT_NEAR(other.axial_stiffness, 200e9 * A, 1);
  EXPECT_NEAR(other.mass_per_length, 7850 * A, 1e-12);
  EXPECT_EQ(other.mass_damping, 3);
  const BeamProperties lossy = bar({"beams[0].material={\"name\": \"steel\", \"stiffness_damping\": 1e-3}"});
  EXPECT_EQ(lossy.damping, 1e-3);
  EXPECT_EQ(lossy.tension_damping, 1e-3);
}

TEST_F(SectionsTest, CheckShowsTheNumbersOfAMaterial) {
  std::ostringstream out, err;
  EXPECT_EQ(check_case(read_bar({}).value.value(), out, err), 0);
  EXPECT_NE(out.str().find("material  of bar: steel, density 7850 kg/m^3, Young's modulus 2.1e+11 Pa"),
            std::string::npos)
      << out.str();
}

// A rectangle of 40 mm by 20 mm on the layer "outline", an axis that crosses it on the layer "axes".
const std::string drawing_with_axis = [] {
  std::string text =
      "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES 0 LWPOLYLINE 8 outline 62 1 70 1 10 0 20 "
      "0 10 40 20 0 10 40 20 20 10 0 20 20 0 LINE 8 axes 62 2 10 -5 20 10 11 45 21 10 0 ENDSEC 0 EOF ";
  std::replace(text.begin(), text.end(), ' ', '\n');
  return text;
}();

TEST_F(SectionsTest, ProfilesAreTheCurvesOfALayerOrColour) {
  directory_.write("section.dxf", drawing_with_axis);
  for (const char* choice : {R"("layer": "outline")", R"("colour": "#FF0000")"}) {
    const BeamProperties chosen =
        bar({std::string(R"(beams[0].section={"profile": {"file": "section.dxf", )") + choice + "}}"});
    EXPECT_NEAR(chosen.axial_stiffness, 210e9 * 0.04 * 0.02, 1) << choice;
    EXPECT_NEAR(chosen.bending_stiffness, 210e9 * 0.04 * std::pow(0.02, 3) / 12, 1e-6) << choice;
  }
}

TEST_F(SectionsTest, ProfilesOfNoLayerOrOfSeveralNameWhatChooses) {
  directory_.write("section.dxf", drawing_with_axis);
  for (const auto& [choice, where, reason] :
       {std::tuple{"", "beams[0].section.profile", "\"layer\" chooses among \"axes\", \"outline\""},
        {R"(, "layer": "outlines")", "beams[0].section.profile.layer", "did you mean \"outline\"?"},
        {R"(, "part": "bracket")", "beams[0].section.profile.part", "has a part"}}) {
    const CaseFileReport report =
        read_bar({std::string(R"(beams[0].section={"profile": {"file": "section.dxf")") + choice + "}}"});
    const auto built = build_model(report.value.value());
    EXPECT_FALSE(built.value);
    EXPECT_TRUE(std::any_of(built.diagnostics.begin(), built.diagnostics.end(), [&](const Diagnostic& d) {
      return d.where.find(where) != std::string::npos && d.message.find(reason) != std::string::npos;
    })) << reason;
  }
}

TEST_F(SectionsTest, MaterialsThatAreNoneAreRefused) {
  refuses({"beams[0].material=steal"}, "beams[0].material", "\"steel\"");
  refuses({"beams[0].material={\"density\": 1000}"}, "beams[0].material", "\"youngs_modulus\" is missing");
}

TEST_F(SectionsTest, PipesRectanglesAndIsBendAsTheirFormulas) {
  const double E = 210e9;
  EXPECT_NEAR(bar({"beams[0].section.bore=0.008"}).bending_stiffness,
              E * pi / 4 * (std::pow(0.01, 4) - std::pow(0.008, 4)), 1e-9);
  const BeamProperties upright = bar({"beams[0].section={\"rectangle\": [0.02, \"50 mm\"]}"});
  EXPECT_NEAR(upright.bending_stiffness, E * 0.02 * std::pow(0.05, 3) / 12, 1e-8 * upright.bending_stiffness);
  EXPECT_NEAR(upright.axial_stiffness, E * 0.02 * 0.05, 1e-8 * upright.axial_stiffness);
  const BeamProperties i = bar(
      {"beams[0].section={\"i_section\": {\"width\": 0.1, \"height\": 0.2, \"flange\": 0.01, \"web\": 0.006}}"});
  const double I = (0.1 * std::pow(0.2, 3) - (0.1 - 0.006) * std::pow(0.18, 3)) / 12;
  EXPECT_NEAR(i.bending_stiffness, E * I, 1e-8 * E * I);
  EXPECT_NEAR(i.axial_stiffness, E * (2 * 0.1 * 0.01 + 0.18 * 0.006), 1);
}

// Timoshenko and Goodier: J = 0.2287 a^4 2 for sides 1 : 2, (16/3 ...) 0.1406 of a square.
TEST_F(SectionsTest, RectanglesTwistAsTheSeriesSays) {
  const auto torsion = [&](const std::string& sides) {
    return bar({"beams[0].section={\"rectangle\": " + sides + "}", "beams[0].torsion=true"})
               .sections.value()
               .torsion /
           (210e9 / 2.6);
  };
  EXPECT_NEAR(torsion("[0.02, 0.02]"), 0.140577 * std::pow(0.02, 4), 1e-5 * std::pow(0.02, 4));
  EXPECT_NEAR(torsion("[0.04, 0.02]"), 0.228682 * 2 * std::pow(0.02, 4), 2e-5 * std::pow(0.02, 4));
}

TEST_F(SectionsTest, RopesBendAsTheirWires) {
  const BeamProperties rope = bar(
      {"beams[0].section={\"rope\": {\"diameter\": \"20 mm\", \"metallic_area\": \"190 mm^2\", \"wires\": 133}}"});
  EXPECT_NEAR(rope.axial_stiffness, 210e9 * 190e-6, 1);
  const double r = std::sqrt(190e-6 / (133 * pi));
  EXPECT_NEAR(rope.bending_stiffness, 210e9 * 133 * pi * std::pow(r, 4) / 4, 1e-9);
}

TEST_F(SectionsTest, SizesThatCannotBeAreRefused) {
  refuses({"beams[0].section.bore=0.01"}, "beams[0].section.bore", "less than the outer one");
  refuses({"beams[0].section={\"rope\": {\"diameter\": 0.01, \"metallic_area\": 1e-4}}"},
          "beams[0].section.rope.metallic_area", "more than the");
  refuses(
      {"beams[0].section={\"i_section\": {\"width\": 0.1, \"height\": 0.02, \"flange\": 0.01, \"web\": 0.006}}"},
      "beams[0].section.i_section.flange", "thinner than the height");
  refuses({"beams[0].section={\"rectangle\": [0.1]}"}, "beams[0].section.rectangle", "at least 2");
}

}  // namespace
}  // namespace nurbeam
