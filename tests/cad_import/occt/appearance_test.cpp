// Layers and colours of curves, as STEP and IGES keep them.

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "cad_import/import_curves.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

// Three circles: "a" is styled orange, "b" has the pre-defined colour green, "c" has none; "a" and "c" are on
// the layer "cables".
const std::string styled_circles = R"(#100 = CIRCLE('a',#11,1.);
#101 = CIRCLE('b',#11,2.);
#102 = CIRCLE('c',#11,3.);
#110 = STYLED_ITEM('',(#111),#100);
#111 = PRESENTATION_STYLE_ASSIGNMENT((#112));
#112 = CURVE_STYLE('',#113,POSITIVE_LENGTH_MEASURE(0.1),#114);
#113 = DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous');
#114 = COLOUR_RGB('',1.,0.5,0.);
#120 = STYLED_ITEM('',(#121),#101);
#121 = PRESENTATION_STYLE_ASSIGNMENT((#122));
#122 = CURVE_STYLE('',#113,POSITIVE_LENGTH_MEASURE(0.1),#123);
#123 = DRAUGHTING_PRE_DEFINED_COLOUR('green');
#130 = PRESENTATION_LAYER_ASSIGNMENT('cables','',(#100,#102));
#131 = PRESENTATION_LAYER_ASSIGNMENT('frame','',(#120));
#132 = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#110,#120),#26);)";

ImportReport import_appearance(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("styled.cad", text));
}

TEST(Appearance, StylesAndLayersOfStepCurvesAreRead) {
  const ImportReport report = import_appearance(step_text_of("#100,#101,#102", styled_circles));
  ASSERT_EQ(report.curves.size(), 3U);
  const std::array<std::array<std::string, 3>, 3> expected{
      {{"a", "cables", "#ff8000"}, {"b", "frame", "#00ff00"}, {"c", "cables", ""}}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(report.curves[i].name, expected[i][0]);
    EXPECT_EQ(report.curves[i].layer, expected[i][1]);
    EXPECT_EQ(report.curves[i].colour, expected[i][2]);
  }
}

TEST(Appearance, ALayerOfASetIsThatOfItsCurves) {
  const std::string layer = "#130 = PRESENTATION_LAYER_ASSIGNMENT('all','',(#15));\n";
  const ImportReport report = import_appearance(step_text_of("#100", layer + "#100 = CIRCLE('',#11,1.);"));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_EQ(report.curves[0].layer, "all");
}

// Three lines (entity 110): on level 7 in colour number 4; without either; on level 0 in a defined colour.
std::string iges_lines() {
  return iges_text_of({{110, "110,0.,0.,0.,1.,0.,0.;", 0, 7, 4},
                       {110, "110,0.,1.,0.,1.,1.,0.;"},
                       {110, "110,0.,2.,0.,1.,2.,0.;", 0, 0, -7},
                       {.type = 314, .parameters = "314,100.,40.,0.,6Horange;", .status = 200}});
}

TEST(Appearance, LevelsAndColoursOfIgesCurvesAreRead) {
  const ImportReport report = import_appearance(iges_lines());
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_EQ(report.curves[0].layer, "7");
  EXPECT_EQ(report.curves[0].colour, "#0000ff");
  EXPECT_EQ(report.curves[1].layer, "");
  EXPECT_EQ(report.curves[1].colour, "");
  EXPECT_EQ(report.curves[2].layer, "");
  EXPECT_EQ(report.curves[2].colour, "#ff6600");
}

TEST(Appearance, FacesAndSolidsGiveTheirColourToTheirEdges) {
  std::map<std::string, int> colours;
  for (const ImportedCurve& curve : import_curves(corpus_file("inventor-issue153.stp")).curves)
    ++colours[curve.colour];
  // The one STYLED_ITEM of the file is that of its solid.
  EXPECT_EQ(colours, (std::map<std::string, int>{{"#ffffff", 76}}));
}

TEST(Resolution, IsThatWhichTheFileDeclaresInItsOwnUnit) {
  EXPECT_NEAR(import_curves(corpus_file("ideas-dm1.stp")).resolution, 0.000393700787402 * 0.0254, 1e-15);
  EXPECT_NEAR(import_curves(corpus_file("inventor-issue153.stp")).resolution, 1e-5, 1e-18);
  EXPECT_NEAR(import_curves(corpus_file("parastell-magnet.step")).resolution, 1e-9, 1e-18);
  EXPECT_NEAR(import_curves(corpus_file("igesio-sample-curves.igs")).resolution, 1e-6, 1e-18);
}

}  // namespace
}  // namespace nurbeam
