#include "pipelines/study/study_case.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "nurbs/knot_vector.h"
#include "pipelines/study/variant.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

constexpr const char* bent_case = R"json({"nurbeam": 1,
  "beams": [{"name": "rail",
    "axis": {"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 3, 3, 3],
                       "control_points": [[0, 0, 0], [1, 0, 1], [2, 0, 1], [3, 0, 0]], "weights": [1, 2, 1, 1]}},
    "section": {"radius": 0.01}, "material": {"density": 1000, "youngs_modulus": 1e8}, "elements": {"count": 4}},
   {"name": "cable", "axis": {"polyline": [[0, 1, 0], [1, 1, 0]]},
    "section": {"radius": 0.01}, "material": {"density": 1000, "youngs_modulus": 1e8}, "elements": {"count": 4}}],
  "supports": [{"beam": "rail", "at": "start", "type": "clamped"}],
  "analysis": {"end_time": 1, "step": 0.1}})json";

struct ReadCase {
  StudyFile study;
  StudyCaseReport of_case;
  std::string messages;
};

// A study of the bent case with these variables, and more keys.
ReadCase read_with(const std::string& variables, const std::string& more = "") {
  const test::TemporaryDirectory directory;
  directory.write("case.json", bent_case);
  StudyFileReport study = read_study_file(directory.write(
      "study.json", R"json({"nurbeam_study": 1, "case": "case.json", "variables": [)json" + variables +
                        R"json(], "quantities": [{"name": "q", "value": "max(rail.length)"}],
        "plan": {"monte_carlo": {"count": 3}})json" +
                        more + "}"));
  ReadCase read;
  for (const Diagnostic& d : study.diagnostics) read.messages += d.where + ": " + d.message + "\n";
  if (!study.value) return read;
  read.study = std::move(*study.value);
  read.of_case = read_study_case(read.study);
  for (const Diagnostic& d : read.of_case.diagnostics) read.messages += d.where + ": " + d.message + "\n";
  return read;
}

NurbsCurve moved_rail(const ReadCase& read, const std::vector<double>& values) {
  return read.of_case.value->moved(read.study.variables, values).at("rail");
}
Eigen::Vector3d control_point(const NurbsCurve& curve, int i) {
  return curve.control_points().col(i).head<3>() / curve.control_points()(3, i);
}

const std::string one_point =
    R"json({"name": "a", "control_point": {"beam": "rail", "index": 2, "axis": "z"}, "range": [0, 2]})json";

TEST(StudyCase, RefinedCurvesKeepTheirShapeAndHaveMoreControlPoints) {
  const ReadCase plain = read_with(one_point);
  const ReadCase fine = read_with(
      one_point, R"json(, "refine": [{"beam": "rail", "parts": 3}, {"beam": "rail", "knots": [0.5]}])json");
  ASSERT_TRUE(fine.of_case.value) << fine.messages;
  const NurbsCurve& drawn = plain.of_case.value->curves().at("rail").drawn;
  const NurbsCurve& refined = fine.of_case.value->curves().at("rail").drawn;
  EXPECT_EQ(drawn.control_points().cols(), 4);
  EXPECT_EQ(refined.control_points().cols(), 9);  // two more knots in each of two spans, and one
  for (int i = 0; i <= 60; ++i)
    EXPECT_LE((drawn.point(0.05 * i) - refined.point(0.05 * i)).norm(), 1e-14) << i;
  // The third control point now moves the curve only up to the knot (0.5, 2/3, 1) behind its three spans.
  const NurbsCurve bent = moved_rail(fine, {1.5});
  EXPECT_GT((bent.point(0.5) - refined.point(0.5)).norm(), 0.1);
  EXPECT_LE((bent.point(1) - refined.point(1)).norm(), 1e-14);
  EXPECT_LE((bent.point(2) - refined.point(2)).norm(), 1e-14);
}

