// Long because its tests share what they build.
#include "pipelines/case/case_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "pipelines/case/case_schema.h"
#include "pipelines/diagnostics/closest_name.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

using test::full_case;
using test::smallest_case;

class CaseFileTest : public ::testing::Test {
 protected:
  CaseFileReport read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    directory_.write("zipline.step", "");
    return read_case_file(directory_.write("case.json", text), overrides);
  }
  CaseFile read_valid(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const CaseFileReport report = read(text, overrides);
    EXPECT_TRUE(report.value) << messages(report);
    return report.value.value();
  }
  static std::string messages(const CaseFileReport& report) {
    std::string all;
    for (const Diagnostic& d : report.diagnostics) all += d.where + " | " + d.message + "\n";
    return all;
  }
  std::string file() const { return (directory_.path() / "case.json").string(); }

  /// The smallest case with overrides has exactly one error: at `where` (a JSON path), holding each of
  /// `parts`.
  void expect_error(const std::vector<std::string>& overrides, const std::string& where,
                    const std::vector<std::string>& parts, const std::string& base = smallest_case) {
    check_error(read(base, overrides), file() + (where.empty() ? "" : ": " + where), parts);
  }
  void expect_text_error(const std::string& text, const std::string& where,
                         const std::vector<std::string>& parts) {
    check_error(read(text), file() + (where.empty() ? "" : ": " + where), parts);
  }
  static void check_error(const CaseFileReport& report, const std::string& where,
                          const std::vector<std::string>& parts) {
    EXPECT_FALSE(report.value);
    std::vector<Diagnostic> errors;
    for (const Diagnostic& d : report.diagnostics)
      if (d.severity == Severity::error) errors.push_back(d);
    ASSERT_EQ(errors.size(), 1u) << messages(report);
    EXPECT_EQ(errors[0].where, where);
    for (const std::string& part : parts)
      EXPECT_NE(errors[0].message.find(part), std::string::npos) << part << " not in: " << errors[0].message;
  }

  test::TemporaryDirectory directory_;
};

TEST_F(CaseFileTest, TheSmallestCaseHasSensibleDefaults) {
  const CaseFile c = read_valid(smallest_case);
  EXPECT_EQ(c.name, "case");
  EXPECT_EQ(c.gravity, Eigen::Vector3d(0, 0, -9.81));
  ASSERT_EQ(c.beams.size(), 1u);
  EXPECT_EQ(c.beams[0].path, "beams[0]");
  EXPECT_DOUBLE_EQ(c.beams[0].section.area, std::numbers::pi * 1e-4);
  EXPECT_DOUBLE_EQ(c.beams[0].section.second_moment, std::numbers::pi * 1e-8 / 4);
  EXPECT_FALSE(c.beams[0].elements.count || c.beams[0].elements.max_length ||
               c.beams[0].elements.per_segment);
  EXPECT_EQ(c.beams[0].elements.grading, 0);
  EXPECT_EQ(c.beams[0].stress_free, StressFree::automatic);
  EXPECT_EQ(c.beams[0].material.damping, 0);
  EXPECT_FALSE(c.analysis.step);
  EXPECT_EQ(std::get<GeneralizedAlpha>(c.analysis.integrator).tolerance, 1e-4);
  EXPECT_DOUBLE_EQ(c.output.every.value(), 0.005);
  EXPECT_EQ(read_valid(smallest_case, {"analysis.step=0.1"}).output.every, 0.1);  // no frames between steps
  EXPECT_TRUE(c.output.cad_formats.empty());
}

