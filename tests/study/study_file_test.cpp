#include "pipelines/study/study_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipelines/study/analysis.h"
#include "tests/study/study_text.h"

namespace nurbeam {
namespace {

using test::study_of;
using test::TemporaryDirectory;
using test::wrong_with;

TEST(StudyFile, ReadsUnitsByWhatTheVariableIs) {
  const StudyFile study = study_of(R"json({
    "nurbeam_study": 1, "case": "c.json", "seed": 7, "time_limit": "2 min",
    "variables": [
      {"name": "radius", "path": "beams[0].section.radius", "range": ["4 mm", 0.008]},
      {"name": "E", "path": ["beams[0].material.youngs_modulus", "beams[cable].material.youngs_modulus"],
       "distribution": {"normal": {"mean": "200 GPa", "sd": "10 GPa"}, "lower": "150 GPa"}},
      {"name": "sag", "transform": {"beam": "cable", "points": [1, 2], "translate": [0, 0, -2]}, "range": ["10 cm", "1 m"]},
      {"name": "top", "control_point": {"beam": "cable", "index": 3, "axis": "z"}, "range": [0, "200 mm"]},
      {"name": "area", "value": "pi * radius ^ 2"}],
    "constraints": ["radius < 0.007"],
    "quantities": [{"name": "v", "value": "max(trolley.speed)", "unit": "m/s"}],
    "plan": {"list": [["5 mm", 2e11, "0.5 m", "1 cm"]]}})json");
  EXPECT_EQ(study.variables[0].distribution.parameters, (std::vector<double>{0.004, 0.008}));
  EXPECT_EQ(study.variables[0].nominal, 0.006);
  EXPECT_EQ(study.variables[1].distribution.parameters, (std::vector<double>{2e11, 1e10}));
  EXPECT_EQ(study.variables[1].distribution.lower, 1.5e11);
  EXPECT_EQ(study.variables[2].distribution.parameters, (std::vector<double>{0.1, 1}));
  EXPECT_EQ(std::get<CurveTransform>(*study.variables[2].target).direction, -Eigen::Vector3d::UnitZ());
  EXPECT_EQ(study.variables[0].unit, "m");
  EXPECT_EQ(study.variables[1].unit, "Pa");
  EXPECT_EQ(study.variables[4].unit, "");
  EXPECT_EQ(study.free_variables(), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(std::get<StudyPlan>(study.task).rows, (StudyPoints{{0.005, 2e11, 0.5, 0.01}}));
  EXPECT_EQ(study.seed, 7U);
  EXPECT_EQ(study.time_limit, 120);
}

TEST(StudyFile, WarnsOfAVariableThatChangesNothing) {
  const auto warned = [](const std::string& value) {
    const TemporaryDirectory directory;
    const StudyFileReport report = read_study_file(directory.write("study.json", R"json({
      "nurbeam_study": 1,
      "variables": [{"name": "x", "range": [0, 1]}, {"name": "y", "range": [0, 1]}, {"name": "z", "value": "2 * y"}],
      "quantities": [{"name": "f", "value": ")json" + value + R"json("}], "plan": {"list": [[0, 0]]}})json"));
    EXPECT_TRUE(report.value);
    std::string all;
    for (const Diagnostic& d : report.diagnostics) all += d.where + ": " + d.message + "\n";
    return all;
  };
  EXPECT_EQ(warned("x + z"), "");
  EXPECT_EQ(warned("x"), "");  // y stands in z, which is a column to be read
  const std::string of_x = warned("z");
  EXPECT_NE(of_x.find("variables[0]: \"x\" changes nothing"), std::string::npos) << of_x;
  EXPECT_EQ(of_x.find("\"y\" changes"), std::string::npos) << of_x;
}

// A tension of 2374 N would stand in the table as 2374 kN.
TEST(StudyFile, WarnsOfAUnitThatANumberDoesNotHave) {
  const auto warned = [](const std::string& value, const std::string& unit) {
    const TemporaryDirectory directory;
    const StudyFileReport report = read_study_file(directory.write("study.json", R"json({
      "nurbeam_study": 1, "case": "case.json",
      "variables": [{"name": "m", "path": "bodies[0].mass", "range": [1, 2]}],
      "quantities": [{"name": "f", "value": ")json" + value + R"json(", "unit": ")json" +
                                                                                     unit + R"json("}],
      "plan": {"grid": 2}})json"));
    std::string all;
    for (const Diagnostic& d : report.diagnostics)
      if (d.where.ends_with(".unit")) all += d.message;
    return all;
  };
  EXPECT_NE(warned("max(a.axial_force.max)", "kN").find("let \"value\" be \"max(a.axial_force.max) / 1000\""),
            std::string::npos)
      << warned("max(a.axial_force.max)", "kN");
  EXPECT_NE(warned("max(a.sag)", "mm").find("/ 0.001\""), std::string::npos);
  for (const auto& [value, unit] : {std::pair("max(a.axial_force.max) / 1000", "kN"),
                                    {"max(a.axial_force.max)", "N"},
                                    {"m", "g"},
                                    {"max(a.sag)", "parts"}})
    EXPECT_EQ(warned(value, unit), "") << value;
}

TEST(StudyFile, SaysAllThatIsWrongAtOnceWithItsPlace) {
  const std::string wrong = wrong_with(R"json({
    "nurbeam_study": 1, "case": "c.json",
    "variables": [
      {"name": "a", "path": "beams[0].section.radios", "range": [1, 2]},
      {"name": "b", "path": "beams[0].section.radius", "range": ["4 kg", "5 mm"]},
      {"name": "b", "path": "gravity[2]", "range": [2, 1]},
      {"name": "c", "distribution": {"lognormal": {"mean": -1, "sd": 0}}},
      {"name": "d", "value": "2 * e"},
      {"name": "f", "path": "beams[0].section", "range": [0, 1]},
      {"name": "g", "path": "loads[0].time[1][0]", "range": ["1 ms", "5 mm"]},
      {"name": "h", "path": "supports[0].motion[1][4]", "range": [0, 1]}],
    "constraints": ["a <"],
    "quantities": [{"name": "q", "value": "maxi(x.y)"}],
    "optimise": {"minimise": "speed", "subject_to": ["q"]}})json");
  for (
      const char* text :
      {"study.json: variables[0].path: \"beams[0].section.radios\": there is no \"radios\" in beams[0].section; did you mean \"radius\"?",
       "study.json: variables[1].range[0]:", "study.json: variables[2].range: 2 is not below 1",
       "study.json: variables[2].name: \"b\" is the name of two variables",
       "study.json: variables[3].distribution.lognormal.mean: is -1; must be greater than 0",
       "study.json: variables[3].distribution.lognormal.sd: is 0; must be greater than 0",
       "study.json: variables[4].value: there is no earlier variable \"e\"",
       "study.json: variables[5].path: \"beams[0].section\": is no single number",
       "study.json: variables[6].range[1]: \"5 mm\": the unit does not measure time",
       "study.json: variables[7].path: \"supports[0].motion[1][4]\": supports[0].motion is a table; name a row of it and one of the 4 numbers in it, as in supports[0].motion[0][1]",
       "study.json: constraints[0]: \"a <\", character 4: the expression ends",
       "study.json: quantities[0].value: \"maxi(x.y)\", character 1: there is no function \"maxi\"",
       "study.json: optimise.minimise: there is no quantity \"speed\"",
       "study.json: optimise.subject_to[0]: \"q\" is no inequality"})
    EXPECT_NE(wrong.find(text), std::string::npos) << text << "\n" << wrong;
}

TEST(StudyFile, RefusesNamesOfOtherColumnsOfItsTable) {
  const std::string wrong = wrong_with(R"json({
    "nurbeam_study": 1, "variables": [{"name": "status", "range": [0, 1]}, {"name": "x", "range": [0, 1]}],
    "quantities": [{"name": "wall time [s]", "value": "x"}, {"name": "reasons", "value": "x"}],
    "plan": {"monte_carlo": {"count": 2}}})json");
  for (const char* text :
       {"variables[0].name: \"status\" is a column that study.csv has already; give another",
        "quantities[0].name: \"wall time [s]\" is a column that study.csv has already"})
    EXPECT_NE(wrong.find(text), std::string::npos) << text << "\n" << wrong;
  EXPECT_EQ(wrong.find("reasons"), std::string::npos) << wrong;
}

