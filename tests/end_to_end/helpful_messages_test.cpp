#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::of_helpful_messages {
namespace {

const std::string cable = R"({ "nurbeam": 1,
  "beams": [{ "name": "cable", "axis": { "polyline": [[0, 0, 10], [40, 0, 8]] }, "section": { "radius": "6 mm" },
    "material": { "density": 5200, "youngs_modulus": "60 GPa" }, "elements": { "count": 4 } }],
  "supports": [{ "beam": "cable", "at": "start", "type": "pinned" },
               { "beam": "cable", "at": "end", "type": "pinned" }],
  "loads": [{ "beam": "cable", "at": "end", "force": [0, 0, -100] }],
  "analysis": { "type": "static" }, "output": { "report": false } })";

struct Told {
  int code;
  std::string text;
};
Told told(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  const test::CapturedErrors errors;
  const int code = run_command_line(words, out, err);
  return {code, err.str() + errors.text()};
}

void expect_told(const std::string& change, const std::vector<std::string>& parts) {
  const test::TemporaryDirectory directory;
  const Told found = told({"check", directory.write("case.json", cable).string(), "--set", change});
  EXPECT_EQ(found.code, 2) << change;
  for (const std::string& part : parts)
    EXPECT_NE(found.text.find(part), std::string::npos) << found.text << "\n has no: " << part;
}

void expect_text_told(const std::string& from, const std::string& to, const std::string& part) {
  const test::TemporaryDirectory directory;
  std::string text = cable;
  text.replace(text.find(from), from.size(), to);
  const Told found = told({"check", directory.write("case.json", text).string()});
  EXPECT_EQ(found.code, 2) << to;
  EXPECT_NE(found.text.find(part), std::string::npos) << found.text << "\n has no: " << part;
}

TEST(Messages, KnowTheWordsOfOtherPrograms) {
  expect_told("supports[0].type=fixed", {"supports[0].type", "did you mean \"clamped\"?"});
  expect_told("supports[0].type=hinge", {"did you mean \"pinned\"?"});
  expect_told("supports[0].type=roller", {"did you mean \"guided\"?"});
  expect_told("supports[0].at=middle", {"supports[0].at", "did you mean { \"fraction\": 0.5 }?"});
  expect_told("loads[0].at=0.5", {"did you mean { \"fraction\": 0.5 } or { \"length\": 0.5 }?"});
  expect_told("loads[0].at=12", {"did you mean { \"length\": 12 }?"});
}

TEST(Messages, SayWhatAListIsToHold) {
  expect_told(R"(beams[0].section={"rectangle": {"width": 0.1, "height": 0.2}})",
              {"beams[0].section.rectangle: is an object; expected [width, height], each a number in m"});
}

// Without knots a curve is clamped and has equal spans.
TEST(Messages, KnotsThatAreLeftOutAreTheUsualOnes) {
  const auto length_of = [](const std::string& nurbs) {
    const test::TemporaryDirectory directory;
    std::string text = cable;
    const std::string line = R"("polyline": [[0, 0, 10], [40, 0, 8]])";
    text.replace(text.find(line), line.size(), R"("nurbs": {)" + nurbs + "}");
    const test::CaseRun run = test::run_file(directory.write("case.json", text));
    EXPECT_EQ(run.code, 0) << run.messages;
    return run.last("cable.length [m]");
  };
  const std::string points =
      R"("degree": 2, "control_points": [[0, 0, 10], [9, 0, 10], [20, 0, 6], [31, 0, 6], [40, 0, 8]])";
  EXPECT_EQ(length_of(points), length_of(points + R"(, "knots": [0, 0, 0, 1, 2, 3, 3, 3])"));
  expect_text_told(R"("polyline": [[0, 0, 10], [40, 0, 8]])",
                   R"("nurbs": {"degree": 3, "control_points": [[0, 0, 10], [40, 0, 8]]})",
                   "has 2 control points; a curve of degree 3 has at least 4");
}

