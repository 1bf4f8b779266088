// The names of parts: products and occurrences of STEP, groups of IGES, and what a written file calls them.

#include <gtest/gtest.h>

#include <set>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

std::vector<ImportedCurve> curves_of(const std::string& text) {
  const ScratchDirectory scratch;
  const ImportReport report = import_curves(scratch.file("drawing.cad", text));
  EXPECT_TRUE(report.ok());
  return report.curves;
}

using Names = std::vector<std::pair<std::string, std::string>>;

/// Name and part of each curve.
Names names_of(const std::vector<ImportedCurve>& curves) {
  Names names;
  for (const ImportedCurve& curve : curves) names.emplace_back(curve.name, curve.part);
  return names;
}

std::string product_called(const std::string& id_and_name) {
  return with(step_text_of("#100", "#100 = CIRCLE('',#11,1.);"), "PRODUCT('curves','curves'",
              "PRODUCT(" + id_and_name);
}

TEST(PartNames, ACurveWithoutANameTakesThatOfItsProduct) {
  EXPECT_EQ(names_of(curves_of(product_called("'17','rope'"))), (Names{{"rope", "rope"}}));
  EXPECT_EQ(names_of(curves_of(product_called("'17',''"))), (Names{{"17", "17"}}));
  EXPECT_EQ(names_of(curves_of(product_called("'','left/right'"))), (Names{{"left/right", "left/right"}}));
  EXPECT_EQ(names_of(curves_of(product_called("'',''"))), (Names{{"", ""}}));
  EXPECT_EQ(names_of(curves_of(step_text_of("#100", "#100 = CIRCLE('own',#11,1.);"))),
            (Names{{"own", "curves"}}));
}

TEST(PartNames, OfAnAssemblyAreAPathOfOccurrences) {
  std::set<std::string> parts;
  for (const ImportedCurve& curve : import_curves(corpus_file("ideas-dm1.stp")).curves)
    parts.insert(curve.part);
  // NEXT_ASSEMBLY_USAGE_OCCURRENCE of the file; its two l-brackets are one product, as are its bolts and
  // nuts.
  EXPECT_EQ(parts, (std::set<std::string>{"dm1/bolt_3", "dm1/bolt_4", "dm1/bolt_5", "dm1/l-bracket_2",
                                          "dm1/nut_6", "dm1/nut_7", "dm1/nut_8"}));
}

TEST(PartNames, EdgesOfSolidsStayUnnamed) {
  for (const ImportedCurve& curve : import_curves(corpus_file("inventor-issue153.stp")).curves) {
    EXPECT_EQ(curve.name, "");
    EXPECT_NE(curve.part, "");
  }
}

const std::string line_1 = "110,0.,0.,0.,1.,0.,0.;", line_2 = "110,0.,1.,0.,1.,1.,0.;";

TEST(PartNames, AGroupOfIgesNamesItsMembers) {
  const std::vector<ImportedCurve> curves = curves_of(iges_text_of({{110, line_1},
                                                                    {110, line_2, 0, 0, 0, "own"},
                                                                    {110, "110,0.,2.,0.,1.,2.,0.;"},
                                                                    {402, "402,2,1,3,0,1,9;", 7},
                                                                    {406, "406,1,5Hropes;", 15}}));
  ASSERT_EQ(curves.size(), 3U);
  for (const ImportedCurve& curve : curves) {
    const double y = curve.curve.point(curve.curve.knots().start()).y();
    EXPECT_EQ(curve.part, y < 1.5e-3 ? "ropes" : "") << y;
    EXPECT_EQ(curve.name, y < 0.5e-3 ? "ropes" : y < 1.5e-3 ? "own" : "") << y;
  }
}

TEST(PartNames, ALabelOfIgesHasItsSubscriptWhereThatCounts) {
  const std::vector<ImportedCurve> curves =
      curves_of(iges_text_of({{110, line_1, 0, 0, 0, "cable", 0}, {110, line_2, 0, 0, 0, "cable", 2}}));
  EXPECT_EQ(names_of(curves), (Names{{"cable", ""}, {"cable(2)", ""}}));
}

TEST(PartNames, EachWrittenCurveIsAProductAndSeveralAreAnAssembly) {
  const ScratchDirectory scratch;
  const auto written = [&](const std::vector<NamedCurve>& curves) {
    EXPECT_TRUE(export_curves(scratch.path() / "out.step", curves, LengthUnit::millimetre).empty());
    return names_of(import_curves(scratch.path() / "out.step").curves);
  };
  const NurbsCurve a = line({0, 0, 0}, {1, 0, 0}), b = line({0, 1, 0}, {1, 1, 0});
  EXPECT_EQ(written({{"spine", a, "left"}, {"", b, "right"}}),
            (Names{{"spine", "beams/left"}, {"right", "beams/right"}}));
  EXPECT_EQ(written({{"spine", a}}), (Names{{"spine", "spine"}}));
  EXPECT_NE(content_of(scratch.path() / "out.step").find("'nurbeam'"), std::string::npos);
  EXPECT_TRUE(export_solids(scratch.path() / "rods.step", {{{"rod", a}, 0.1}, {{"", b, "tube"}, 0.1, 0.05}},
                            LengthUnit::metre)
                  .empty());
  Names lines;
  for (const ImportedCurve& curve : import_curves(scratch.path() / "rods.step").curves)
    if (curve.is_centre_line()) lines.emplace_back(curve.name, curve.part);
  EXPECT_EQ(lines, (Names{{"rod", "beams/rod"}, {"tube", "beams/tube"}}));
}

TEST(WrittenNumbers, MayHaveExponentsOfThreeDigits) {
  // -1.2...E-171 has a character more than E-17: OpenCASCADE's buffer has room for it with 17 digits.
  const ScratchDirectory scratch;
  const double tiny = -1.234567890123456e-171;
  const NurbsCurve axis = line({0, 0, 0}, {1, 0.3, tiny});
  for (const char* name : {"rod.step"})
    EXPECT_TRUE(export_solids(scratch.path() / name, {{{"rod", axis}, 0.1}}, LengthUnit::metre).empty())
        << name;
  for (const char* name : {"axis.step", "axis.igs", "axis.dxf", "axis.brep"})
    EXPECT_TRUE(export_curves(scratch.path() / name, {{"axis", axis}},
                              name == std::string("axis.brep") ? LengthUnit::millimetre : LengthUnit::metre)
                    .empty())
        << name;
}

}  // namespace
}  // namespace nurbeam
