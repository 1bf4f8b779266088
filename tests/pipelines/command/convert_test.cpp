// nurbeam convert and transform: curves from one format to another.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "pipelines/command/command_line.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

struct Answer {
  int code;
  std::string out, err;
};

Answer answer_to(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = run_command_line(arguments, out, err);
  return {code, out.str(), err.str()};
}

class Convert : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string file(const std::string& name, const std::string& content) const {
    return directory_.write(name, content).string();
  }
  static std::string content_of(const std::string& name) {
    std::ifstream in(name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::vector<ImportedCurve> curves_of(const std::string& name) {
    ImportReport report = import_curves(name);
    EXPECT_TRUE(report.ok()) << report.diagnostics[0].message;
    return std::move(report.curves);
  }

 private:
  test::TemporaryDirectory directory_;
  const fs::path path_ = directory_.path();
};

/// A rational quintic, a quarter of a circle, and the line that goes on from it; in inches.
const char* const three_curves = R"({"unit": "inch", "curves": [
  {"name": "quintic", "degree": 5, "knots": [0, 0, 0, 0, 0, 0, 1.5, 2, 2, 2, 2, 2, 2], "control_points":
   [[0, 0, 1], [1, 2, 3], [2, -1, 0.1], [3, 0.3333333333333333, 1], [4, 4, 4], [5, 0, 0], [6, 1, 1]],
   "weights": [1, 2, 0.7, 1, 1, 3, 1]},
  {"name": "quarter", "degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[1, 0], [1, 1], [0, 1]],
   "weights": [1, 0.7071067811865476, 1]},
  {"name": "line", "degree": 1, "knots": [0, 0, 3, 3], "control_points": [[-3, 1], [0, 1]]}]})";

TEST_F(Convert, CurvesAreTheSameInEveryFormatAndBack) {
  const std::string source = file("source.json", three_curves);
  const std::vector<ImportedCurve> drawn = curves_of(source);
  ASSERT_EQ(drawn.size(), 3U);
  for (const char* name : {"c.step", "c.igs", "c.dxf", "c.brep", "c.json"}) {
    const Answer answer = answer_to({"convert", source, file(name)});
    ASSERT_EQ(answer.code, 0) << name << answer.err;
    const bool is_brep = std::string(name) == "c.brep";
    EXPECT_NE(answer.out.find(is_brep ? "3 curves, unit mm" : "3 curves, unit inch"), std::string::npos)
        << answer.out;
    ASSERT_EQ(answer_to({"convert", file(name), file("back.json")}).code, 0) << name;
    const std::vector<ImportedCurve> back = curves_of(file("back.json"));
    ASSERT_EQ(back.size(), 3U) << name;
    for (std::size_t i = 0; i < 3; ++i) {
      const NurbsCurve &was = drawn[i].curve, &is = back[i].curve;
      if (!is_brep) EXPECT_EQ(back[i].name, drawn[i].name) << name;
      ASSERT_EQ(is.degree(), was.degree()) << name;
      ASSERT_EQ(is.control_points().cols(), was.control_points().cols()) << name;
      EXPECT_LE(
          (is.control_points().colwise().hnormalized() - was.control_points().colwise().hnormalized()).norm(),
          1e-15)
          << name << i;
      EXPECT_LE((is.control_points().row(3) / is.control_points()(3, 0) -
                 was.control_points().row(3) / was.control_points()(3, 0))
                    .norm(),
                1e-14)
          << name << i;
    }
    EXPECT_EQ(back[0].curve.knots(), drawn[0].curve.knots()) << name;
  }
}