TEST_F(CaseFileTest, EveryKeyReachesItsField) {
  const CaseFile c = read_valid(full_case);
  EXPECT_EQ(c.name, "zip line");
  EXPECT_EQ(c.gravity, Eigen::Vector3d(0, 0, -9.81));
  const CaseBeam& cable = c.beams.at(0);
  const auto& axis = std::get<CaseAxis::File>(cable.axis.source);
  EXPECT_EQ(axis.path, directory_.path() / "zipline.step");
  EXPECT_EQ(axis.curve_name, "Spline1");
  EXPECT_FALSE(axis.curve_index);
  EXPECT_TRUE(axis.chain);
  EXPECT_EQ(axis.part, "bridge");
  EXPECT_EQ(axis.layer, "cables");
  EXPECT_EQ(axis.colour, "#FF8000");
  EXPECT_DOUBLE_EQ(axis.gap.value(), 1e-4);
  EXPECT_DOUBLE_EQ(cable.section.area, 3e-4);
  EXPECT_DOUBLE_EQ(cable.section.second_moment, 7e-10);
  EXPECT_DOUBLE_EQ(cable.material.density, 7200);
  EXPECT_DOUBLE_EQ(cable.material.youngs_modulus, 20e6);
  EXPECT_DOUBLE_EQ(cable.material.damping, 1e-3);
  EXPECT_EQ(cable.elements.per_segment, 2);
  EXPECT_DOUBLE_EQ(cable.elements.grading, -0.02);
  EXPECT_EQ(cable.element, ElementKind::ale_ancf);
  EXPECT_EQ(cable.weights, WeightRule::constant);
  EXPECT_EQ(cable.merge, MergeRule::paper);
  EXPECT_EQ(cable.stress_free, StressFree::straight);
  EXPECT_EQ(cable.curvature, CurvatureMeasure::spatial);
  EXPECT_EQ(cable.corners, Corners::hinge);
  EXPECT_DOUBLE_EQ(cable.smooth_angle, 3 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(cable.approximation_tolerance.value(), 1e-6);
  const auto& arc = std::get<CaseAxis::Arc>(c.beams.at(1).axis.source);
  EXPECT_EQ(arc.end, Eigen::Vector3d::UnitY());
  EXPECT_EQ(arc.normal, Eigen::Vector3d::UnitZ());
  EXPECT_DOUBLE_EQ(c.beams[1].elements.max_length.value(), 0.05);
  const auto& nurbs = std::get<NurbsCurve>(c.beams.at(2).axis.source);
  EXPECT_EQ(nurbs.degree(), 2);
  EXPECT_EQ(nurbs.control_points().col(1), Eigen::Vector4d(0.25, 0, 0, 0.5));
  EXPECT_EQ(c.beams[2].elements.count, 12);

  ASSERT_EQ(c.joints.size(), 1u);
  EXPECT_EQ(c.joints[0].beams, (std::vector<std::string>{"arch", "curve"}));
  EXPECT_TRUE(c.joints[0].rigid);
  EXPECT_EQ(c.joints[0].near.value(), Eigen::Vector3d::UnitX());

  EXPECT_DOUBLE_EQ(c.bodies.at(0).mass, 0.8);
  ASSERT_EQ(c.loads.size(), 4u);
  EXPECT_EQ(c.loads[0].kind, CaseLoad::Kind::force);
  EXPECT_EQ(c.loads[0].value, Eigen::Vector3d(0, -5, 0));
  EXPECT_TRUE(c.loads[0].follower);
  EXPECT_EQ(c.loads[0].time, (TimeTable{{0, 0}, {0.1, 1}}));
  EXPECT_EQ(c.loads[0].at.kind, Place::Kind::end);
  EXPECT_EQ(c.loads[1].kind, CaseLoad::Kind::moment);
  EXPECT_EQ(c.loads[1].at.kind, Place::Kind::fraction);
  EXPECT_EQ(c.loads[1].at.value, 0.5);
  EXPECT_EQ(c.loads[2].kind, CaseLoad::Kind::force_per_length);
  EXPECT_DOUBLE_EQ(c.loads[3].moving_speed.value(), 20);
  EXPECT_EQ(c.loads[3].path, "loads[3]");
  EXPECT_EQ(c.supports.at(0).type, CaseSupport::Type::clamped);
  EXPECT_EQ(c.supports.at(1).type, CaseSupport::Type::pinned);
  EXPECT_EQ(c.supports[1].at.kind, Place::Kind::near);
  EXPECT_EQ(c.supports[1].at.point, Eigen::Vector3d(1, 0.2, 0));
  const CaseSlidingJoint& joint = c.sliding_joints.at(0);
  EXPECT_EQ(joint.body, "trolley");
  EXPECT_EQ(joint.at.kind, Place::Kind::length);
  EXPECT_DOUBLE_EQ(joint.at.value, 0.1);
  EXPECT_EQ(joint.speed, 2);
  EXPECT_EQ(joint.slope, SlopeRule::discontinuous);
  EXPECT_FALSE(joint.leave_at_end);
  EXPECT_EQ(c.sliding_joints.at(1).motion.speed, 5);
  EXPECT_EQ(c.sliding_joints.at(2).motion.table, (TimeTable{{0, 0}, {1, 0.05}}));
  EXPECT_TRUE(c.sliding_joints[2].leave_at_end);
  EXPECT_EQ(c.sliding_joints[2].slope, SlopeRule::automatic);
  EXPECT_TRUE(c.analysis.start_from_equilibrium);
  EXPECT_DOUBLE_EQ(c.analysis.end_time, 0.7);
  EXPECT_EQ(c.analysis.step, 1e-3);
  EXPECT_EQ(std::get<GeneralizedAlpha>(c.analysis.integrator).tolerance, 0);
  EXPECT_EQ(std::get<GeneralizedAlpha>(c.analysis.integrator).rho_infinity, 0.7);
  EXPECT_EQ(c.analysis.length_control.min, 0.4);
  EXPECT_EQ(c.analysis.length_control.max, 1.6);
  EXPECT_EQ(c.output.every, 0.01);
  EXPECT_EQ(c.output.cad_formats, (std::vector<std::string>{"step", "iges"}));
  EXPECT_EQ(c.output.cad_times, (std::vector<double>{0, 0.35, 0.7}));
  EXPECT_EQ(c.output.cad_unit, "inch");
  EXPECT_EQ(c.output.cad_schema, StepSchema::ap242);
  EXPECT_FALSE(c.output.cad_at_all_times);
  EXPECT_EQ(c.output.cad_parameter, CurveParameter::material);
  EXPECT_EQ(c.output.probes.at(0).name, "tip");
}

TEST_F(CaseFileTest, AReportIsWrittenUnlessRefusedAndParaviewFilesWhenAskedFor) {
  const CaseFileReport silent = read(full_case, {"output.report=null", "output.paraview=null"});
  ASSERT_TRUE(silent.value) << messages(silent);
  EXPECT_TRUE(silent.value->output.report);
  EXPECT_FALSE(silent.value->output.paraview);
  const CaseFileReport said = read(full_case, {"output.report=false", "output.paraview=true"});
  ASSERT_TRUE(said.value) << messages(said);
  EXPECT_FALSE(said.value->output.report);
  EXPECT_TRUE(said.value->output.paraview);
}

TEST_F(CaseFileTest, UnknownKeysNameTheClosestKnownKey) {
  expect_error({R"(beams[0].section={"radios": 1, "radius": 1})"}, "beams[0].section.radios",
               {"\"radios\"", "did you mean \"radius\""});
  expect_error({R"(analysis={"end_time": 1, "endtime": 2})"}, "analysis.endtime",
               {"did you mean \"end_time\""});
}

TEST_F(CaseFileTest, IsToldFromAStudyFile) {
  expect_text_error(R"({"nurbeam_study": 1, "case": "case.json", "variables": []})", "",
                    {"this is a study file", "\"nurbeam study\" takes it"});
}

TEST_F(CaseFileTest, AllErrorsAreReportedAtOnce) {
  const CaseFileReport report = read(R"({"nurbeam": 1, "gravitiy": 1,
    "beams": [{"name": "a", "axis": {"polyline": [[0,0,0]]}, "section": {"radius": -1},
               "material": {"density": 1, "youngs_modulus": "5 kg"}},
              {"name": "a", "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 1, 1], "control_points": [[0,0,0],[1,0,0]]}},
               "section": {"radius": 1}, "material": {"density": 1, "youngs_modulus": 1}}],
    "supports": [{"beam": "b", "at": "start", "type": "pinned"}]})");
  std::set<std::string> places;
  for (const Diagnostic& d : report.diagnostics) places.insert(d.where.substr(file().size()));
  EXPECT_EQ(places, (std::set<std::string>{"", ": gravitiy", ": beams[0].axis.polyline",
                                           ": beams[0].section.radius", ": beams[0].material.youngs_modulus",
                                           ": beams[1].axis.nurbs", ": beams[1].name", ": supports[0].beam"}))
      << messages(report);
}

TEST_F(CaseFileTest, MissingKeysAreNamed) {
  expect_error({"nurbeam=null"}, "", {"\"nurbeam\" is missing"});
  expect_error({"beams[0].section=null"}, "beams[0]", {"\"section\" is missing"});
  expect_error({"analysis.end_time=null"}, "analysis", {"\"end_time\" is missing"});
  expect_error({R"(beams[0].section={"area": 1})"}, "beams[0].section", {"\"area\" needs \"second_moment\""});
  expect_error({R"(beams[0].axis={})"}, "beams[0].axis", {"give one of \"file\""});
  expect_error({"loads=[{\"beam\": \"cable\", \"force\": [0, 0, 1]}]"}, "loads[0]",
               {"\"force\" needs \"at\""});
}