TEST(StudyCase, AppendsToListsOfTheCaseAndVariesWhatHasBeenAppended) {
  const std::string load =
      R"json(, "set": ["loads[+]={\"beam\": \"rail\", \"at\": \"end\", \"force\": [0, 0, -1]}"])json";
  const auto variable = [](const std::string& path) {
    return R"json({"name": "push", "path": ")json" + path + R"json(", "range": [-3, -1]})json";
  };
  const ReadCase read = read_with(variable("loads[0].force[2]"), load);
  ASSERT_TRUE(read.of_case.value) << read.messages;
  const std::string text = read.of_case.value->variant(read.study.variables, {-2});
  EXPECT_EQ(nlohmann::json::parse(text)["loads"][0]["force"][2], -2.0) << text;
  const ReadCase none = read_with(variable("loads[+].force[2]"), load);
  EXPECT_NE(none.messages.find("loads[+] is a new item; name a number that is there"), std::string::npos)
      << none.messages;
}

TEST(StudyCase, SaysWhichChangesAreWrongAndLooksForMore) {
  const ReadCase read = read_with(R"json(
    {"name": "a", "control_point": {"beam": "rial", "index": 2, "axis": "z"}, "range": [0, 2]},
    {"name": "b", "path": "beams[5].section.radius", "range": [1, 2]})json",
                                  R"json(, "set": ["analysis.stp=1", "gravity[2]=-1", "beams"])json");
  EXPECT_FALSE(read.of_case.value);
  ASSERT_EQ(read.of_case.changes.size(), 1U);
  EXPECT_EQ(read.of_case.changes[0].text, "gravity[2]=-1");
  for (const char* expected :
       {"study.json: set[0]: \"analysis.stp=1\": there is no \"stp\" in analysis; did you mean \"step\"",
        "study.json: set[2]: \"beams\": expected path=value",
        "study.json: variables[0]: the case has no beam \"rial\"; did you mean \"rail\"",
        "study.json: variables[1].path: beams has 2 item(s)"})
    EXPECT_NE(read.messages.find(expected), std::string::npos) << expected << "\n" << read.messages;
  EXPECT_EQ(read.messages.find("--set"), std::string::npos) << read.messages;
}

TEST(StudyCase, SaysOnceThatAPathIsNone) {
  const ReadCase read =
      read_with(R"json({"name": "a", "path": "beams[0].section.radios", "range": [1, 2]})json");
  const std::string said = "there is no \"radios\"";
  const std::size_t first = read.messages.find(said);
  ASSERT_NE(first, std::string::npos) << read.messages;
  EXPECT_EQ(read.messages.find(said, first + 1), std::string::npos) << read.messages;
}

TEST(StudyCase, SaysWhichChangeHasSetAValueThatIsWrong) {
  const ReadCase read = read_with(one_point, R"json(, "set": ["beams[rail].elements.count=0",
    "analysis.step=2", "analysis={\"end_time\": 1, \"step\": -0.1}"])json");
  EXPECT_FALSE(read.of_case.value);
  for (const char* expected :
       {"study.json: set[0]: \"beams[rail].elements.count=0\": beams[0].elements.count: ",
        "study.json: set[2]: \"analysis={\"end_time\": 1, \"step\": -0.1}\": analysis.step: "})
    EXPECT_NE(read.messages.find(expected), std::string::npos) << expected << "\n" << read.messages;
  EXPECT_EQ(read.messages.find("set[1]"), std::string::npos) << read.messages;
  ASSERT_EQ(read.of_case.changes.size(), 1U);
  EXPECT_EQ(read.of_case.changes[0].text, "analysis.step=2");
}

TEST(StudyCase, SaysOfEveryVariableWhatIsWrongWithIt) {
  const ReadCase read = read_with(R"json(
    {"name": "a", "control_point": {"beam": "rial", "index": 2, "axis": "z"}, "range": [0, 2]},
    {"name": "b", "weight": {"beam": "rail", "index": 9}, "range": [1, 2]})json");
  EXPECT_FALSE(read.of_case.value);
  for (const char* expected : {"variables[0]: the case has no beam \"rial\"; did you mean \"rail\"",
                               "variables[1]: the curve of beam \"rail\" has 4 control points"})
    EXPECT_NE(read.messages.find(expected), std::string::npos) << read.messages;
}

