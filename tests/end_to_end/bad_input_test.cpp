#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

using test::CaseRun;
using test::TemporaryDirectory;

constexpr int exit_done = 0, bad_input = 2, not_converged = 3;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The falling beam, coarser and shorter, with overrides.
CaseRun run_beam(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {"beams[0].elements.count=8", "analysis.end_time=0.1", "analysis.step=1e-3"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return test::run_file(test::sample("falling_beam/falling_beam.json"), all);
}

std::string axis_file(const std::filesystem::path& file, const std::string& curve = "1") {
  return "beams[0].axis={\"file\":\"" + file.string() + "\",\"curve\":" + curve + "}";
}

void expect_refused(const CaseRun& run, const std::vector<std::string>& parts) {
  EXPECT_EQ(run.code, bad_input) << run.messages;
  EXPECT_TRUE(run.says("error: ")) << run.messages;
  for (const std::string& part : parts) EXPECT_TRUE(run.says(part)) << part << " is not in: " << run.messages;
  EXPECT_TRUE(run.files.empty());
}

void expect_done(const CaseRun& run) {
  EXPECT_EQ(run.code, exit_done) << run.messages;
  EXPECT_FALSE(run.left_half_files());
  ASSERT_FALSE(run.rows.empty());
  for (const char* column : {"energy.total [J]", "end.x [m]", "end.y [m]"})
    EXPECT_TRUE(std::isfinite(run.last(column))) << column;
}

void expect_stopped(const CaseRun& run, const std::vector<std::string>& parts) {
  EXPECT_EQ(run.code, not_converged) << run.messages;
  for (const std::string& part : parts) EXPECT_TRUE(run.says(part)) << part << " is not in: " << run.messages;
  EXPECT_FALSE(run.left_half_files());
  EXPECT_NE(std::find(run.files.begin(), run.files.end(), "run.json"), run.files.end());
}

// ---- Files ----

TEST(BadInput, AMissingCaseFile) {
  expect_refused(test::run_file("absent.json"), {"absent.json: cannot be read"});
}

// The case, a table and a drawing under names that results have.
TEST(BadInput, ResultsDoNotTakeThePlaceOfInputs) {
  const TemporaryDirectory directory;
  const std::string text = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.01 },
                "material": "steel", "elements": { "count": 2 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
    "loads": [{ "beam": "b", "at": "end", "force": [0, 0, -1], "time": { "file": "histories.csv" } }],
    "analysis": { "end_time": 0.01, "step": 0.001 } })";
  const auto refused = [&](const std::string& case_name, const std::string& input) {
    std::ostringstream out, err;
    const test::CapturedErrors errors;
    const auto file = directory.write(case_name, text);
    EXPECT_EQ(
        run_command_line({"run", file.string(), "--quiet", "--out", directory.path().string()}, out, err), 2);
    EXPECT_NE(errors.text().find(input + ": is an input of this run"), std::string::npos) << errors.text();
    std::ifstream left(file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(left), {}), text);
  };
  directory.write("histories.csv", "0, 0\n0.01, 1\n");
  refused("case.json", "histories.csv");
  refused("run.json", "run.json");
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "results.nc"));
}

TEST(BadInput, AnEmptyCaseFile) {
  const TemporaryDirectory directory;
  expect_refused(test::run_file(directory.write("empty.json", "")), {"is empty"});
}

TEST(BadInput, NotANumberInTheCaseFile) {
  const TemporaryDirectory directory;
  std::string text = text_of(test::sample("falling_beam/falling_beam.json"));
  const std::string mass = "\"mass\": 0.8";
  text.replace(text.find(mass), mass.size(), "\"mass\": NaN");
  expect_refused(test::run_file(directory.write("nan.json", text)), {"line ", "NaN is not a number"});
}

TEST(BadInput, AMissingCadFile) {
  expect_refused(run_beam({axis_file("absent.step")}), {"beams[0].axis.file", "there is no file"});
}

TEST(BadInput, AnEmptyCadFile) {
  const TemporaryDirectory directory;
  for (const char* name : {"empty.step", "empty.igs"})
    expect_refused(run_beam({axis_file(directory.write(name, ""))}), {name, "the file is empty"});
}

TEST(BadInput, ATruncatedCadFile) {
  const TemporaryDirectory directory;
  const std::filesystem::path corpus = test::source_directory() / "tests/corpus";
  const std::string iges = text_of(corpus / "iges-126-bsplines.igs");
  expect_refused(run_beam({axis_file(directory.write("cut.igs", iges.substr(0, iges.size() / 2)))}),
                 {"cut.igs", "truncated"});
  const std::string step = text_of(test::sample("zipline/cable.step"));
  expect_refused(run_beam({axis_file(directory.write("cut.step", step.substr(0, step.size() / 2)))}),
                 {"cut.step"});
}