TEST_F(CaseFileTest, NumbersOutsideTheirRangeNameValueAndRule) {
  expect_error({"beams[0].section.radius=-0.01"}, "beams[0].section.radius",
               {"-0.01 m", "between 1e-09 and 10000"});
  expect_error({"beams[0].section.radius=0 mm"}, "beams[0].section.radius", {"0 m", "between 1e-09 and"});
  expect_error({"beams[0].material.density=-1"}, "beams[0].material.density",
               {"-1 kg/m^3", "between 0.001 and 1e+06", "another unit"});
  expect_error({"beams[0].material.youngs_modulus=0"}, "beams[0].material.youngs_modulus",
               {"between 1 and 1e+16"});
  expect_error({"beams[0].material.damping=-1"}, "beams[0].material.damping", {"between 0 and 1e+09"});
  expect_error({"beams[0].elements.count=0"}, "beams[0].elements.count", {"is 0", "between 1 and 100000"});
  expect_error({"beams[0].elements.count=2.5"}, "beams[0].elements.count", {"is 2.5", "integer"});
  expect_error({"analysis.step=-1e-3"}, "analysis.step", {"-0.001 s", "between 1e-12 and 1e+09"});
  expect_error({"analysis.end_time=0"}, "analysis.end_time", {"between 1e-09 and 1e+09"});
  expect_error({"analysis.integrator.rho_infinity=1.5"}, "analysis.integrator.rho_infinity",
               {"between 0 and 1"});
  expect_error({"analysis.length_control.min=1"}, "analysis.length_control.min",
               {"between 0 and 1 (both excluded)"});
  expect_error({"nurbeam=2"}, "nurbeam", {"is 2", "format 1"});
  for (const char* count : {"100001", "1000000000000", "1e19"}) {
    expect_error({std::string("beams[0].elements.count=") + count}, "beams[0].elements.count",
                 {"is 1", "must be between 1 and 100000"});
  }
  expect_error({"bodies[0].mass=1e30"}, "bodies[0].mass", {"1e+30 kg", "another unit"}, full_case);
  expect_error({"analysis.end_time=1e308"}, "analysis.end_time", {"1e+308 s"});
}

TEST_F(CaseFileTest, StepsAndStoredFramesHaveALimitThatIsNamed) {
  expect_error({"output.every=1e-11"}, "output.every",
               {"1e-11 s", "50000000000 stored frames", "0.5 s", "limit is 1000000", "at least 5e-07 s"});
  expect_error({"analysis.end_time=1e9", "analysis.step=1e-9"}, "analysis.step",
               {"1e-09 s", "1e+18 steps", "limit is 1000000000", "at least 1 s"});
  read_valid(smallest_case, {"output.every=5e-7"});
}

TEST_F(CaseFileTest, ASlidingBodyWithoutMassIsExplained) {
  expect_error({"bodies[0].mass=0"}, "bodies[0].mass", {"0 kg", "between 1e-09 and 1e+12", "no inertia"},
               full_case);
}

TEST_F(CaseFileTest, WrongTypesNameWhatIsExpected) {
  expect_error({"gravity=9.81"}, "gravity", {"the number 9.81", "[x, y, z]", "m/s^2"});
  expect_error({"gravity=[0, 1]"}, "gravity", {"2 item(s)"});
  expect_error({"beams={}"}, "beams", {"an object", "an array"});
  expect_error({"beams[0].section.radius=true"}, "beams[0].section.radius", {"true", "a number in m"});
  expect_error({"supports[0].at=3"}, "supports[0].at", {"the number 3", "\"start\"", "\"fraction\""});
  expect_error({"beams[0].corners=1"}, "beams[0].corners", {"\"rigid\"", "\"hinge\""});
  expect_error({"beams[0].name=1"}, "beams[0].name", {"a text in quotes"});
  expect_error({"output.report=1"}, "output.report", {"true or false"});
  expect_text_error("[1, 2]", "", {"an array", "an object"});
}

TEST_F(CaseFileTest, WrongDimensionsNameTheValidUnits) {
  expect_error({"beams[0].section.radius=5 kg"}, "beams[0].section.radius", {"\"5 kg\"", "m, mm, cm"});
  expect_error({"beams[0].material.density=7200"}, "beams[0].axis.polyline", {"has 0"},
               std::string(smallest_case)
                   .replace(std::string(smallest_case).find("[[0, 0, 0], [1, 0, 0]]"), 22, "[]"));
}

TEST_F(CaseFileTest, AnglesAreInDegreesOrSayTheirUnit) {
  const auto smooth_angle = [&](const std::string& value) {
    return read_valid(smallest_case, {"beams[0].corners=smooth", "beams[0].smooth_up_to=" + value})
        .beams.at(0)
        .smooth_angle;
  };
  EXPECT_DOUBLE_EQ(smooth_angle("0.05 rad"), 0.05);
  EXPECT_EQ(smooth_angle("3 deg"), smooth_angle("3"));
  expect_error({"beams[0].corners=smooth", "beams[0].smooth_up_to=1 rad"}, "beams[0].smooth_up_to",
               {"57.29", "degrees; must be between 0 and 45"});
  const CaseFile twisted = read_valid(
      smallest_case, {"beams[0].orientation={\"up\": [0, 0, 1], \"twist\": [[0, 0], [1, \"0.25 rev\"]]}"});
  EXPECT_DOUBLE_EQ(twisted.beams.at(0).orientation.twist.at(1).second, std::numbers::pi / 2);
}

TEST_F(CaseFileTest, UnknownChoicesNameTheClosestOne) {
  expect_error({"supports[0].type=clampt"}, "supports[0].type", {"\"clampt\"", "did you mean \"clamped\""});
  expect_error({"supports[0].at=finish"}, "supports[0].at", {"\"start\", \"end\""});
}

TEST_F(CaseFileTest, AProfileNamesItsFileAndTheAxisInThePlane) {
  directory_.write("p.step", "");
  const CaseFileReport report =
      read(smallest_case, {R"(beams[0].section={"profile": {"file": "p.step", "in_plane": "x"}})"});
  ASSERT_TRUE(report.value);
  const CaseProfile profile = report.value->beams[0].section.profile.value();
  EXPECT_EQ(profile.path, directory_.path() / "p.step");
  EXPECT_TRUE(profile.x_in_plane);
  expect_error({R"(beams[0].section={"profile": {"file": "q.step"}})"}, "beams[0].section.profile.file",
               {"there is no file", "did you mean \"p.step\""});
  expect_error({R"(beams[0].section={"profile": {"in_plane": "x"}})"}, "beams[0].section.profile",
               {"\"file\" is missing"});
}

TEST_F(CaseFileTest, KeysThatExcludeEachOtherAreRefused) {
  expect_error({"beams[0].elements.count=4", "beams[0].elements.max_length=1"}, "beams[0].elements",
               {"\"count\", \"max_length\""});
  expect_error({R"(beams[0].elements={"count": 4, "grading": 0.1})"}, "beams[0].elements",
               {"\"grading\" needs \"per_segment\""});
  expect_error({"analysis.step=1e-3", "analysis.tolerance=1e-4"}, "analysis", {"\"step\", \"tolerance\""});
  expect_error({R"(beams[0].section={"radius": 1, "area": 1, "second_moment": 1})"}, "beams[0].section",
               {"\"radius\", \"area\""});
  expect_error({R"(loads=[{"beam": "cable", "force_per_length": [0, 0, 1], "at": "end"}])"}, "loads[0]",
               {"\"at\", \"force_per_length\""});
  expect_error({R"(loads=[{"beam": "cable", "moment": [0, 0, 1], "at": "end", "moves": {"speed": 1}}])"},
               "loads[0]", {"\"moves\" needs \"force\""});
}