TEST(StudyFile, RefusesWhatWouldBeLeftOutWithoutAWord) {
  const std::string wrong = wrong_with(R"json({
    "nurbeam_study": 1, "case": "c.json",
    "variables": [
      {"name": "pi", "path": "gravity[2]", "range": [1, 2]},
      {"name": "it's", "path": "gravity[1]", "range": [1, 2]},
      {"name": "c", "path": "gravity[2]", "range": [1, 2]},
      {"name": "d", "control_point": {"beam": "b", "index": 1, "axis": "z"}, "range": [1, 2]},
      {"name": "e", "control_point": {"beam": "b", "index": 1, "axis": "z"}, "range": [1, 2]}],
    "quantities": [{"name": "q", "value": "max(x.y)"}],
    "optimise": {"minimise": "q", "method": "nelder_mead", "subject_to": ["q < 1"]}})json");
  for (const char* text : {"study.json: variables[0].name: is that of 3.14159",
                           "study.json: variables[1].name: has a single quote",
                           "study.json: variables[2]: sets \"gravity[2]\", as \"pi\" does",
                           "study.json: variables[4]: sets z of control point 1 of \"b\", as \"d\" does",
                           "study.json: optimise.method: is \"nelder_mead\", which knows no \"subject_to\""})
    EXPECT_NE(wrong.find(text), std::string::npos) << text << "\n" << wrong;
}