TEST_F(Convert, LayersAndColoursAreKeptOrToldAsLost) {
  const std::string source = file("looks.json", R"({"unit": "m", "curves": [
    {"name": "cable", "layer": "Träger 1", "colour": "#ff8001", "degree": 1, "knots": [0, 0, 1, 1],
     "control_points": [[0, 0], [1, 0]]},
    {"name": "rail", "layer": "7", "colour": "#00ff00", "degree": 2, "knots": [0, 0, 0, 1, 1, 1],
     "control_points": [[0, 0], [1, 0], [1, 2]]},
    {"name": "plain", "degree": 1, "knots": [0, 0, 1, 1], "control_points": [[3, 0], [1, 0]]}]})");
  for (const auto& [name, lost] : std::vector<std::pair<std::string, std::string>>{
           {"c.step", ""},
           {"c.json", ""},
           {"c.dxf", "written without the names of 2 curves"},
           {"c.igs", "written without the layers of 1 curve,"}}) {
    const Answer answer = answer_to({"convert", source, file(name)});
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.err.empty(), lost.empty()) << answer.err;
    EXPECT_NE(answer.err.find(lost), std::string::npos) << answer.err;
    const std::vector<ImportedCurve> back = curves_of(file(name));
    ASSERT_EQ(back.size(), 3U) << name;
    EXPECT_EQ(back[0].colour, "#ff8001") << name;
    EXPECT_EQ(back[1].colour, "#00ff00") << name;
    EXPECT_EQ(back[2].colour, "") << name;
    EXPECT_EQ(back[0].layer, name == "c.igs" ? "" : "Träger 1") << name;
    EXPECT_EQ(back[1].layer, "7") << name;
  }
  const Answer brep = answer_to({"convert", source, file("c.brep")});
  EXPECT_NE(brep.err.find("names of 3, layers of 2, colours of 2 curves"), std::string::npos) << brep.err;
  EXPECT_EQ(std::count(brep.err.begin(), brep.err.end(), '\n'), 1) << brep.err;
  ASSERT_EQ(answer_to({"convert", source, file("c.svg")}).code, 0);
  EXPECT_NE(content_of(file("c.svg")).find("stroke=\"#ff8001\""), std::string::npos);
}

TEST_F(Convert, CurvesAreChosenByNameOrNumber) {
  const std::string source = file("source.json", three_curves);
  ASSERT_EQ(answer_to({"convert", source, file("two.json"), "--curve", "line", "--curve", "1"}).code, 0);
  const std::vector<ImportedCurve> two = curves_of(file("two.json"));
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].name, "quintic");
  EXPECT_EQ(two[1].name, "line");
  for (const char* wrong : {"lime", "4", "0"}) {
    const Answer answer = answer_to({"convert", source, file("none.json"), "--curve", wrong});
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.err.find("1 \"quintic\", 2 \"quarter\", 3 \"line\""), std::string::npos) << answer.err;
    EXPECT_FALSE(fs::exists(file("none.json")));
  }
}

TEST_F(Convert, ChainsAreJoinedSmoothlyOrAsTheyAre) {
  const std::string source = file("source.json", three_curves);
  for (const bool exact : {false, true}) {
    std::vector<std::string> words{"convert", source, file("joined.json"), "--join",
                                   "--curve", "2",    "--curve",           "3"};
    if (exact) words.emplace_back("--exact");
    ASSERT_EQ(answer_to(words).code, 0);
    const std::vector<ImportedCurve> joined = curves_of(file("joined.json"));
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined[0].name, "quarter");
    EXPECT_EQ(joined[0].curve.degree(), 2);
    EXPECT_NEAR(length(joined[0].curve), 0.0254 * (pi / 2 + 3), 1e-13);
  }
}

TEST_F(Convert, GapsThatAreClosedAreToldAndRefusedWhenAllMustBeExact) {
  const std::string source = file("gap.json", R"({"unit": "m", "curves": [
    {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]]},
    {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[1, 1e-7], [1, 1]]}]})");
  const Answer closed = answer_to({"convert", source, file("closed.json"), "--join"});
  EXPECT_EQ(closed.code, 0);
  EXPECT_NE(closed.err.find("1e-07 m"), std::string::npos) << closed.err;
  EXPECT_EQ(curves_of(file("closed.json")).size(), 1U);
  EXPECT_EQ(answer_to({"convert", source, file("exact.json"), "--join", "--exact"}).code, 2);
}

