// Curves as JSON: what is read, and what is named.

#include <gtest/gtest.h>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

ImportReport import_json(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("curves.json", text));
}

const std::string line_file =
    R"({"name": "rope", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]]})";

ImportReport with_line(const std::string& other, const std::string& unit = R"("unit": "mm",)") {
  return import_json("{" + unit + R"( "curves": [)" + line_file + (other.empty() ? "" : ", " + other) + "]}");
}

TEST(JsonCurves, HaveTheUnitOfTheFile) {
  for (const auto& [name, metres] :
       {std::pair{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"inch", 0.0254}, {"ft", 0.3048}}) {
    const ImportReport report = with_line("", std::string("\"unit\": \"") + name + "\",");
    ASSERT_EQ(report.curves.size(), 1U) << name;
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_DOUBLE_EQ(length(report.curves[0].curve), 5 * metres) << name;
    EXPECT_EQ(report.curves[0].name, "rope");
  }
  const ImportReport without = with_line("", "");
  ASSERT_EQ(without.diagnostics.size(), 1U);
  EXPECT_EQ(without.diagnostics[0].severity, Severity::warning);
  EXPECT_DOUBLE_EQ(length(without.curves.at(0).curve), 5);
}

TEST(JsonCurves, KeepLayerColourAndPart) {
  const ImportReport report = with_line(
      R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0, 1], [3, 4, 2]], "layer": "Träger",
          "colour": "#ff0000", "part": "a/b"})");
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_EQ(report.curves[1].layer, "Träger");
  EXPECT_EQ(report.curves[1].colour, "#ff0000");
  EXPECT_EQ(report.curves[1].part, "a/b");
}

TEST(JsonCurves, ThatAreDamagedAreNamedAndHarmNothing) {
  for (const auto& [curve, reason] : {
           std::pair{R"(5)", "no object"},
           {R"({"name": "x", "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]]})", "no \"degree\""},
           {R"({"degree": 1.5, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]]})", "whole number"},
           {R"({"degree": 100000, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]]})",
            "whole number"},
           {R"({"degree": 1, "knots": [0, 0, 1], "control_points": [[0, 0], [3, 4]]})",
            "2 control points and 3 knots"},
           {R"({"degree": 1, "knots": [0, 1, 0, 1], "control_points": [[0, 0], [3, 4]]})", "knot 2"},
           {R"({"degree": 1, "knots": "0", "control_points": [[0, 0], [3, 4]]})", "no list"},
           {R"({"degree": 1, "knots": [0, 0, "a", 1], "control_points": [[0, 0], [3, 4]]})", "no number"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4, 5, 6]]})",
            "control point 2"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1e16, 4]]})", "1e15"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 4]], "weights": [1]})",
            "1 weights"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 4]], "weights": [1, 0]})",
            "positive"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[1, 4], [1, 4]]})", "no length"},
           {R"({"degree": 1, "knots": [], "control_points": []})", "0 control points"},
           {R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]], "name": 7})",
            "\"name\" is no text"},
       }) {
    const ImportReport report = with_line(curve);
    ASSERT_EQ(report.curves.size(), 1U) << curve;
    ASSERT_EQ(report.diagnostics.size(), 1U) << curve;
    EXPECT_NE(report.diagnostics[0].where.find("curve 2"), std::string::npos) << report.diagnostics[0].where;
    EXPECT_NE(report.diagnostics[0].message.find(reason), std::string::npos) << report.diagnostics[0].message;
  }
}

TEST(JsonCurves, KeysThatAreNotKnownAreNamed) {
  const ImportReport report = with_line(
      R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [3, 4]], "weight": [1, 1]})");
  EXPECT_EQ(report.curves.size(), 2U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("\"weight\""), std::string::npos);
}

TEST(JsonCurves, FilesThatAreNoneAreErrors) {
  for (const auto& [text, reason] : {std::pair{R"({"curves": [)", "no JSON"},
                                     {R"({"curves": 5})", "no list \"curves\""},
                                     {R"({"a": 1})", "no list \"curves\""},
                                     {R"({"unit": "yard", "curves": []})", "'yard'"},
                                     {R"({"unit": "mm", "curves": []})", "no curve"},
                                     {R"({"unit": "mm", "curves": [{"degree": 1e999}]})", "no JSON"}}) {
    const ImportReport report = import_json(text);
    ASSERT_FALSE(report.ok()) << text;
    EXPECT_NE(report.diagnostics.back().message.find(reason), std::string::npos)
        << report.diagnostics.back().message;
  }
  EXPECT_FALSE(import_json("{\"curves\": " + std::string(100000, '[') + "}").ok());
}

}  // namespace
}  // namespace nurbeam