TEST(StudyFile, RefusesEndsBetweenWhichNothingIs) {
  const auto wrong = [](const std::string& variable) {
    return wrong_with(R"json({"nurbeam_study": 1, "variables": [{"name": "x", )json" + variable +
                      R"json(}], "quantities": [{"name": "y", "value": "x"}],
                          "plan": {"monte_carlo": {"count": 10}}})json");
  };
  const std::string normal = R"("distribution": {"normal": {"mean": 1, "sd": 0.1}, )";
  EXPECT_NE(wrong(normal + R"("lower": 9}, "nominal": 9.5)").find("variables[0].distribution: has nothing"),
            std::string::npos);
  EXPECT_NE(wrong(R"("distribution": {"uniform": [1, 2], "upper": 0.5})").find("has nothing"),
            std::string::npos);
  EXPECT_NE(wrong(R"("range": [1, 2], "nominal": 3)").find("variables[0].nominal: is 3, outside of 1 to 2"),
            std::string::npos);
  EXPECT_NE(wrong(normal + R"("lower": 4, "upper": 5})").find("variables[0].distribution: has nothing"),
            std::string::npos);
  EXPECT_EQ(wrong(normal + R"("lower": 0.9, "upper": 1.3})"), "");
  EXPECT_EQ(wrong(normal + R"("lower": 1.2, "upper": 1.3})"), "");
}

TEST(StudyFile, NeedsBothMomentsOfADistribution) {
  for (const char* law : {"normal", "lognormal", "gumbel", "weibull"})
    for (const auto& [moments, missing] : {std::pair{R"({"mean": 1})", "sd"}, {R"({"sd": 1})", "mean"}}) {
      const std::string wrong = wrong_with(
          R"json({"nurbeam_study": 1, "variables": [{"name": "x", "distribution": {")json" +
          std::string(law) + "\": " + moments + R"json(}}], "quantities": [{"name": "y", "value": "x"}],
              "plan": {"monte_carlo": {"count": 10}}})json");
      EXPECT_NE(wrong.find("variables[0].distribution." + std::string(law) + ": \"" + missing + "\""),
                std::string::npos)
          << wrong;
    }
}