// However its path is written.
TEST(StudyCase, RefusesNumbersOfACurveThatOtherVariablesMove) {
  for (const char* axis : {"beams[0].axis", "beams[rail].axis", "beams.rail.axis", "beams.0.axis"}) {
    const ReadCase read = read_with(one_point + R"json(, {"name": "p", "range": [0, 1], "path": ")json" +
                                    axis + R"json(.nurbs.control_points[1][2]"})json");
    EXPECT_FALSE(read.of_case.value) << axis;
    EXPECT_NE(read.messages.find("variables[1].path: is of a curve that other variables move"),
              std::string::npos)
        << axis << "\n"
        << read.messages;
  }
}

TEST(StudyCase, SaysOfEveryQuantityWhatIsWrongWithIt) {
  ReadCase read = read_with(one_point);
  const auto quantity = [&](const std::string& name, const std::string& value) {
    read.study.quantities.push_back(read.study.quantities[0]);
    read.study.quantities.back().path = name;
    read.study.quantities.back().value = Expression::parse(value);
  };
  quantity("column", "max(rail.lenght)");
  quantity("kind", "rail.length");
  quantity("event", "time(flies, rail)");
  quantity("body", "time(leaves, rial)");
  quantity("late", "or(at(1.5, rail.length), 2)");
  quantity("in_time", "at(1.0000000000000002, rail.length)");
  std::string messages;
  for (const Diagnostic& d : check_quantities(read.study, &*read.of_case.value))
    messages += d.where + ": " + d.message + "\n";
  for (const char* expected :
       {"column.value: a run of this case has no column \"rail.lenght\"", "kind.value: ",
        "there is no event \"flies\"", "the case has no body or beam \"rial\"; did you mean \"rail\"",
        "late.value: a run of this case goes from 0 s to 1 s, and 1.5 s is not between"})
    EXPECT_NE(messages.find(expected), std::string::npos) << messages;
  EXPECT_EQ(messages.find("in_time"), std::string::npos) << messages;
}

TEST(StudyCase, RefusesTwoVariablesForOneNumberHoweverItIsWritten) {
  const ReadCase read = read_with(R"json(
    {"name": "a", "path": "beams[rail].section.radius", "range": [0.01, 0.02]},
    {"name": "b", "path": ["beams[1].section.radius", "beams[0].section.radius"], "range": [0.01, 0.02]})json");
  EXPECT_FALSE(read.of_case.value);
  EXPECT_NE(read.messages.find("study.json: variables[1].path: \"beams[0].section.radius\" is "
                               "\"beams[rail].section.radius\", which \"a\" sets"),
            std::string::npos)
      << read.messages;
}

TEST(StudyCase, RefusesModesOfWhichThereAreNoQuantities) {
  const ReadCase read = read_with(one_point, R"json(, "set": ["analysis={\"type\": \"modes\"}"])json");
  EXPECT_FALSE(read.of_case.value);
  EXPECT_NE(read.messages.find("study.json: case: finds modes, of which there are no quantities"),
            std::string::npos)
      << read.messages;
}

TEST(StudyCase, RefinementsThatCannotBeSaySo) {
  const auto wrong = [](const std::string& refine) {
    return read_with(one_point, ", \"refine\": [" + refine + "]").messages;
  };
  EXPECT_NE(wrong(R"({"beam": "rail", "knots": [4]})").find("refine[0]: the knot 4 must lie between 0 and 3"),
            std::string::npos);
  EXPECT_NE(wrong(R"({"beam": "cable", "parts": 2})")
                .find("refine[0]: no variable moves the curve of beam \"cable\""),
            std::string::npos);
  EXPECT_NE(wrong(R"({"beam": "rail"})").find("parts"), std::string::npos);
  EXPECT_EQ(wrong(R"({"beam": "rail", "knots": [4]})").find("control points"), std::string::npos)
      << "which are not those that are meant";
}