TEST(Messages, OfCurvesInJsonGiveTheKnotsThatAreMissing) {
  const test::TemporaryDirectory directory;
  const Told found = told({"inspect", directory
                                          .write("curves.json", R"({"unit": "m", "curves": [{"degree": 2,
      "control_points": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0]]}]})")
                                          .string()});
  EXPECT_EQ(found.code, 2);
  EXPECT_NE(found.text.find("those of a clamped curve with equal spans are [0, 0, 0, 0.5, 1, 1, 1]"),
            std::string::npos)
      << found.text;
}

TEST(Messages, KnowACaseThatIsToBeInspected) {
  const test::TemporaryDirectory directory;
  for (const std::string& comment : {std::string(), std::string("\n// a cable\n")}) {
    const Told found =
        told({"inspect", directory.write("case.json", "{" + comment + cable.substr(1)).string()});
    EXPECT_EQ(found.code, 2);
    EXPECT_NE(found.text.find("it is a case file, not JSON of curves; \"nurbeam check\" takes it"),
              std::string::npos)
        << found.text;
  }
}

TEST(Messages, NameCommasThatJsonDoesNotHave) {
  expect_told("bodies=[{\"name\": \"m\", \"mass\": \"80,5 kg\"}]", {"decimal comma", "\"80.5 kg\""});
  expect_text_told("\"radius\": \"6 mm\" }", "\"radius\": \"6 mm\", }", "remove the comma");
  expect_text_told("[40, 0, 8]]", "[40, 0, 8],]", "remove the comma");
  expect_text_told("\"density\": 5200,", "\"density\": 5200,5,", "did you mean 5200.5?");
}

TEST(Messages, SayWhatIsThereWhereAFileIsNot) {
  const test::TemporaryDirectory directory;
  directory.write("zipline.json", cable);
  const Told missing = told({"run", (directory.path() / "ziplin.json").string()});
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.text.find("did you mean \"zipline.json\"?"), std::string::npos) << missing.text;
  const Told cad = told({"run", directory.write("cable.step", "ISO-10303-21;").string()});
  EXPECT_EQ(cad.code, 2);
  EXPECT_NE(cad.text.find("\"axis\": { \"file\": \"cable.step\" }"), std::string::npos) << cad.text;
  const Told nothing = told({"run"});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_NE(nothing.text.find("no CASE.json is given"), std::string::npos) << nothing.text;
}

TEST(Messages, OfAModelThatIsNotHeldSayWhatItTurnsAbout) {
  const test::TemporaryDirectory directory;
  const auto file = directory.write("case.json", cable);
  const test::CaseRun free = test::run_file(file, {"supports=[]"});
  EXPECT_EQ(free.code, 3);
  EXPECT_TRUE(free.says("beam \"cable\"") && free.says("no support")) << free.messages;
  const test::CaseRun pinned = test::run_file(file, {"supports[1]=null", "loads=null", "gravity=[0,0,0]"});
  EXPECT_TRUE(pinned.says("turning about its only support, at s = 0 m of beam \"cable\"")) << pinned.messages;
}

// The support that there is holds another beam.
TEST(Messages, OfABeamThatNothingHoldsNameNoSupportOfAnother) {
  const test::TemporaryDirectory directory;
  const test::CaseRun run = test::run_file(directory.write("case.json", R"({ "nurbeam": 1,
    "beams": [{ "name": "held", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.01 }, "material": "steel" },
      { "name": "loose", "axis": { "polyline": [[0, 1, 0], [1, 1, 0]] }, "section": { "radius": 0.01 }, "material": "steel" }],
    "supports": [{ "beam": "held", "at": "start", "type": "clamped" }],
    "analysis": { "type": "static" }, "output": { "report": false } })"));
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(run.says("nothing holds beam \"loose\"")) << run.messages;
  EXPECT_FALSE(run.says("turning about")) << run.messages;
}