TEST(StudyFile, MovesAControlPointOnce) {
  const std::string wrong =
      wrong_with(R"json({"nurbeam_study": 1, "case": "c.json", "variables": [{"name": "x",
    "transform": {"beam": "b", "points": [2, 1, 2], "translate": [0, 0, 1]}, "range": [0, 1]}],
    "quantities": [{"name": "y", "value": "x"}], "plan": {"monte_carlo": {"count": 10}}})json");
  EXPECT_NE(wrong.find("variables[0].transform.points[2]: is 2 again"), std::string::npos) << wrong;
}

TEST(StudyFile, WarnsOfConstraintsThatASearchCannotFollow) {
  const auto told = [](const std::string& constraint, const std::string& method) {
    return wrong_with(R"json({"nurbeam_study": 1,
      "variables": [{"name": "x", "range": [0, 1]}], "constraints": ["x < 0.9", ")json" +
                      constraint + R"json("],
      "quantities": [{"name": "f", "value": "x"}], "optimise": {"minimise": "f", "method": ")json" +
                      method + "\"}}");
  };
  EXPECT_EQ(told("(x > 0.5) * (x < 0.8)", "cobyla").find("study.json: constraints[1]: "), 0U);
  EXPECT_EQ(told("(x > 0.5) * (x < 0.8)", "genetic"), "");
  EXPECT_EQ(told("x > 0.5", "cobyla"), "");
  const std::string once = told("x >", "cobyla");
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 1) << once;
}

// As it is cut off: phi(1) / (1 - Phi(1)), phi(1) / Phi(1); of a triangle the mean, not the peak.
TEST(StudyFile, TakesTheMeanOfWhatIsLeftAsNominal) {
  for (const auto& [distribution, mean] :
       {std::pair{R"("normal": {"mean": 0, "sd": 1}, "lower": 1)", 0.2419707245 / 0.1586552539},
        {R"("normal": {"mean": 0, "sd": 1}, "upper": 1)", -0.2419707245 / 0.8413447461},
        {R"("normal": {"mean": 0.3, "sd": 1})", 0.3},
        {R"("triangular": [0, 1, 5])", 2.0}}) {
    const StudyFile study =
        study_of(R"json({"nurbeam_study": 1, "variables": [{"name": "x", "distribution": {)json" +
                 std::string(distribution) + R"json(}}],
      "quantities": [{"name": "y", "value": "x"}], "plan": {"monte_carlo": {"count": 10}}})json");
    EXPECT_NEAR(study.variables[0].nominal, mean, 1e-6) << distribution;
  }
}

TEST(StudyFile, RefusesNamesThatCannotHeadAColumn) {
  const std::string wrong =
      wrong_with(R"json({"nurbeam_study": 1, "variables": [{"name": "x ", "range": [0, 1]}],
    "quantities": [{"name": "sag/span", "value": "3"}], "plan": {"monte_carlo": {"count": 10}}})json");
  EXPECT_NE(wrong.find("variables[0].name: \"x \" cannot head a column of study.nc"), std::string::npos)
      << wrong;
  EXPECT_NE(wrong.find("quantities[0].name: \"sag/span\" cannot"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("\"sag-span\" can"), std::string::npos) << wrong;
}

TEST(StudyFile, IsToldFromACaseFile) {
  EXPECT_EQ(wrong_with(R"json({"nurbeam": 1, "beams": [], "analysis": {"type": "static"}})json"),
            "study.json: this is a case file, and a study file is wanted; \"nurbeam run\" takes it\n");
}

TEST(StudyFile, NeedsOneTask) {
  const std::string head = R"json({"nurbeam_study": 1, "variables": [{"name": "x", "range": [0, 1]}],
                               "quantities": [{"name": "y", "value": "x"}])json";
  EXPECT_NE(wrong_with(head + "}").find("plan"), std::string::npos);
  EXPECT_NE(wrong_with(head + R"json(, "plan": {"grid": 3}, "sensitivity": {"count": 10}})json")
                .find("sensitivity"),
            std::string::npos);
  EXPECT_EQ(wrong_with(head + R"json(, "plan": {"grid": 3}})json"), "");
  EXPECT_NE(wrong_with(head + R"json(, "plan": {"grid": [3, 4]}})json").find("has 2 numbers for 1 variables"),
            std::string::npos);
}

