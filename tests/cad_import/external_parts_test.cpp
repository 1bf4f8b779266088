// Assemblies whose parts lie in other files: read from beside where the file is there, named where it is not.

#include <gtest/gtest.h>

#include <algorithm>

#include "cad_import/export_curves.h"
#include "cad_import/export_into_step.h"
#include "cad_import/import_curves.h"
#include "nurbs/primitives.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

/// The instances that say that the part `product_definition` lies in the file.
std::string lies_in(const std::string& file, const std::string& product_definition) {
  return "#200 = DOCUMENT_TYPE('');\n#201 = DOCUMENT_FILE('" + file +
         "','','',#200,'',$);\n#202 = APPLIED_DOCUMENT_REFERENCE(#201,'',(" + product_definition +
         "));\n#203 = DOCUMENT_REPRESENTATION_TYPE('digital',#201);\n";
}

/// An assembly, "bridge", with a hoop of its own and two ropes that lie in `file`.
std::string bridge(const std::string& file) {
  const std::string rope =
      "#51 = PRODUCT_DEFINITION('design','',#52,#9);\n#52 = PRODUCT_DEFINITION_FORMATION('','',#53);\n"
      "#53 = PRODUCT('rope','rope','',(#8));\n#54 = SHAPE_DEFINITION_REPRESENTATION(#56,#55);\n"
      "#55 = SHAPE_REPRESENTATION('rope',(#11),#26);\n#56 = PRODUCT_DEFINITION_SHAPE('','',#51);\n";
  std::string text =
      step_text_of("#100", "#100 = CIRCLE('hoop',#11,1.);\n" + rope + occurrence(60, "left", 100) +
                               occurrence(70, "right", 300) + lies_in(file, "#51"));
  return with(text, "PRODUCT('curves','curves'", "PRODUCT('bridge','bridge'");
}

const NurbsCurve rope = line({0.01, 0, 0}, {0.02, 0, 0.5});

void write_rope(const fs::path& file) {
  ASSERT_TRUE(export_curves(file, {{"strand", rope, "rope"}}, LengthUnit::inch).empty());
}

void expect_bridge_with_ropes(const ImportReport& report) {
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics.at(0).message;
  EXPECT_EQ(report.curves[0].name, "hoop");
  for (const int i : {1, 2}) {
    const ImportedCurve& strand = report.curves[i];
    EXPECT_EQ(strand.name, "strand");
    EXPECT_EQ(strand.part, i == 1 ? "bridge/left" : "bridge/right");
    EXPECT_LE((end_of(strand.curve) - Eigen::Vector3d(i == 1 ? 0.1 : 0.3, 0.02, 0.5)).norm(), 1e-15);
  }
}

TEST(ExternalParts, AreReadFromBesideAndStandWhereTheAssemblyPutsThem) {
  const ScratchDirectory scratch;
  const fs::path assembly = scratch.file("bridge.step", bridge("rope.stp"));
  write_rope(scratch.path() / "rope.stp");
  expect_bridge_with_ropes(import_curves(assembly));
  // By the last component of a path of another computer, or in a folder below.
  expect_bridge_with_ropes(import_curves(scratch.file("bridge.step", bridge("C:\\\\parts\\\\rope.stp"))));
  fs::create_directory(scratch.path() / "parts");
  fs::rename(scratch.path() / "rope.stp", scratch.path() / "parts/rope.stp");
  expect_bridge_with_ropes(import_curves(scratch.file("bridge.step", bridge("parts/rope.stp"))));
}

/// The one warning; the hoop is read all the same.
std::string warning_of_bridge(const ImportReport& report) {
  EXPECT_EQ(report.curves.size(), 1U);
  EXPECT_EQ(report.diagnostics.size(), 1U);
  if (report.diagnostics.empty()) return "";
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  return report.diagnostics[0].message;
}