TEST(BadInput, ACurveThatDoesNotExist) {
  const std::filesystem::path file = test::sample("zipline/cable.step");
  expect_refused(run_beam({axis_file(file, "\"Zap\"")}),
                 {"beams[0].axis.curve", "no curve is named \"Zap\"", "1 \"Zip cable\""});
  expect_refused(run_beam({axis_file(file, "7")}), {"beams[0].axis.curve", "index 7 is out of range"});
}

// ---- Values ----

TEST(BadInput, ANegativeRadius) {
  expect_refused(run_beam({"beams[0].section.radius=-1"}),
                 {"beams[0].section.radius: is -1 m; must be between 1e-09 and 10000"});
}

TEST(BadInput, ABodyWithoutMass) {
  expect_refused(run_beam({"bodies[0].mass=0"}), {"bodies[0].mass: is 0 kg; must be between 1e-09"});
}

TEST(BadInput, FewerElementsThanSegments) {
  expect_refused(run_beam({"beams[0].axis.polyline=[[0,0,0],[1,0,0],[2,0,0]]", "beams[0].elements.count=1"}),
                 {"beams[0].elements.count", "the smallest count is 2"});
}

TEST(BadInput, ACornerInTheAxis) {
  expect_refused(run_beam({"beams[0].axis.polyline=[[0,0,0],[1,0,0],[1,1,0]]"}),
                 {"beams[0].axis", "corner of 90 degrees at (1, 0, 0) m", "\"rigid\"", "\"hinge\""});
}

TEST(BadInput, APlaceTooFarFromTheBeam) {
  expect_refused(run_beam({"sliding_joints[0].at={\"near\":[0.5,0.3,0]}"}),
                 {"sliding_joints[0].at.near", "0.3 m from beam \"beam\"", "closest point"});
  expect_refused(run_beam({"sliding_joints[0].at={\"length\":1.3}"}), {"sliding_joints[0].at", "1 m long"});
  expect_refused(
      run_beam(
          {R"(output.probes=[{"name":"a","beam":"beam","at":"end"},{"name":"b","beam":"beam","at":{"length":3}}])"}),
      {"output.probes[1].at: 3 m is not on beam \"beam\""});
}

TEST(BadInput, MoreElementsThanABeamCanHave) {
  expect_refused(run_beam({R"(beams[0].elements={"max_length":1e-12})"}),
                 {"beams[0].elements.max_length: is 1e-12 m: 1e+12 elements", "limit for one beam is 100000",
                  "give at least 1.00001"});
  const std::string two = R"(beams[0].axis={"polyline":[[0,0,0],[0.5,0,0],[1,0,0]]})";
  expect_refused(run_beam({two, R"(beams[0].elements={"per_segment":60000})"}),
                 {"beams[0].elements.per_segment: is 60000: 120000 elements", "give at most 50000"});
}

TEST(BadInput, TwoSupportsAtOnePlace) {
  const std::string held = R"({"beam":"beam","at":"start","type":"clamped"},)";
  expect_refused(
      run_beam({"supports=[" + held + R"({"beam":"beam","at":{"length":1e-10},"type":"pinned"}])"}),
      {"supports[1]: holds beam \"beam\" at s = 0 m, where supports[0] already holds it"});
  expect_refused(run_beam({"supports=[" + held + R"({"beam":"beam","at":{"length":1e-8},"type":"pinned"}])"}),
                 {"supports: a support of beam \"beam\"", "1e-08 m apart", "at least 1e-06 m"});
}

TEST(BadInput, APrescribedMotionThatDoesNotFitTheBeam) {
  const auto joint = [](const std::string& table, const std::string& more = "") {
    return R"(sliding_joints=[{"body":"mass","beam":"beam","at":{"length":0.1},"motion":{"table":)" + table +
           more + "}}]";
  };
  expect_refused(run_beam({joint("[[0,0.2],[1,0.3]]")}),
                 {"sliding_joints[0].motion.table: is at s = 0.2 m at time 0", "\"at\" is s = 0.1 m"});
  expect_refused(run_beam({joint("[[-1,0],[1,0.3]]")}), {"s = 0.15 m at time 0"});
  expect_refused(run_beam({joint("[[0,0.1],[1,0.3],[2,1.5]]")}),
                 {"sliding_joints[0].motion.table[2]: 1.5 m is not on beam \"beam\", which is 1 m long"});
  expect_done(run_beam({joint("[[-1,0],[1,0.2],[2,1]]", R"(,"interpolation":"linear")")}));
  // The spline through these rows does not go straight from the first to the second.
  expect_refused(run_beam({joint("[[-1,0],[1,0.2],[2,1]]")}), {"s = 0.025 m at time 0"});
  expect_done(run_beam({joint("[[-1,0],[0,0.1],[1,0.2],[2,1]]")}));
}