// Each message is one that a user can act on: nothing is said of what only follows from another error.
TEST(StudyFile, SaysNothingOfWhatFollowsFromAnotherError) {
  const auto wrong = [](const std::string& rest) {
    return wrong_with(R"json({"nurbeam_study": 1, )json" + rest);
  };
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const std::string a = R"json("variables": [{"name": "a", "range": [0, 1]}], )json";
  for (
      const std::string& one :
      {wrong(a + R"json("quantities": [{"name": "q", "value": "a +"}], "optimise": {"minimise": "q"}})json"),
       wrong(a + R"json("quantities": 5, "plan": {"grid": 2}})json"),
       wrong(R"json("variables": [{"name": "a", "range": [0, 1]}, {"name": "b", "value": "2 *"}],
             "quantities": [{"name": "q", "value": "a + b"}], "plan": {"list": [[1]]}})json"),
       wrong(R"json("variables": [{"name": "a", "range": [0, 1]}, {"nome": "b", "name": 5, "range": [0, 1]}],
             "quantities": [{"name": "q", "value": "a + b"}], "plan": {"grid": [2, 2]}})json"),
       wrong(
           R"json("variables": [5], "quantities": [{"name": "q", "value": "a"}], "plan": {"list": [[1]]}})json"),
       wrong(R"json("case": "c.json", "variables": [{"name": "a", "path": "gravity[2]", "range": [0, 1]}],
             "calibrate": {"observations": [{"value": "tip.x", "measured": [[0, 1], [0, 2]]}]}})json")})
    EXPECT_LE(lines(one), 2) << one;
  for (const char* untrue :
       {"is missing: what is asked", "no quantity \"q\"", "no variable", "numbers for", "values for"})
    EXPECT_EQ(wrong(R"json("variables": [{"name": "a", "range": [0, 1]}, {"name": "b,c", "range": [0, 1]}],
                "quantities": [{"name": "q", "value": "a + b +"}], "optimise": {"minimise": "q"}})json")
                  .find(untrue),
              std::string::npos)
        << untrue;
  const std::string empty = wrong_with("  ");
  EXPECT_NE(empty.find("study.json: is empty; expected a study file (JSON)"), std::string::npos) << empty;
  EXPECT_EQ(empty.find("beams"), std::string::npos) << empty;
}

TEST(StudyFile, RefusesHistoriesWhereThereAreOnlyNumbers) {
  const std::string wrong = wrong_with(R"json({"nurbeam_study": 1,
    "variables": [{"name": "a", "range": [0, 1]}, {"name": "b", "value": "max(a)"}],
    "constraints": ["time(leaves, x) < 1"],
    "quantities": [{"name": "q", "value": "at(end, a)"}, {"name": "r", "value": "2 * a"}],
    "optimise": {"minimise": "r", "subject_to": ["mean(r) < 1"]}})json");
  for (const char* text : {"variables[1].value: \"max(a)\": max needs a history",
                           "constraints[0]: \"time(leaves, x) < 1\": time(leaves, x) needs a run with events",
                           "quantities[0].value: \"at(end, a)\": at needs a history",
                           "optimise.subject_to[0]: \"mean(r) \": mean needs a history"})
    EXPECT_NE(wrong.find(text), std::string::npos) << text << "\n" << wrong;
}

TEST(StudyFile, NeedsACaseForWhatChangesOne) {
  const std::string wrong = wrong_with(R"json({"nurbeam_study": 1, "set": ["gravity[2]=-1"],
    "refine": [{"beam": "b", "parts": 2}],
    "variables": [{"name": "a", "control_point": {"beam": "b", "index": 1, "axis": "z"}, "range": [0, 1]}],
    "calibrate": {"observations": [{"value": "tip.x", "measured": [[0, 1], [1, 2]]}]}})json");
  for (const char* text :
       {"\"set\" needs \"case\"", "\"refine\" needs \"case\"", "\"calibrate\" needs \"case\"",
        "variables[0]: changes a case, but the study has no \"case\""})
    EXPECT_NE(wrong.find(text), std::string::npos) << text << "\n" << wrong;
}