TEST(ExternalParts, AreNamedWhereTheFileIsNotThereOrThePartIsHereToo) {
  const ScratchDirectory scratch;
  const std::string missing =
      warning_of_bridge(import_curves(scratch.file("bridge.step", bridge("rope.stp"))));
  for (const char* part : {"'rope'", "'rope.stp'", "not read", "no such file"})
    EXPECT_NE(missing.find(part), std::string::npos) << missing;
  write_rope(scratch.path() / "rope.stp");
  const std::string here = warning_of_bridge(import_curves(scratch.file(
      "part.step", step_text_of("#100", "#100 = CIRCLE('good',#11,1.);\n" + lies_in("rope.stp", "#5")))));
  EXPECT_NE(here.find("has shapes here"), std::string::npos) << here;
}

TEST(ExternalParts, DamagedOnesAndThoseThatHoldThemselvesHarmNothing) {
  const ScratchDirectory scratch;
  for (const std::string& content : {std::string("no CAD file"), bridge("bridge.step"), bridge("rope.stp")}) {
    scratch.file("rope.stp", content);
    const ImportReport report = import_curves(scratch.file("bridge.step", bridge("rope.stp")));
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.curves.at(0).name, "hoop");
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_TRUE(std::any_of(report.diagnostics.begin(), report.diagnostics.end(), [](const Diagnostic& d) {
      return d.message.find("cannot be read (see above)") != std::string::npos;
    }));
  }
}

TEST(ExternalParts, OfIgesAreReadToo) {
  const ScratchDirectory scratch;
  scratch.file("rope.igs",
               iges_text_of({{.type = 110, .parameters = "110,10.,0.,0.,20.,0.,500.;", .label = "strand"}}));
  expect_bridge_with_ropes(import_curves(scratch.file("bridge.step", bridge("rope.igs"))));
}

TEST(ExternalParts, ADeformedCurveOfOneIsAddedToTheAssembly) {
  const ScratchDirectory scratch;
  const fs::path assembly = scratch.file("bridge.step", bridge("rope.stp")),
                 target = scratch.path() / "target.step";
  write_rope(scratch.path() / "rope.stp");
  const ImportReport before = import_curves(assembly);
  ASSERT_EQ(before.curves.size(), 3U);
  const NurbsCurve moved = line({0.1, 0.01, 0}, {0.1, 0.05, 0.4});
  const auto warnings = export_into_step(assembly, target, {{before.curves[1].curve, moved, "rope left"}});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].severity, Severity::warning);
  EXPECT_NE(warnings[0].message.find("another file"), std::string::npos) << warnings[0].message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 4U);
  const auto added = std::find_if(after.curves.begin(), after.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.name == "rope left"; });
  ASSERT_NE(added, after.curves.end());
  EXPECT_LE((end_of(added->curve) - Eigen::Vector3d(0.1, 0.05, 0.4)).norm(), 1e-15);
}

// Nor is the centre line of a solid in the file itself.
TEST(ExternalParts, ADeformedCentreLineIsAddedBesideItsSolid) {
  const ScratchDirectory scratch;
  const fs::path source = scratch.path() / "rod.step", target = scratch.path() / "target.step";
  ASSERT_TRUE(export_solids(source, {{{"rod", line({0, 0, 0}, {1, 0, 0})}, 0.1}}, LengthUnit::inch).empty());
  const ImportReport before = import_curves(source);
  ASSERT_TRUE(!before.curves.empty() && before.curves.back().is_centre_line());
  const auto warnings = export_into_step(
      source, target, {{before.curves.back().curve, line({0, 0, 0}, {0.8, 0.6, 0}), "bent rod"}});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("centre line of a solid"), std::string::npos) << warnings[0].message;
  const ImportReport after = import_curves(target);
  EXPECT_EQ(after.curves.size(), before.curves.size() + 1);
  const auto added = std::find_if(after.curves.begin(), after.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.name == "bent rod"; });
  ASSERT_NE(added, after.curves.end());
  EXPECT_TRUE(added->free);
  EXPECT_LE((end_of(added->curve) - Eigen::Vector3d(0.8, 0.6, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace nurbeam