std::string nurbs_axis(const std::string& points, const std::string& weights = "[1,1,1,1]") {
  return R"(beams[0].axis={"nurbs":{"degree":3,"knots":[0,0,0,0,1,1,1,1],"control_points":)" + points +
         R"(,"weights":)" + weights + "}}";
}

TEST(BadInput, ACurveThatNoBeamCanFollowIsNamed) {
  const std::string axis = "falling_beam.json: beams[0].axis", where = axis + ": ";
  const std::string line = "[[0,0,0],[0.3,0,0],[0.6,0,0],[1,0,0]]";
  expect_refused(run_beam({nurbs_axis("[[0,0,0],[1,1,0],[0,1,0],[1,0,0]]")}), {where});  // a cusp
  expect_refused(run_beam({nurbs_axis("[[0,0,0],[0,0,0],[0,0,0],[0,0,0]]")}), {where});
  expect_refused(run_beam({nurbs_axis(line, "[1,1e-300,1,1]")}), {axis + ".nurbs.weights: "});
}

TEST(BadInput, LengthsThatNoBeamHas) {
  const auto line = [](const std::string& points) { return R"(beams[0].axis={"polyline":)" + points + "}"; };
  const std::string where = "beams[0].axis: ";
  expect_refused(run_beam({line("[[0,0,0],[2e8,0,0]]")}), {where + "has a coordinate of 200000000 m"});
  expect_refused(run_beam({line("[[0,0,0],[1e200,0,0]]")}), {"beams[0].axis.polyline[1][0]: is 1e+200 m"});
  expect_refused(run_beam({line("[[0,0,0],[1e-9,0,0]]")}), {where + "has an extent of 1e-09 m"});
  expect_refused(run_beam({line("[[0,0,0],[5e-7,0,0],[1,0,0]]")}),
                 {where + "segment 1 of 2, at s = 0 m, is 5e-07 m long", "1e-06 m", "merge it"});
}

// A body on a beam that is held at both ends stops or turns round there, which is nothing to warn of.
TEST(Warnings, AHeldEndIsNotMentioned) {
  const std::string supports =
      R"(supports=[{"beam":"beam","at":"start","type":"clamped"},{"beam":"beam","at":"end","type":"pinned"}])";
  const CaseRun run = run_beam({supports, "beams[0].material.youngs_modulus=2e10"});
  expect_done(run);
  EXPECT_EQ(run.messages.find("warning: "), std::string::npos) << run.messages;
  EXPECT_FALSE(run.says("supported")) << run.messages;
}

TEST(Warnings, AMovingLoadThatLeavesAtOnceIsMentioned) {
  const auto load = [](const std::string& at, const std::string& speed) {
    return R"(loads=[{"beam":"beam","at":")" + at + R"(","force":[0,-1,0],"moves":{"speed":)" + speed + "}}]";
  };
  for (const auto& [at, outward, inward] : {std::tuple{"start", "-1", "1"}, {"end", "1", "-1"}}) {
    const CaseRun run = run_beam({load(at, outward)});
    EXPECT_EQ(run.code, exit_done);
    EXPECT_TRUE(run.says("loads[0].moves.speed: ") && run.says("leaves the beam at once")) << run.messages;
    EXPECT_FALSE(run_beam({load(at, inward)}).says("leaves the beam at once"));
  }
}

// ---- Runs at the border of what can be run ----

TEST(HardInput, OneElementPerSide) {
  for (const char* at : {"0.1", "0.5", "0.9"}) {
    const CaseRun run = run_beam(
        {"beams[0].elements.count=1", std::string("sliding_joints[0].at={\"fraction\":") + at + "}"});
    expect_done(run);
    EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3);
  }
}

TEST(HardInput, ABodyAtTheFreeEndLeavesAtOnceAndFalls) {
  const CaseRun run = run_beam({"sliding_joints[0].at=\"end\""});
  expect_done(run);
  EXPECT_NEAR(run.last("mass.x [m]"), 1, 1e-6);
  EXPECT_NEAR(run.last("mass.y [m]"), -9.81 * 0.1 * 0.1 / 2, 1e-5);
  EXPECT_TRUE(std::isnan(run.last("mass.s [m]")));
}