TEST(StudyCase, VariablesMoveGroupsOfControlPoints) {
  const ReadCase read = read_with(
      R"json({"name": "lift", "transform": {"beam": "rail", "points": [1, 2], "translate": [0, 0, 2]}, "range": [0, 1]},
             {"name": "turn", "transform": {"beam": "rail", "rotate": {"axis": [0, 0, 1], "about": [1, 0, 0]}}, "range": [0, "0.5 rev"]},
             {"name": "size", "transform": {"beam": "rail", "scale": {"about": [1, 0, 0]}}, "range": [1, 3]},
             {"name": "w", "weight": {"beam": "rail", "index": 2}, "range": [0.5, 2]})json");
  ASSERT_TRUE(read.of_case.value) << read.messages;
  EXPECT_EQ(read.study.variables[1].unit, "degrees");
  EXPECT_EQ(read.study.variables[1].distribution.parameters, (std::vector<double>{0, 180}));
  const NurbsCurve curve = moved_rail(read, {0.25, 90, 2, 1.5});
  // Lifted, turned by a right angle about the vertical through (1, 0, 0), then twice as large about it.
  EXPECT_LE((control_point(curve, 0) - Eigen::Vector3d(1, -2, 0)).norm(), 1e-14);
  EXPECT_LE((control_point(curve, 1) - Eigen::Vector3d(1, 0, 2.5)).norm(), 1e-14);
  EXPECT_LE((control_point(curve, 2) - Eigen::Vector3d(1, 2, 2.5)).norm(), 1e-14);
  EXPECT_LE((control_point(curve, 3) - Eigen::Vector3d(1, 4, 0)).norm(), 1e-14);
  EXPECT_EQ(curve.control_points()(3, 1), 2);
  EXPECT_EQ(curve.control_points()(3, 2), 1.5);
}

TEST(StudyCase, VariablesPlaceGroupsOfControlPoints) {
  const auto placed = [](const std::string& points) {
    const ReadCase read =
        read_with(R"json({"name": "height", "transform": {"beam": "rail", "points": [)json" + points +
                  R"json(], "place": "z"}, "range": ["50 cm", 2]})json");
    EXPECT_TRUE(read.of_case.value) << read.messages;
    EXPECT_EQ(read.study.variables[0].unit, "m");
    EXPECT_EQ(read.study.variables[0].distribution.parameters, (std::vector<double>{0.5, 2}));
    return moved_rail(read, {1.25});
  };
  const ReadCase plain = read_with(
      R"json({"name": "x", "control_point": {"beam": "rail", "index": 0, "axis": "x"}, "range": [-9, 9]})json");
  const double x = control_point(placed("2"), 0).x();
  const NurbsCurve drawn = moved_rail(plain, {x}), curve = placed("2, 1");
  // As a control point of its own, and the other one by as much.
  const double lift = 1.25 - control_point(drawn, 2).z();
  EXPECT_DOUBLE_EQ(control_point(curve, 2).z(), 1.25);
  EXPECT_LE((control_point(curve, 1) - control_point(drawn, 1) - Eigen::Vector3d(0, 0, lift)).norm(), 1e-14);
  EXPECT_EQ(control_point(curve, 3), control_point(drawn, 3));
}

TEST(StudyCase, OneValueStandsInSeveralPlaces) {
  const ReadCase read = read_with(
      R"json({"name": "r", "path": ["beams[rail].section.radius", "beams[cable].section.radius"], "range": ["5 mm", "2 cm"]},
             {"name": "left", "control_point": {"beam": "rail", "index": 1, "axis": "z"}, "range": [0, 2]},
             {"name": "right", "control_point": {"beam": "rail", "index": 2, "axis": "z"}, "value": "left"})json");
  ASSERT_TRUE(read.of_case.value) << read.messages;
  const std::string text = read.of_case.value->variant(read.study.variables, {0.0125, 0.7, 0.7});
  const std::size_t first = text.find("0.0125");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(text.find("0.0125", first + 1), std::string::npos);
  const NurbsCurve curve = moved_rail(read, {0.0125, 0.7, 0.7});
  EXPECT_DOUBLE_EQ(control_point(curve, 1).z(), 0.7);
  EXPECT_DOUBLE_EQ(control_point(curve, 2).z(), 0.7);
}

}  // namespace
}  // namespace nurbeam