TEST_F(Convert, CurvesAreCutAtParameters) {
  const std::string source = file("source.json", three_curves);
  ASSERT_EQ(answer_to({"convert", source, file("cut.json"), "--split-at", "0.5,1.5"}).code, 0);
  const std::vector<ImportedCurve> whole = curves_of(source), cut = curves_of(file("cut.json"));
  ASSERT_EQ(cut.size(), 8U);  // 0.5 cuts all, 1.5 all but the quarter
  EXPECT_EQ(cut[0].name, "quintic 1");
  EXPECT_EQ(cut[4].name, "quarter 2");
  EXPECT_NEAR(length(cut[0].curve) + length(cut[1].curve) + length(cut[2].curve), length(whole[0].curve),
              1e-15);
  EXPECT_LE((cut[1].curve.point(1.5) - whole[0].curve.point(1.5)).norm(), 1e-15);
  const Answer outside = answer_to({"convert", source, file("cut.json"), "--split-at", "7"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.err.find("runs from 0 to 2"), std::string::npos) << outside.err;
}

TEST_F(Convert, HiddenCurvesAreWrittenOnlyByName) {
  std::string drawing =
      "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES 0 LINE 8 a 60 1 11 1 0 LINE "
      "8 b 62 1 11 2 0 ENDSEC 0 EOF ";
  std::replace(drawing.begin(), drawing.end(), ' ', '\n');
  const std::string source = file("hidden.dxf", drawing);
  const Answer answer = answer_to({"convert", source, file("shown.step")});
  ASSERT_EQ(answer.code, 0);
  EXPECT_NE(answer.err.find("1 hidden curve is left out"), std::string::npos) << answer.err;
  const std::vector<ImportedCurve> shown = curves_of(file("shown.step"));
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].name, "b");  // of its layer
  EXPECT_EQ(shown[0].colour, "#ff0000");
  ASSERT_EQ(answer_to({"convert", source, file("all.dxf"), "--curve", "1", "--curve", "2"}).code, 0);
  EXPECT_EQ(curves_of(file("all.dxf")).size(), 2U);
}

TEST_F(Convert, WhatCannotBeIsNamed) {
  const std::string source = file("source.json", three_curves);
  for (const auto& [words, reason] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{source, file("c.obj")}, ".step .stp .igs"},
           {{file("absent.step"), file("c.step")}, "no such file"},
           {{source, file("c.brep"), "--unit", "m"}, "BREP declares no length unit"},
           {{source, file("c.svg")}, "lie in no plane"},
           {{source, file("c.svg"), "--curve", "2", "--exact"}, "exactly"},
           {{source, file("c.step"), "--unit", "yard"}, "no length unit"},
           {{source, file("c.step"), "--split-at", "a"}, "--split-at"}}) {
    std::vector<std::string> line{"convert"};
    line.insert(line.end(), words.begin(), words.end());
    const Answer answer = answer_to(line);
    EXPECT_NE(answer.code, 0);
    EXPECT_NE(answer.err.find(reason), std::string::npos) << answer.err;
  }
}