TEST_F(CaseFileTest, ReferencesToUnknownNamesListTheNames) {
  expect_error({"supports[0].beam=cabel"}, "supports[0].beam", {"\"cabel\"", "did you mean \"cable\""});
  expect_error({"sliding_joints[0].body=trolly"}, "sliding_joints[0].body",
               {"\"trolly\"", "did you mean \"trolley\"", "\"driven\", \"timed\""}, full_case);
}

TEST_F(CaseFileTest, NamesMustDifferAndHeadColumns) {
  expect_error({"output.probes[0].name=trolley"}, "output.probes[0].name", {"bodies[0].name"}, full_case);
  expect_error({"output.probes[0].name=trolley.joint_force"}, "output.probes[0].name",
               {"\"trolley\"", "bodies[0].name"}, full_case);
  expect_error({"beams[0].name=a,b", "supports=[]"}, "beams[0].name", {"commas"});
  expect_error({R"(beams[0].name="")", "supports=[]"}, "beams[0].name", {"is empty"});
  for (const char* control : {"\\u0001", "\\u001f", "\\u007f"})  // as std::iscntrl has them
    expect_error({std::string("beams[0].name=\"a") + control + "\"", "supports=[]"}, "beams[0].name",
                 {"control characters"});
}

TEST_F(CaseFileTest, ABodyIsHeldByExactlyOneSlidingJoint) {
  expect_error({R"(bodies=[{"name": "loose", "mass": 1}])"}, "bodies[0]", {"\"loose\"", "sliding_joints"});
  expect_error(
      {R"(bodies=[{"name": "b", "mass": 1}])",
       R"(sliding_joints=[{"body": "b", "beam": "cable", "at": "start"}, {"body": "b", "beam": "cable", "at": "end"}])"},
      "sliding_joints[1]", {"\"b\"", "sliding_joints[0]"});
}

TEST_F(CaseFileTest, TimeTablesMustIncrease) {
  expect_error({"supports[0].motion=[]"}, "supports[0].motion", {"has no rows; expected rows ["});
  expect_error({"loads[0].time=[[0, 1], [1, 0], [1, 2]]"}, "loads[0].time[2]", {"must increase"}, full_case);
  expect_error({"loads[0].time=[[0, 1, 2]]"}, "loads[0].time[0]", {"[time, value]"}, full_case);
  expect_error({"output.cad.times=[0, 2]"}, "output.cad.times[1]", {"2 s", "0.7 s"}, full_case);
  const CaseFileReport endless = read(full_case, {"analysis.end_time=1 sek"});
  EXPECT_EQ(endless.diagnostics.size(), 1U) << messages(endless);
  const CaseFileReport negative = read(full_case, {"output.cad.times=[-1]"});
  EXPECT_FALSE(negative.value);
  EXPECT_EQ(messages(negative).find("is empty"), std::string::npos) << messages(negative);
}

TEST_F(CaseFileTest, CadFilesOfStaticsAreOfLoadSteps) {
  const auto of = [](const char* steps, const char* times) -> std::vector<std::string> {
    return {std::string(R"(analysis={"type": "static")") + steps + "}",
            std::string(R"(output={"cad": {"times": )") + times + "}}"};
  };
  expect_error(of(R"(, "load_steps": [0.5, 1])", "[0.5, 0.7]"), "output.cad.times[1]",
               {"is 0.7", "no factor of analysis.load_steps", "one of these: 0.5, 1"});
  expect_error(of(R"(, "load_steps": 20)", "[0.33]"), "output.cad.times[0]", {"the nearest is 0.35"});
  for (const auto& [steps, times] : {std::pair(R"(, "load_steps": 3)", "[0.3333333333333333, 1]"),
                                     {R"(, "load_steps": [0.5, 1])", R"("all")"},
                                     {R"(, "load_steps": [0.5, 2])", "[2]"},
                                     {"", "[0.7]"}}) {
    const CaseFileReport valid = read(smallest_case, of(steps, times));
    EXPECT_TRUE(valid.value) << messages(valid);
  }
}

TEST_F(CaseFileTest, ImpossibleAxesAreRefused) {
  expect_error({R"(beams[0].axis={"polyline": [[0,0,0],[0,0,0]]})"}, "beams[0].axis.polyline[1]",
               {"same point"});
  const auto arc = [](const std::string& center, const std::string& end, const std::string& normal) {
    return R"(beams[0].axis={"arc": {"start": [1,0,0], "center": )" + center + R"(, "end": )" + end +
           R"(, "normal": )" + normal + "}}";
  };
  expect_error({arc("[0,0,0]", "[0,2,0]", "[0,0,1]")}, "beams[0].axis.arc", {"1 m", "2 m", "same distance"});
  expect_error({arc("[0,0,0]", "[0,1,0]", "[0,1,1]")}, "beams[0].axis.arc.normal", {"perpendicular"});
  expect_error({arc("[0,0,0]", "[0,1,0]", "[0,0,0]")}, "beams[0].axis.arc.normal", {"direction"});
  expect_error({arc("[1,0,0]", "[0,1,0]", "[0,0,1]")}, "beams[0].axis.arc.start", {"center"});
  expect_error({arc("[0,0,0]", "[1,1e-9,0]", "[0,0,1]")}, "beams[0].axis.arc",
               {"1e-09 m", "same point twice", "whole circle"});
  expect_error(
      {R"(beams[0].axis={"nurbs": {"degree": 1, "knots": [0,0,1,1], "control_points": [[0,0,0],[1,0,0]],
                   "weights": [1, 1, 1]}})"},
      "beams[0].axis.nurbs", {"3 weights", "2 control points"});
}

std::string line_with_weights(const std::string& weights) {
  return R"(beams[0].axis={"nurbs": {"degree": 1, "knots": [0,0,1,1], "control_points": [[0,0,0],[1,0,0]],
              "weights": )" +
         weights + "}}";
}

TEST_F(CaseFileTest, WeightsOfACurveSayTheirRatiosAlone) {
  for (const char* weights : {"[1e300, 5e299]", "[2, 1]", "[3e-300, 15e-301]"}) {
    const CaseFile c = read_valid(smallest_case, {line_with_weights(weights)});
    const auto& curve = std::get<NurbsCurve>(c.beams[0].axis.source);
    EXPECT_NEAR(curve.point(0.5).x(), 1.0 / 3, 1e-15) << weights;
    EXPECT_LE(curve.control_points().row(3).maxCoeff(), 2) << weights;
  }
  expect_error({line_with_weights("[1, 1e300]")}, "beams[0].axis.nurbs.weights",
               {"from 1 to 1e+300", "1e+09 times"});
  expect_error({line_with_weights("[1e-300, 1]")}, "beams[0].axis.nurbs.weights", {"from 1e-300 to 1"});
}

