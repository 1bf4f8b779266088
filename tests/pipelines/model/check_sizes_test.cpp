#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"

namespace nurbeam::of_sizes {
namespace {

const std::string cable = R"({ "nurbeam": 1,
  "beams": [{ "name": "cable", "axis": { "polyline": [[0, 0, 10], [40, 0, 8]] }, "section": { "radius": "6 mm" },
    "material": { "density": 5200, "youngs_modulus": "60 GPa" }, "elements": { "count": 20 } }],
  "supports": [{ "beam": "cable", "at": "start", "type": "pinned" },
               { "beam": "cable", "at": "end", "type": "pinned" }],
  "loads": [{ "beam": "cable", "at": { "fraction": 0.5 }, "force": [0, 0, -800] }],
  "analysis": { "type": "static" } })";

const std::string bent = R"({ "nurbeam": 1,
  "beams": [{ "name": "pipe", "axis": { "arc": { "center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0],
      "normal": [0, 0, 1] } },
    "section": { "radius": 0.05, "bore": 0.02 }, "material": "steel" }],
  "supports": [{ "beam": "pipe", "at": "start", "type": "clamped" }], "analysis": { "type": "static" } })";

std::vector<std::string> warnings_of(const std::string& text, const std::vector<std::string>& changes) {
  std::string json = text;
  for (std::size_t i = 0; i + 1 < changes.size(); i += 2) {
    const auto at = json.find(changes[i]);
    EXPECT_NE(at, std::string::npos) << changes[i];
    json.replace(at, changes[i].size(), changes[i + 1]);
  }
  const CaseFileReport read = read_case_text(json, "case.json");
  EXPECT_TRUE(read.value);
  std::vector<std::string> warnings;
  for (const Diagnostic& each : build_model(*read.value).diagnostics)
    if (each.severity == Severity::warning) warnings.push_back(each.where + ": " + each.message);
  return warnings;
}

void expect_one(const std::string& text, const std::vector<std::string>& changes,
                const std::vector<std::string>& parts) {
  const std::vector<std::string> warnings = warnings_of(text, changes);
  ASSERT_EQ(warnings.size(), 1u) << changes.back() << (warnings.empty() ? "" : warnings.front());
  for (const std::string& part : parts)
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0] << "\n has no: " << part;
}

TEST(Sizes, ThatCanBeMeantPassWithoutAWord) {
  EXPECT_TRUE(warnings_of(cable, {}).empty());
  EXPECT_TRUE(warnings_of(bent, {}).empty());
  // A polymer without units of its own, a short elbow, a centrifuge.
  EXPECT_TRUE(warnings_of(cable, {"5200", "1", "60 GPa", "1 MPa", "-800", "-0.01"}).empty());
  EXPECT_TRUE(warnings_of(bent, {"0.05, \"bore\": 0.02", "0.35, \"bore\": 0.1"}).empty());
  EXPECT_TRUE(warnings_of(cable, {"\"nurbeam\": 1,", "\"nurbeam\": 1, \"gravity\": [0, 0, -1962],"}).empty());
}

// Nobody means a pipe of 0.09 mm.
TEST(Sizes, OfThickShortBeamsAreNotTakenForMillimetres) {
  const std::string from = R"("start": [1, 0, 0], "end": [0, 1, 0])",
                    to = R"("start": [0.1, 0, 0], "end": [0, 0.1, 0])";
  expect_one(bent, {from, to, "0.05, \"bore\": 0.02", "0.09, \"bore\": 0.08"},
             {"0.18 m thick", "below 2 times its thickness; give it a longer axis or a thinner section"});
}

TEST(Sizes, OfMillimetresAreToldWithWhatWasMeant) {
  expect_one(cable, {"\"6 mm\"", "6"}, {"beams[0].section", "12 m thick", "\"6 mm\""});
  expect_one(cable, {"\"6 mm\"", "4.5"}, {"\"4.5 mm\""});
  expect_one(cable, {"\"nurbeam\": 1,", "\"nurbeam\": 1, \"gravity\": [0, 0, -9810],"},
             {"gravity", "[0, 0, -9.81]"});
}