TEST_F(Convert, SvgHasThePathsOfAPlane) {
  const std::string source = file("plane.json", R"({"unit": "mm", "curves": [
    {"name": "a < b", "degree": 1, "knots": [0, 0, 1, 2, 2], "control_points": [[0, 0], [10, 0], [10, 5]]},
    {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "control_points": [[0, 0], [1, 2], [3, 2], [4, 0]]},
    {"name": "arc", "degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[1, 0], [1, 1], [0, 1]],
     "weights": [1, 0.7071067811865476, 1]}]})");
  const Answer answer = answer_to({"convert", source, file("plane.svg")});
  ASSERT_EQ(answer.code, 0) << answer.err;
  EXPECT_NE(answer.err.find("1 curve(s) with weights"), std::string::npos) << answer.err;
  const std::string text = content_of(file("plane.svg"));
  EXPECT_NE(text.find("<path d=\"M0,0 L10,0 L10,-5\"><title>a &lt; b</title></path>"), std::string::npos)
      << text;
  EXPECT_NE(text.find("<path d=\"M0,0 C1,-2 3,-2 4,0\"></path>"), std::string::npos) << text;
  // Every end of a cubic of the arc lies on it, and its middle within 1e-6 of the size.
  std::istringstream arc(text.substr(text.find("M1,0 C") + 5));
  Eigen::Vector2d start(1, 0);
  int count = 0;
  for (std::string c; arc >> c && c[0] == 'C'; ++count) {
    Eigen::Matrix<double, 2, 4> p;
    p.col(0) = start;
    for (int i = 1; i < 4; ++i) {
      std::string pair;
      if (i == 1)
        pair = c.substr(1);
      else
        arc >> pair;
      std::sscanf(pair.c_str(), "%lf,%lf", &p(0, i), &p(1, i));
    }
    start = p.col(3);
    EXPECT_NEAR(start.norm(), 1, 1e-11);
    EXPECT_NEAR((p * Eigen::Vector4d(1, 3, 3, 1) / 8).norm(), 1, 1.2e-5);
  }
  EXPECT_GE(count, 1);
  EXPECT_LE((start - Eigen::Vector2d(0, -1)).norm(), 1e-11);
}

TEST_F(Convert, TransformScalesMirrorsTurnsAndMovesInThisOrder) {
  const std::string source = file("line.json", R"({"unit": "m", "curves": [
    {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[1, 0, 0], [2, 1, 3]]}]})");
  const auto end_after = [&](std::vector<std::string> options) {
    std::vector<std::string> words{"transform", source, file("out.json")};
    words.insert(words.end(), options.begin(), options.end());
    const Answer answer = answer_to(words);
    EXPECT_EQ(answer.code, 0) << answer.err;
    const NurbsCurve curve = curves_of(file("out.json")).at(0).curve;
    return Eigen::Vector3d(curve.point(curve.knots().end()));
  };
  EXPECT_LE((end_after({"--move=1,-200 mm,0"}) - Eigen::Vector3d(3, 0.8, 3)).norm(), 1e-15);
  EXPECT_LE((end_after({"--scale=2"}) - Eigen::Vector3d(4, 2, 6)).norm(), 1e-15);
  EXPECT_LE((end_after({"--scale=2,1,0.5"}) - Eigen::Vector3d(4, 1, 1.5)).norm(), 1e-15);
  EXPECT_LE((end_after({"--mirror=x"}) - Eigen::Vector3d(-2, 1, 3)).norm(), 1e-15);
  EXPECT_LE((end_after({"--mirror=1,-1,0"}) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-15);
  EXPECT_LE((end_after({"--turn=90"}) - Eigen::Vector3d(-1, 2, 3)).norm(), 1e-15);
  EXPECT_LE((end_after({"--turn", "0.25 rev", "--axis", "x"}) - Eigen::Vector3d(2, -3, 1)).norm(), 1e-15);
  EXPECT_LE((end_after({"--turn=180", "--about=1,0,0"}) - Eigen::Vector3d(0, -1, 3)).norm(), 1e-15);
  // (2, 1, 3): scaled (4, 2, 6), mirrored (-4, 2, 6), turned (-2, -4, 6), moved (-2, -4, 7).
  EXPECT_LE(
      (end_after({"--move=0,0,1", "--turn=90 deg", "--mirror=x", "--scale=2"}) - Eigen::Vector3d(-2, -4, 7))
          .norm(),
      1e-14);
}