TEST_F(CaseFileTest, WhatIsOutOfItsRangeIsNotComparedBesides) {
  const auto section = [](const std::string& sizes) {
    return R"(beams[0].section={"i_section": )" + sizes + "}";
  };
  expect_error({section(R"({"width": 0.1, "height": 0.1, "flange": 0, "web": 0.01})")},
               "beams[0].section.i_section.flange", {"0 m"});
  expect_error({section(R"({"width": 1e-300, "height": 0.1, "flange": 0.01, "web": 0.01})")},
               "beams[0].section.i_section.width", {"1e-300 m"});
}

TEST_F(CaseFileTest, PointsHaveALimit) {
  expect_error({R"(supports[0].at={"near": [0, 1e300, 0]})"}, "supports[0].at.near[1]",
               {"1e+300 m", "1e+09"});
  expect_error({R"(beams[0].axis={"polyline": [[0, 0, 0], [1e300, 0, 0]]})"}, "beams[0].axis.polyline[1][0]",
               {"1e+300 m"});
}

TEST_F(CaseFileTest, AMissingCadFileNamesTheClosestFile) {
  expect_error({R"(beams[0].axis={"file": "zipline.stp"})"}, "beams[0].axis.file",
               {"zipline.stp", "did you mean \"zipline.step\""});
}

TEST_F(CaseFileTest, SyntaxErrorsNameLineAndColumn) {
  expect_text_error("{\n  \"nurbeam\": 1,\n  \"beams\": [1,]\n}", "line 3, column 15", {"unexpected ']'"});
  expect_text_error("", "", {"is empty"});
}

TEST_F(CaseFileTest, NumbersThatAreNotFiniteAreNamed) {
  expect_text_error("{\n \"nurbeam\": NaN}", "line 2, column 13", {"NaN", "finite"});
  expect_text_error("{\n \"nurbeam\": -Infinity}", "line 2, column 14", {"Infinity", "finite"});
  expect_text_error("{\n \"nurbeam\": 1e999}", "line 2, column 13", {"1e999", "too large"});
}

TEST_F(CaseFileTest, DuplicateKeysAreNamedWithTheirPlace) {
  std::string text = smallest_case;
  text.insert(text.find("\"radius\""), "\"radius\": 1, ");
  expect_text_error(text, "beams[0].section.radius", {"twice"});
}

TEST_F(CaseFileTest, UnreadableFilesAreNamed) {
  const CaseFileReport missing = read_case_file(directory_.path() / "absent.json");
  check_error(missing, (directory_.path() / "absent.json").string(), {"No such file"});
  check_error(read_case_file(directory_.path()), directory_.path().string(), {"directory"});
}

TEST_F(CaseFileTest, ATextIsReadAsTheFileThatHoldsIt) {
  const CaseFile from_file = read_valid(smallest_case);
  const CaseTextReport text = case_text(file(), {"analysis.end_time=0.1"});
  EXPECT_TRUE(text.diagnostics.empty());
  const CaseFileReport from_text = read_case_text(text.json, file());
  ASSERT_TRUE(from_text.value) << messages(from_text);
  EXPECT_EQ(from_text.value->analysis.end_time, 0.1);
  EXPECT_EQ(read_case_text(smallest_case, file()).value->json, from_file.json);
  EXPECT_FALSE(case_text(file(), {"no.such.key=1"}).diagnostics.empty());
  EXPECT_EQ(case_text(directory_.path() / "absent.json").json, "");
}

TEST_F(CaseFileTest, OnlyTextsOfProgramsHaveLaws) {
  const std::string smallest = smallest_case;
  const std::string with_law =
      smallest.substr(0, smallest.rfind('}')) +
      R"(, "laws": [{ "points": [{ "beam": "cable", "at": "end" }], "spatial": true }] })";
  check_error(read(with_law), file() + ": laws", {"unknown key"});
  const CaseFileReport read = read_case_text(with_law, "model");
  ASSERT_TRUE(read.value) << messages(read);
  ASSERT_EQ(read.value->laws.size(), 1u);
  EXPECT_EQ(read.value->laws[0].points[0].beam, "cable");
  EXPECT_TRUE(read.value->laws[0].spatial);
  std::string without_place = with_law;
  without_place.replace(without_place.find(", \"at\": \"end\" }]"), 14, " ");
  EXPECT_FALSE(read_case_text(without_place, "model").value);
}

TEST_F(CaseFileTest, OverridesReplaceAddAndRemoveValues) {
  const CaseFile c =
      read_valid(smallest_case, {"analysis.end_time=0.1", "beams[0].elements.count=40",
                                 "beams[0].section.radius=2 mm", "gravity=[0, 0, -1.62]",
                                 "beams[0].axis.polyline[1][2]=2 cm", "supports=null", "name=moon"});
  EXPECT_EQ(c.analysis.end_time, 0.1);
  EXPECT_EQ(c.beams[0].elements.count, 40);
  EXPECT_DOUBLE_EQ(c.beams[0].section.area, std::numbers::pi * 4e-6);
  EXPECT_EQ(c.name, "moon");
  EXPECT_EQ(c.gravity, Eigen::Vector3d(0, 0, -1.62));
  EXPECT_EQ(std::get<CaseAxis::Polyline>(c.beams[0].axis.source).at(1), Eigen::Vector3d(1, 0, 0.02));
  EXPECT_TRUE(c.supports.empty());
  EXPECT_EQ(read_valid(full_case, {"output=null", "output.every=null"}).output.probes.size(), 0u);
  const std::size_t supports = read_valid(full_case).supports.size();
  EXPECT_EQ(read_valid(full_case, {"supports[0]=null"}).supports.size(), supports - 1);
}

TEST_F(CaseFileTest, OverridesNameItemsByNumberOrName) {
  const CaseFile c = read_valid(full_case, {"bodies[trolley].mass=7"});
  EXPECT_EQ(c.bodies.at(0).mass, 7);
  check_error(read(full_case, {"bodies[troley].mass=7"}), "--set bodies[troley].mass=7",
              {"there is no [troley]", "trolley"});
}

TEST_F(CaseFileTest, LinesHaveArcsOfABendRadius) {
  const std::string lines = R"("polyline": [[0, 0, 0], [1, 0, 0], [1, 0.8, 0], [1, 1.4, 0.6]])";
  const auto axis = [&](const std::string& radius) {
    return "beams[0].axis={" + lines + ", \"bend_radius\": " + radius + "}";
  };
  const auto lines_of = [&](const std::string& radius) {
    return std::get<BentLines>(read_valid(smallest_case, {axis(radius)}).beams[0].axis.source);
  };
  EXPECT_EQ(lines_of("\"150 mm\"").radii, std::vector<double>{0.15});
  EXPECT_EQ(lines_of("[0.15, \"30 cm\"]").radii, (std::vector<double>{0.15, 0.3}));
  const auto refuse = [&](const std::string& radius, const std::string& where,
                          const std::vector<std::string>& parts) {
    check_error(read(smallest_case, {axis(radius)}), file() + ": beams[0].axis.bend_radius" + where, parts);
  };
  refuse("0.7", "", {"is 0.7 m", "polyline[1], (1, 0, 0)", "at most 0.56568 m"});
  refuse("[0.6, 0.6]", "[0]", {"is 0.6 m", "polyline[1], (1, 0, 0)", "at most 0.55147 m"});
  refuse("[0.9, 0.1]", "[0]", {"polyline[1]", "at most 0.75857 m", "beside the arcs next to it"});
  refuse("0", "", {"greater than 0"});
  refuse("[0.1]", "", {"has 1 radii for 2 corners", "one for each", "one number for all"});
  check_error(read(smallest_case, {"beams[0].axis.bend_radius=0.1"}), file() + ": beams[0].axis.bend_radius",
              {"one line has none"});
  check_error(read(smallest_case, {"beams[0].axis.polyline[+]=[0.5, 0, 0]", "beams[0].axis.bend_radius=0.1"}),
              file() + ": beams[0].axis.bend_radius", {"goes back on itself", "polyline[1]"});
}