TEST(Sizes, OfGravityTheWrongWayAreTold) {
  const auto pulled = [](const std::string& g) {
    return std::vector<std::string>{"\"nurbeam\": 1,", "\"nurbeam\": 1, \"gravity\": " + g + ","};
  };
  expect_one(cable, pulled("[0, 0, 9.81]"), {"gravity", "upwards", "[0, 0, -9.81]"});
  const std::string straight = "\"polyline\": [[0, 0, 10], [40, 0, 8]]",
                    sagging = "\"through\": [[0, 0, 10], [20, 0, 7], [40, 0, 8]]";
  std::vector<std::string> across = pulled("[0, -9.81, 0]");
  EXPECT_TRUE(warnings_of(cable, across).empty());  // of a straight line nobody knows
  across.insert(across.end(), {straight, sagging});
  expect_one(cable, across, {"gravity", "across the upright plane", "[0, 0, -9.81]"});
  // A model that is drawn lying, or whose y points up.
  EXPECT_TRUE(warnings_of(bent, {}).empty());
  EXPECT_TRUE(warnings_of(bent, pulled("[0, -9.81, 0]")).empty());
}

TEST(Sizes, OfADensityInOtherUnitsAreToldWithWhatWasMeant) {
  expect_one(cable, {"5200", "7.85"}, {"material.density", "7850"});
}

TEST(Sizes, OfManyBeamsAreToldOnce) {
  const std::string second = R"({ "name": "other", "axis": { "polyline": [[0, 1, 10], [40, 1, 8]] },
    "section": { "radius": "6 mm" }, "material": { "density": 7.85, "youngs_modulus": "60 GPa" } }, )";
  expect_one(cable,
             {"5200", "7.85", "\"beams\": [", "\"beams\": [" + second, "\"supports\": [",
              "\"supports\": [{ \"beam\": \"other\", \"at\": \"start\", \"type\": \"clamped\" }, "},
             {"beams[0].material.density", "7850", "the same of 1 other: beams[1]"});
}

TEST(Sizes, OfAStepLongerThanTheMotionAreTold) {
  const std::string text = cable.substr(0, cable.rfind("\"analysis\""));
  const CaseFileReport read =
      read_case_text(text + R"("analysis": { "end_time": 0.2, "step": 1 } })", "case.json");
  ASSERT_TRUE(read.value);
  ASSERT_EQ(read.diagnostics.size(), 1u);
  EXPECT_EQ(read.diagnostics[0].where, "case.json: analysis.step");
  EXPECT_NE(read.diagnostics[0].message.find("0.2 s"), std::string::npos) << read.diagnostics[0].message;
}

TEST(Sizes, OfASectionThickerThanItsBendAreToldWithWhatWasMeant) {
  expect_one(bent,
             {"[1, 0, 0]", "[0.1, 0, 0]", "[0, 1, 0]", "[0, -0.1, 0]", "0.05, \"bore\": 0.02",
              "0.09, \"bore\": 0.05"},
             {"0.18 m thick", "radius of 0.1 m", "0.045 m"});
}

TEST(Sizes, OfAForceThatStretchesTheBeamToTwiceItsLengthAreTold) {
  expect_one(cable, {"-800", "-1e9"}, {"loads[0].force", "1e+09 N"});
  expect_one(cable, {"\"at\": { \"fraction\": 0.5 }, \"force\"", "\"force_per_length\"", "-800", "-1e8"},
             {"loads[0].force_per_length"});
}

// 219.1 x 6.3 mm, bent to 305 mm: k = 1.65/h is 9.72.
TEST(PipeBends, OfThinWallsAreToldWithFlexibilityAndStressFactor) {
  const std::string thin = "0.10955, \"bore\": 0.10325", bend = "[0.305, 0, 0]";
  expect_one(bent, {"0.05, \"bore\": 0.02", thin, "[1, 0, 0]", bend, "[0, 1, 0]", "[0, 0.305, 0]"},
             {"beams[0].section", "9.7", "2.9", "\"bends\": \"flexible\""});
  EXPECT_TRUE(warnings_of(bent, {"0.05, \"bore\": 0.02", thin + ", \"bends\": \"flexible\"", "[1, 0, 0]",
                                 bend, "[0, 1, 0]", "[0, 0.305, 0]"})
                  .empty());
}

}  // namespace
}  // namespace nurbeam::of_sizes