TEST_F(Convert, TransformsThatMakeNoSenseAreRefused) {
  const std::string source = file("source.json", three_curves);
  for (const char* option : {"--scale=0", "--scale=1,2", "--scale=-1", "--mirror=0,0,0", "--mirror=w",
                             "--turn=1 m", "--axis=x", "--move=1,2", "--about=1"}) {
    const Answer answer = answer_to({"transform", source, file("out.json"), option});
    EXPECT_EQ(answer.code, 2) << option;
    EXPECT_FALSE(fs::exists(file("out.json"))) << option;
  }
}

TEST_F(Convert, CompareMeasuresCurvesOfHighDegreeThemselves) {
  // y = x (1 - x) with degree 5, and the same 1e-7 higher as the parabola it is.
  const std::string high = file("high.json", R"({"unit": "m", "curves": [{"degree": 5,
    "knots": [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1],
    "control_points": [[0, 0], [0.2, 0.2], [0.4, 0.3], [0.6, 0.3], [0.8, 0.2], [1, 0]]}]})");
  const std::string low =
      file("low.json", R"({"unit": "m", "curves": [{"degree": 2, "knots": [0, 0, 0, 1, 1, 1],
    "control_points": [[0, 1e-7], [0.5, 0.5000001], [1, 1e-7]]}]})");
  for (const char* tolerance : {"10", "1e-3", "1e-6"}) {
    const Answer answer = answer_to({"compare", high, low, "--tolerance", tolerance});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("largest distance: 1e-07 m"), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("the curves are the same: the tolerance is"), std::string::npos) << answer.out;
  }
  const Answer differ = answer_to({"compare", high, low, "--tolerance", "0.99e-7"});
  EXPECT_EQ(differ.code, 1);
  EXPECT_NE(differ.out.find("the curves differ: the tolerance is 9.9e-08 m"), std::string::npos)
      << differ.out;
  // A thousandth of the round-off of a double beside the size.
  const std::string nearly = file("nearly.json", R"({"unit": "m", "curves": [{"degree": 1,
    "knots": [0, 0, 1, 1], "control_points": [[0, 1e-19], [1, 1e-19]]}]})"),
                    line = file("line.json", R"({"unit": "m", "curves": [{"degree": 1,
    "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0]]}]})");
  EXPECT_NE(answer_to({"compare", nearly, line}).out.find("largest distance: 0 m"), std::string::npos);
}

TEST_F(Convert, TheSchemaNamesWhatIsWritten) {
  const nlohmann::json schema = nlohmann::json::parse(answer_to({"schema", "curves"}).out);
  const nlohmann::json& known = schema["properties"]["curves"]["items"]["properties"];
  ASSERT_EQ(answer_to({"convert", file("source.json", three_curves), file("c.json")}).code, 0);
  const nlohmann::json written = nlohmann::json::parse(content_of(file("c.json")));
  for (const auto& [key, value] : written.items()) EXPECT_TRUE(schema["properties"].contains(key)) << key;
  for (const nlohmann::json& curve : written["curves"])
    for (const auto& [key, value] : curve.items()) EXPECT_TRUE(known.contains(key)) << key;
}

TEST_F(Convert, InspectTellsTheWholeNurbs) {
  const Answer answer = answer_to({"inspect", file("source.json", three_curves), "--json"});
  const nlohmann::json curve = nlohmann::json::parse(answer.out)[0]["curves"][0];
  EXPECT_EQ(curve["name"], "quintic");
  EXPECT_EQ(curve["nurbs"]["degree"], 5);
  EXPECT_EQ(curve["nurbs"]["knots"].size(), 13U);
  EXPECT_EQ(curve["nurbs"]["knots"][6], 1.5);
  EXPECT_NEAR(curve["nurbs"]["control_points"][1][2].get<double>(), 3 * 0.0254, 1e-16);  // metres
  EXPECT_EQ(curve["nurbs"]["weights"], nlohmann::json({1, 2, 0.7, 1, 1, 3, 1}));
  EXPECT_EQ(nlohmann::json::parse(answer.out)[0]["unit"], "inch");
}

}  // namespace
}  // namespace nurbeam