TEST_F(CaseFileTest, OverridesAppendToLists) {
  const std::string load = R"({"beam": "cable", "at": "end", "force": [0, 0, -5]})";
  const CaseFile first = read_valid(smallest_case, {"loads[+]=" + load, "loads[+]=" + load});
  ASSERT_EQ(first.loads.size(), 2u);  // the case has no loads
  EXPECT_EQ(first.loads[1].value, Eigen::Vector3d(0, 0, -5));
  const std::size_t before = read_valid(full_case).loads.size();
  const std::string number = std::to_string(before);
  const CaseFile more =
      read_valid(full_case, {"loads[+]=" + load, "loads[" + number + "].force[2]=-7",
                             R"(supports[+]={"beam": "cable", "at": "end", "type": "pinned"})",
                             "beams[0].axis={\"polyline\": [[0, 0, 0], [1, 0, 0]]}",
                             "beams[0].axis.polyline[+]=[2, 0, 0]", "loads[0].time[+]=[2, 0.5]"});
  ASSERT_EQ(more.loads.size(), before + 1);
  EXPECT_EQ(more.loads[before].value, Eigen::Vector3d(0, 0, -7));
  EXPECT_EQ(std::get<CaseAxis::Polyline>(more.beams[0].axis.source).size(), 3u);
  EXPECT_EQ(more.loads[0].time.size(), read_valid(full_case).loads[0].time.size() + 1);
}

TEST_F(CaseFileTest, OverridesSetNamesOfMaps) {
  const std::string body =
      R"(bodies=[{"name": "cart", "mass": 3, "inertia": [1, 1, 1], "position": [0, 0, 0]}])";
  const auto points = [&](std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), body);
    return read_valid(smallest_case, overrides).bodies.size();
  };
  const std::size_t alone = points({});
  EXPECT_EQ(points({"bodies[cart].points.hook=[0.4, 0, 0]"}), alone + 1);  // each is a place of the body
  EXPECT_EQ(points({"bodies[cart].points.hook=[0.4, 0, 0]", "bodies[0].points.rear=[0, 0, 0]",
                    "bodies[0].points.hook[2]=0.1"}),
            alone + 2);
  EXPECT_EQ(points({"bodies[cart].points.hook=[0.4, 0, 0]", "bodies[cart].points.hook=null"}), alone);
  check_error(read(smallest_case, {body, "bodies[0].points.hook=high"}), file() + ": bodies[0].points.hook",
              {"expected [x, y, z]"});
}

TEST_F(CaseFileTest, WhatCannotBeAppendedIsRefused) {
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    check_error(read(smallest_case, {text}), "--set " + text, parts);
  };
  refuse("gravity[+]=3", {"gravity", "no list"});
  refuse("loads[+]=null", {"null removes"});
  refuse("loads[+].force=[0, 0, 1]", {"loads[+]", "new item", "loads[+]={...}"});
  refuse("loads[0].force=[0, 0, 1]", {"loads has no items", "loads[+]=VALUE"});
  refuse("beams[1].name=x", {"there is no [1]", "beams[+]=VALUE appends one"});
  refuse("loads[+]={beam: tube}", {"cannot be read as JSON", "double quotes", "loads[+]={\"beam\""});
  refuse("gravity=[0, 0, -9.81", {"cannot be read as JSON"});
}

TEST_F(CaseFileTest, APartOfAStandardMaterialLeavesTheOthers) {
  const std::vector<std::string> overrides = {"beams[0].material=steel",
                                              "beams[0].material.youngs_modulus=190 GPa"};
  const CaseMaterial steel = read_valid(smallest_case, {overrides[0]}).beams[0].material,
                     other = read_valid(smallest_case, overrides).beams[0].material;
  EXPECT_EQ(other.youngs_modulus, 1.9e11);
  EXPECT_EQ(other.density, steel.density);
  EXPECT_EQ(other.name, steel.name);
}

TEST_F(CaseFileTest, APartOfGravityThatIsOmittedIsThatOfItsDefault) {
  EXPECT_EQ(read_valid(smallest_case, {"gravity[0]=1"}).gravity, Eigen::Vector3d(1, 0, -9.81));
}

TEST_F(CaseFileTest, OverridesOfUnknownPathsAreRefused) {
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    check_error(read(smallest_case, {text}), "--set " + text, parts);
  };
  refuse("analysis.endtime=1", {"analysis", "did you mean \"end_time\""});
  refuse("beams[1].name=x", {"beams has 1 item(s)", "[1]"});
  refuse("beams[x].name=x", {"[x]"});
  refuse("name.x=1", {"name has no parts"});
  refuse("supports[0].at.length=0.2", {"supports[0].at is \"start\", which has no parts"});
  refuse("gravity[3]=1", {"gravity has 3 item(s)", "[3]"});
  refuse("analysis", {"path=value"});
  refuse("=1", {"the case file"});
  for (const char* path :
       {"beams[0.name", "beams[0]name", "beams]0", "beams[[0]].name", "[0]", "beams.[0].name"})
    refuse(std::string(path) + "=x", {"brackets", "beams[0].section.radius"});
}

TEST_F(CaseFileTest, AnOverrideThatLooksLikeANumberIsNotTakenForAText) {
  for (const auto& [text, number] :
       {std::pair{".45", "write 0.45"}, {"5.", "write 5"}, {"+2", "write 2"}, {"-.5e-3", "write -0.0005"}}) {
    const std::string override = std::string("beams[0].section.radius=") + text;
    check_error(read(smallest_case, {override}), "--set " + override, {text, number});
  }
  EXPECT_EQ(read_valid(smallest_case, {"name=5 km home"}).name, "5 km home");
}

TEST_F(CaseFileTest, NestingIsLimited) {
  std::string nested(100000, '[');
  expect_text_error("{\n  \"mass\": " + nested, "line 2, column 74", {"nested more than 64 deep"});
  const std::string override = "name=" + nested;
  check_error(read(smallest_case, {override}), "--set " + override, {"nested more than 64 deep"});
  const std::string quoted = "name=\"\\\"" + nested + "\"";
  EXPECT_EQ(read_valid(smallest_case, {quoted}).name, "\"" + nested);
  read_valid("/* " + nested + " */ // " + nested + "\n" + smallest_case);
}