TEST(HardInput, ABodyAtTheHeldStartStaysThere) {
  const CaseRun run = run_beam({"sliding_joints[0].at=\"start\""});
  expect_done(run);
  EXPECT_NEAR(run.last("mass.s [m]"), 0, 1e-9);
  EXPECT_NEAR(run.last("mass.y [m]"), 0, 1e-9);
}

TEST(HardInput, ABodyAtTheVeryStartSlidesIn) {
  const CaseRun run = run_beam({"sliding_joints[0].at=\"start\"", "sliding_joints[0].speed=1"});
  expect_done(run);
  EXPECT_NEAR(run.last("mass.s [m]"), 0.1, 0.01);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3);
}

TEST(HardInput, ABodyLeavesTheFreeEndAndFliesOn) {
  const CaseRun run = run_beam({"sliding_joints[0].at={\"fraction\":0.9}", "sliding_joints[0].speed=3"});
  expect_done(run);
  EXPECT_TRUE(std::isnan(run.last("mass.s [m]")));
  EXPECT_GT(run.last("mass.x [m]"), 1.1);
}

TEST(HardInput, TwoBodiesThatMeetEndTheRun) {
  const std::string bodies = R"(bodies=[{"name":"a","mass":1},{"name":"b","mass":1}])";
  const CaseRun met = run_beam(
      {bodies,
       R"(sliding_joints=[{"body":"a","beam":"beam","at":{"length":0.2},"speed":5},{"body":"b","beam":"beam","at":{"length":0.6}}])"});
  expect_stopped(met, {"sliding bodies \"a\" and \"b\" are 0.0", " m apart on beam \"beam\" at t = ",
                       "nearer than 0.00625 m, a twentieth of an element, their motion is not followed",
                       "\"a\" is at s = ", "give a stop between them with a \"gap\" of at least 0.0125 m"});
  EXPECT_GT(met.last("a.s [m]"), 0.5);
  const CaseRun same_place = run_beam(
      {bodies,
       R"(sliding_joints=[{"body":"a","beam":"beam","at":{"length":0.5}},{"body":"b","beam":"beam","at":{"length":0.5}}])"});
  expect_refused(same_place, {"sliding_joints[1].at: puts body \"b\" 0 m from body \"a\"",
                              "bodies must be more than 0.00625 m apart"});
}

TEST(HardInput, TwoBodiesThatSlideToTheSameRestingPlaceMeet) {
  const CaseRun run = test::run_file(
      test::sample("statics/bead_level.json"),
      {R"(bodies=[{"name":"a","mass":40},{"name":"b","mass":40}])",
       R"(sliding_joints=[{"body":"a","beam":"cable","at":{"length":20},"slope":"discontinuous","at_beam_end":"stop"},{"body":"b","beam":"cable","at":{"length":90},"slope":"discontinuous","at_beam_end":"stop"}])"});
  expect_stopped(run, {"sliding bodies \"a\" and \"b\" are ", "give a stop between them"});
}

TEST(HardInput, ABodyThatComesToAnEyeletIsToldThatNothingPassesIt) {
  const CaseRun run = test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [4, 0, 0]] }, "section": { "radius": 0.01 },
      "material": "steel", "elements": { "count": 8 } }],
    "bodies": [{ "name": "bead", "mass": 1 }],
    "supports": [{ "beam": "wire", "at": "start", "type": "pinned" },
                 { "beam": "wire", "at": "end", "type": "guided", "direction": [1, 0, 0], "force": 1000 }],
    "sliding_joints": [{ "body": "bead", "beam": "wire", "at": { "length": 0.6 }, "speed": 5 }],
    "eyelets": [{ "name": "ring", "beam": "wire", "at": { "length": 2.3 } }],
    "analysis": { "end_time": 1, "step": 0.002 }, "output": { "report": false } })");
  expect_stopped(run, {"sliding body \"bead\" and eyelet \"ring\" are 0.0", "nothing passes an eyelet"});
}

TEST(HardInput, AStepAThousandTimesTooLargeSaysSo) {
  const std::vector<std::string> coarse = {"analysis.step=1", "output.every=1", "analysis.end_time=1",
                                           "beams[0].elements.count=16"};
  const CaseRun run = run_beam(coarse);
  if (run.code == exit_done)
    expect_done(run);
  else
    expect_stopped(run, {"a shorter \"step\""});
  EXPECT_TRUE(run.code == exit_done || run.says("the step from t = ") || run.says(" has come from nowhere"));
  EXPECT_TRUE(run.says("the total energy, less the work of loads and motions, changed by ")) << run.messages;
  EXPECT_FALSE(run_beam({}).says("the total energy"));
}

}  // namespace
}  // namespace nurbeam