TEST(StudyFile, SaysWhatIsToBeDoneWithWholeNumbers) {
  const auto told = [](const std::string& task,
                       const std::string& more = "\"range\": [4, 9], \"nominal\": 6") {
    const TemporaryDirectory directory;
    std::string all;
    for (const Diagnostic& d :
         read_study_file(
             directory.write(
                 "study.json",
                 R"json({"nurbeam_study": 1, "case": "c.json", "variables": [{"name": "x", "range": [0, 1]},
      {"name": "n", "path": "beams[0].elements.count", )json" +
                     more + R"json(}], "quantities": [{"name": "q", "value": "x * max(tip.x)"}], )json" +
                     task + "}"))
             .diagnostics)
      all += (d.severity == Severity::error ? "error: " : "warning: ") + d.message + "\n";
    return all;
  };
  const std::string
      whole = "\"beams[0].elements.count\" is a whole number, ",
      cure =
          "; take a \"plan\" with \"list\" or \"grid\", or give it a \"value\" of whole numbers made "
          "of another variable, as \"4 + 2 * (x > 0.5)\"\n";
  const std::string warned =
                        "warning: " + whole +
                        "and any values of the range are tried: variants in which it is none are refused" +
                        cure,
                    refused = "error: " + whole + "by which nothing has a derivative" + cure;
  EXPECT_EQ(told(R"("plan": {"grid": [2, 6]})"), "");
  EXPECT_EQ(told(R"("plan": {"list": [[0, 6]]})"), "");
  EXPECT_EQ(told(R"("plan": {"sobol": {"count": 4}})"), warned);
  EXPECT_EQ(told(R"("optimise": {"minimise": "q"})"), warned);
  EXPECT_EQ(told(R"("optimise": {"minimise": "q", "method": "gradient", "derivatives": "differences"})"),
            warned);
  EXPECT_EQ(told(R"("optimise": {"minimise": "q", "method": "gradient"})"), refused);
  EXPECT_EQ(told(R"("plan": {"gradient": "nominal"})"), refused);
  EXPECT_EQ(told(R"("optimise": {"minimise": "q"})", R"json("value": "4 + 2 * (x > 0.5)")json"), "");
}

TEST(StudyFile, RefusesAQuantityThatIsNamedTwice) {
  const auto wrong = [](const std::string& task) {
    return wrong_with(R"json({"nurbeam_study": 1, "variables": [{"name": "a", "range": [0, 1]}],
      "quantities": [{"name": "q", "value": "a"}], )json" +
                      task + "}");
  };
  EXPECT_NE(wrong(R"json("optimise": {"minimise": "q", "maximise": "q"})json").find("\"q\" is named twice"),
            std::string::npos);
  EXPECT_NE(wrong(R"json("sensitivity": {"count": 8, "quantities": ["q", "q"]})json")
                .find("sensitivity.quantities[1]: \"q\" is named twice"),
            std::string::npos);
}

TEST(StudyFile, QuotesWholeCharacters) {
  const std::string wrong =
      wrong_with(R"json({"nurbeam_study": 1, "variables": [{"name": "größe", "range": [0, 1]}],
    "quantities": [{"name": "q", "value": "'größe' + ü"}, {"name": "r", "value": "2 ααααααααααααα"},
                   {"name": "s", "value": ")json" +
                 std::string(5000, '(') + R"json("}], "plan": {"grid": 2}})json");
  EXPECT_NE(wrong.find("\"'größe' + ü\", character 11: expected a number, a name or \"(\", found \"ü\""),
            std::string::npos)
      << wrong;
  EXPECT_NE(wrong.find("character 3: expected an operator or the end, found \"αααααααααααα...\""),
            std::string::npos)
      << wrong;
  EXPECT_LE(wrong.size(), 1000U) << "what is long is shortened";
}

}  // namespace
}  // namespace nurbeam