TEST_F(CaseFileTest, NamesThatOtherFilesCannotHoldAreRefused) {
  const auto named = [](const std::string& name) { return "beams[0].name=\"" + name + "\""; };
  const auto on = [](const std::string& name) { return "supports[0].beam=\"" + name + "\""; };
  for (const char first : {'=', '+', '-', '@'})
    expect_error({named(first + std::string("cmd|' /C calc'!A0"))}, "beams[0].name",
                 {"must not begin with = + - or @", "histories.csv"});
  expect_error({named("a,b")}, "beams[0].name", {"must not hold commas, quotes or control characters"});
  expect_error({named("a\\nb")}, "beams[0].name", {"must not hold commas, quotes or control characters"});
  const CaseFileReport megabyte = read(smallest_case, {named(std::string(1 << 20, 'x'))});
  check_error(megabyte, file() + ": beams[0].name", {"at most 250 characters, not 1048576"});
  EXPECT_LT(messages(megabyte).size(), 1000U);
  std::string umlauts;
  for (int i = 0; i < 250; ++i) umlauts += "\u00e4";
  EXPECT_EQ(read_valid(smallest_case, {named(umlauts), on(umlauts)}).beams[0].name, umlauts);
  for (const char* name : {"x') y", "b (m')", "5') b", "a=b", "2-1"})
    EXPECT_EQ(read_valid(smallest_case, {named(name), on(name)}).beams[0].name, name);
}

// Opened for reading, a pipe would wait for what writes to it.
TEST_F(CaseFileTest, APipeIsRefusedAtOnce) {
  const auto pipe = directory_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const CaseFileReport report = read_case_file(pipe);
  EXPECT_FALSE(report.value);
  EXPECT_NE(messages(report).find("is a device or a pipe"), std::string::npos) << messages(report);
  expect_error({R"(loads=[{"beam": "cable", "at": "end", "force": [0, 0, 1], "time": {"file": "pipe"}}])"},
               "loads[0].time.file", {"is a device or pipe"});
  expect_error({"beams[0].axis={\"file\": \"pipe\"}"}, "beams[0].axis.file", {"is a device or pipe"});
}

TEST_F(CaseFileTest, AnAxisFileThatIsNoFileSaysWhatItIs) {
  const auto axis = [](const std::string& file) { return "beams[0].axis={\"file\": \"" + file + "\"}"; };
  expect_error({axis(".")}, "beams[0].axis.file",
               {"is a directory", "expected a STEP, IGES, DXF, IFC, BREP or JSON file", "\"zipline.step\""});
  expect_error({axis("/dev/zero")}, "beams[0].axis.file", {"\"/dev/zero\" is a device"});
  const CaseFileReport device = read_case_file("/dev/zero");
  EXPECT_FALSE(device.value);
  EXPECT_NE(messages(device).find("/dev/zero | is a device"), std::string::npos) << messages(device);
}

TEST_F(CaseFileTest, AMistypedAxisFileIsSoughtAmongAllThatAreRead) {
  directory_.write("notes.txt", "");
  for (const char* name : {"drawing.dxf", "Drawing.IGES", "drawing.brep", "drawing.BRP", "drawing.stpZ",
                           "drawing.zip", "drawing.step.gz"}) {
    directory_.write(name, "");
    const std::string mistyped = std::string(name).erase(4, 1);
    expect_error({R"(beams[0].axis={"file": ")" + mistyped + "\"}"}, "beams[0].axis.file",
                 {"there is no file", std::string("did you mean \"") + name + "\"?", "\"zipline.step\""});
  }
  const CaseFileReport all = read(smallest_case, {R"(beams[0].axis={"file": "absent"})"});
  EXPECT_EQ(messages(all).find("notes.txt"), std::string::npos) << messages(all);
}

TEST_F(CaseFileTest, SettingsWithoutEffectInAStaticAnalysisAreWarnedOf) {
  const CaseFileReport report = read(smallest_case, {"analysis.type=static"});
  ASSERT_TRUE(report.value);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_EQ(report.diagnostics[0].where, file() + ": analysis.end_time");
}

TEST_F(CaseFileTest, KeysOfMotionsAreWarnedOfWhereThereIsNone) {
  const std::string of_motions =
      R"("integrator": {"type": "rk4", "rho_infinity": 0.5}, "step": 1e-3, "initial": "as-drawn")";
  const auto read_as = [&](const char* type) {
    return read(smallest_case,
                {std::string(R"(analysis={"type": ")") + type + R"(", "end_time": 1, )" + of_motions +
                     R"(, "length_control": {"min": 0.2}})",
                 R"(beams[0].initial={"velocity": {"translation": [1, 0, 0]}})", "output.every=1e-12"});
  };
  for (const char* type : {"static", "modes"}) {
    const CaseFileReport report = read_as(type);
    ASSERT_TRUE(report.value) << messages(report);
    std::set<std::string> places;
    for (const Diagnostic& d : report.diagnostics) {
      EXPECT_EQ(d.severity, Severity::warning);
      EXPECT_NE(d.message.find(type == std::string("static") ? "in a static analysis" : "on modes"),
                std::string::npos)
          << d.message;
      places.insert(d.where.substr(file().size() + 2));
    }
    EXPECT_EQ(places, (std::set<std::string>{"analysis.end_time", "analysis.step", "analysis.initial",
                                             "analysis.integrator", "beams[0].initial.velocity"}))
        << messages(report);
    EXPECT_EQ(report.value->analysis.length_control.min, 0.2);
    EXPECT_FALSE(report.value->output.every);
  }
  EXPECT_EQ(messages(read_as("dynamic")).find("nothing moves"), std::string::npos);
}

// The schema and the reader agree: what the schema names, the full case (and the keys not offered yet) uses,
// and the reader knows; what the reader accepts, the schema names.

void collect_keys(const nlohmann::json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties")) {
    EXPECT_EQ(schema.at("additionalProperties"), false);
    for (const auto& [key, unused] : schema["properties"].items()) keys.insert(key);
  }
  for (const nlohmann::json& item : schema)
    if (item.is_structured()) collect_keys(item, keys);
}

void collect_used_keys(const nlohmann::json& value, std::set<std::string>& keys) {
  for (const auto& [key, item] : value.items()) {
    if (value.is_object()) keys.insert(key);
    if (item.is_structured()) collect_used_keys(item, keys);
  }
}