TEST(Messages, OfManyCornersAreOneWithTheCurveThatWasMeant) {
  const test::TemporaryDirectory directory;
  std::string points;
  for (int i = 0; i < 81; ++i)
    points += (i ? ",[" : "[") + std::to_string(std::cos(0.1 * i)) + "," + std::to_string(std::sin(0.1 * i)) +
              "," + std::to_string(0.01 * i) + "]";
  std::string text = cable;
  const std::string axis = "\"polyline\": [[0, 0, 10], [40, 0, 8]]";
  text.replace(text.find(axis), axis.size(), "\"polyline\": [" + points + "]");
  const Told cornered = told({"check", directory.write("corners.json", text).string()});
  EXPECT_EQ(cornered.code, 2);
  EXPECT_NE(cornered.text.find("has 79 corners"), std::string::npos) << cornered.text;
  EXPECT_NE(cornered.text.find("\"through\""), std::string::npos) << cornered.text;
  EXPECT_EQ(cornered.text.find("error: "), cornered.text.rfind("error: "));
  text.replace(text.find("polyline"), 8, "through");
  text.replace(text.find("\"count\": 4"), 10, "\"count\": 100");
  EXPECT_EQ(told({"check", directory.write("through.json", text).string()}).code, 0);
}

TEST(Messages, ThatRangInEveryRunAreGone) {
  const test::TemporaryDirectory directory;
  const auto file = directory.write("case.json", cable);
  const test::CaseRun statics = test::run_file(file, {"output.every=0.1"});
  EXPECT_EQ(statics.code, 0) << statics.messages;
  EXPECT_FALSE(statics.says("output.every")) << statics.messages;
}

// A free shaft ten times as long as thick: its first mode is 2.7 % too high, the fifth 29 %.
TEST(Modes, OfAThickShaftAreToldToLackShear) {
  const test::TemporaryDirectory directory;
  const std::string shaft = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "s", "axis": { "polyline": [[0, 0, 0], [0.3, 0, 0]] }, "section": { "radius": 0.015 },
      "material": { "density": 7810, "youngs_modulus": 2.1e11 }, "elements": { "count": 12 } }],
    "analysis": { "type": "modes", "modes": { "count": 10 } }, "output": { "report": false } })";
  const auto file = directory.write("shaft.json", shaft);
  const test::CaseRun thick = test::run_file(file);
  EXPECT_EQ(thick.code, 0) << thick.messages;
  EXPECT_TRUE(thick.says("half waves of 6.6 diameters") && thick.says("2.7 % too high")) << thick.messages;
  const test::CaseRun slender =
      test::run_file(file, {"beams[0].section.radius=0.001", "analysis.modes.count=7"});
  EXPECT_FALSE(slender.says("half waves")) << slender.messages;
}

// One element has 110.7 % of the first frequency of a bar on two supports, two have 100.4 %.
TEST(Modes, OfTooFewElementsAreTold) {
  const test::TemporaryDirectory directory;
  const std::string bar = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.005 },
      "material": "steel", "elements": { "count": 1 } }],
    "supports": [{ "beam": "bar", "at": "start", "type": "pinned" }, { "beam": "bar", "at": "end", "type": "pinned" }],
    "analysis": { "type": "modes", "modes": { "count": 1 } }, "output": { "report": false } })";
  const auto file = directory.write("bar.json", bar);
  const test::CaseRun one = test::run_file(file);
  EXPECT_EQ(one.code, 0) << one.messages;
  EXPECT_TRUE(one.says("mode 1 moves beam \"bar\" in half waves of 0.91 elements")) << one.messages;
  EXPECT_TRUE(one.says("give beam \"bar\" 3 elements or more")) << one.messages;
  for (const char* type : {"modes", "buckling"}) {
    const std::string analysis = std::string("analysis.type=") + type;
    const std::vector<std::string> thrust = {
        analysis, R"(supports[1]={"beam": "bar", "at": "end", "type": "guided", "direction": [1, 0, 0]})",
        R"(loads=[{"beam": "bar", "at": "end", "force": [-1, 0, 0]}])"};
    for (const char* count : {"1", "2", "3"}) {
      std::vector<std::string> overrides = thrust;
      overrides.push_back(std::string("beams[0].elements.count=") + count);
      const test::CaseRun run = test::run_file(file, overrides);
      EXPECT_EQ(run.code, 0) << run.messages;
      EXPECT_EQ(run.says("half waves of"), count == std::string("1")) << type << count << run.messages;
    }
  }
}

}  // namespace
}  // namespace nurbeam::of_helpful_messages