TEST_F(CaseFileTest, WhatChangesNothingIsWarnedOf) {
  const auto warned = [&](const std::vector<std::string>& overrides) {
    const CaseFileReport report = read(full_case, overrides);
    EXPECT_TRUE(report.value) << messages(report);
    return messages(report);
  };
  const auto has = [](const std::string& said, const std::string& part) {
    return said.find(part) != std::string::npos;
  };
  const std::string air = R"(air={"density": 1.2, "wind": [10, 0, 0]})";
  EXPECT_TRUE(has(warned({air}), "air | has no effect")) << warned({air});
  EXPECT_FALSE(has(warned({air, "bodies[0].drag_area=0.5"}), "air |"));
  EXPECT_TRUE(has(warned({"output.cad.times=[]"}), "output.cad.times | is empty"));
  EXPECT_FALSE(has(warned({"output.cad.times=all"}), "output.cad.times"));
  EXPECT_TRUE(has(warned({R"(output.cad={"schema": "ap242", "formats": ["iges", "step-source"]})"}),
                  "output.cad.schema | has no effect"));
  EXPECT_FALSE(has(warned({R"(output.cad={"schema": "ap242"})"}), "output.cad.schema"));
  EXPECT_FALSE(
      has(warned({R"(output.cad={"schema": "ap242", "formats": ["iges", "step"]})"}), "output.cad.schema"));
  const auto guided = [](const char* moves) {
    return std::string(
               R"(supports[0]={"beam": "cable", "at": "start", "type": "guided", "direction": [2, 0, 0],)") +
           R"("motion": [[0, 0, 0, 0], [1, )" + moves + "]]}";
  };
  EXPECT_TRUE(has(warned({guided("0.1, 0, 0")}), "supports[0].motion | has no effect"));
  EXPECT_FALSE(has(warned({guided("0.1, 0.1, 0")}), "supports[0].motion"));
}

TEST_F(CaseFileTest, AMisspeltKeyOfARigidBeamIsOneError) {
  expect_error(
      {R"(beams[0]={"name": "cable", "rigid": true, "axs": 1, "axis": {"polyline": [[0,0,0],[1,0,0]]}})",
       "supports=[]"},
      "beams[0].axs", {"unknown key \"axs\"", "did you mean \"axis\""});
}

TEST_F(CaseFileTest, TheSchemaNamesExactlyTheKeysTheReaderTakes) {
  std::set<std::string> in_schema, in_cases = {"extreme_fibre",
                                               "profile",
                                               "in_plane",
                                               "from",
                                               "longest",
                                               "chains",
                                               "tolerance",
                                               "over",
                                               "polyline",
                                               "speed",
                                               "speeds",
                                               "torsion",
                                               "orientation",
                                               "up",
                                               "frenet",
                                               "twist",
                                               "second_moments",
                                               "product",
                                               "torsion_constant",
                                               "shear_modulus",
                                               "poissons_ratio",
                                               "thermal_expansion",
                                               "temperature",
                                               "unstressed_length",
                                               "initial",
                                               "velocity",
                                               "translation",
                                               "rotation",
                                               "about",
                                               "along",
                                               "release",
                                               "rigid",
                                               "air",
                                               "wind",
                                               "drag_area",
                                               "friction",
                                               "coefficient",
                                               "static",
                                               "law",
                                               "settle",
                                               "viscous",
                                               "stick_stiffness",
                                               "stops",
                                               "eyelets",
                                               "reels",
                                               "end",
                                               "stored",
                                               "feed",
                                               "pickup",
                                               "stored_tension",
                                               "at_empty",
                                               "quadratic",
                                               "ramp",
                                               "frame",
                                               "rate",
                                               "gravity_gradient",
                                               "radial",
                                               "mu",
                                               "centre",
                                               "collectors",
                                               "travel",
                                               "masses",
                                               "per_speed_squared",
                                               "force_on",
                                               "contact",
                                               "evaluate",
                                               "filter",
                                               "bands",
                                               "uplift",
                                               "histories_every",
                                               "fastened",
                                               "inertia",
                                               "on",
                                               "path",
                                               "side",
                                               "gap",
                                               "restitution",
                                               "stiffness",
                                               "roll_inertia",
                                               "carried_as",
                                               "follows_section",
                                               "offset",
                                               "torque_per_length",
                                               "load_steps",
                                               "columns",
                                               "modes",
                                               "bore",
                                               "rectangle",
                                               "i_section",
                                               "width",
                                               "height",
                                               "flange",
                                               "web",
                                               "rope",
                                               "diameter",
                                               "metallic_area",
                                               "wires",
                                               "tension",
                                               "mass_damping",
                                               "stiffness_damping",
                                               "direction",
                                               "equilibrium",
                                               "position",
                                               "connectors",
                                               "point",
                                               "stiffness",
                                               "end_masses",
                                               "bend_radius",
                                               "bends",
                                               "clearances",
                                               "compression",
                                               "force_over",
                                               "force_per_projected_length",
                                               "interpolation",
                                               "law",
                                               "tangents",
                                               "through",
                                               "to",
                                               "accelerations",
                                               "accuracy",
                                               "angle",
                                               "angular_velocity",
                                               "axes",
                                               "between",
                                               "drag_at",
                                               "drive",
                                               "fixed_to",
                                               "follows",
                                               "limit",
                                               "of",
                                               "points",
                                               "rolling_mass",
                                               "rotor",
                                               "target",
                                               "turned",
                                               "x",
                                               "z"};
  collect_keys(nlohmann::json::parse(case_file_schema()), in_schema);
  collect_used_keys(nlohmann::json::parse(full_case, nullptr, true, true), in_cases);
  EXPECT_EQ(in_schema, in_cases);
}

TEST_F(CaseFileTest, TheSchemaStatesRangesChoicesAndExclusions) {
  const nlohmann::json schema = nlohmann::json::parse(case_file_schema());
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema.at("required"), nlohmann::json({"nurbeam", "analysis"}));
  const nlohmann::json& beam = schema.at("properties").at("beams").at("items").at("properties");
  EXPECT_EQ(beam.at("section").at("properties").at("radius").at("minimum"), 1e-9);
  EXPECT_EQ(beam.at("section").at("dependentRequired").at("second_moment"), nlohmann::json::array({"area"}));
  EXPECT_EQ(beam.at("weights").at("enum"), nlohmann::json({"material", "constant"}));
  EXPECT_EQ(beam.at("axis").at("allOf").at(0).at("oneOf").size(), 5u);
}

// Both have a length among the histories.
TEST_F(CaseFileTest, AConnectorIsNotNamedLikeABeam) {
  const auto connector = [](const char* name) {
    return std::string(R"(connectors=[{"name": ")") + name +
           R"(", "from": {"beam": "cable", "at": "end"}, "to": {"point": [2, 0, 1]}, "stiffness": 5}])";
  };
  expect_error({connector("cable")}, "connectors[0].name",
               {"\"cable\" is already the name of beams[0].name; names must differ"});
  read_valid(smallest_case, {connector("stay")});
}

TEST(ClosestName, EditDistanceCountsSingleCharacterChanges) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook pair
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("MPA", "MPa"), 0);
  EXPECT_EQ(edit_distance("rnage", "range"), 1);
  EXPECT_EQ(edit_distance("abcd", "badc"), 2);
}

}  // namespace
}  // namespace nurbeam
