#include "pipelines/model/axis_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "cad_import/export_curves.h"
#include "pipelines/command/inspect.h"
#include "pipelines/model/build_model.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/curves.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

ImportedCurve curve(const std::string& name, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                    const std::string& layer = "", const std::string& colour = "") {
  return {.name = name, .entity = "line", .layer = layer, .colour = colour, .curve = line(a, b)};
}

// Two bent wires, the second one longer and of another layer, and a piece far away.
ImportReport wires() {
  return {.file = "wires.step",
          .unit = "mm",
          .unit_in_metres = 1e-3,
          .resolution = 1e-6,
          .curves = {curve("", {0, 0, 0}, {1, 0, 0}, "thin", "#ff0000"),
                     curve("", {1, 0, 0}, {1, 1, 0}, "thin", "#00ff00"),
                     curve("long", {0, 5, 0}, {4, 5, 0}, "thick", "#ff0000"),
                     curve("far", {0, 50, 0}, {1, 50, 0}, "thin", "#ff0000")},
          .diagnostics = {}};
}

std::vector<int> chosen(const AxisFile& axis, const ImportReport& report = wires()) {
  const AxisSelection selection = select_axis(axis, report);
  EXPECT_EQ(selection.error, "");
  return selection.chains.size() == 1 ? selection.chains[0].curves : std::vector<int>{-1};
}

void expect_error(const AxisFile& axis, const std::string& key, const std::vector<std::string>& parts,
                  const ImportReport& report = wires()) {
  const AxisSelection selection = select_axis(axis, report);
  EXPECT_TRUE(selection.chains.empty());
  EXPECT_EQ(selection.key, key);
  for (const std::string& part : parts)
    EXPECT_NE(selection.error.find(part), std::string::npos) << selection.error;
}

TEST(AxisSelection, IsByNameIndexPointLengthLayerAndColour) {
  EXPECT_EQ(chosen({.curve_name = "long"}), std::vector<int>{2});
  EXPECT_EQ(chosen({.curve_index = 2}), std::vector<int>{1});
  EXPECT_EQ(chosen({.near = Eigen::Vector3d(2, 0.2, 0)}), (std::vector<int>{0, 1}));
  EXPECT_EQ(chosen({.near = Eigen::Vector3d(2, 4, 0)}), std::vector<int>{2});
  EXPECT_EQ(chosen({.longest = true}), std::vector<int>{2});
  EXPECT_EQ(chosen({.layer = "thick"}), std::vector<int>{2});
  EXPECT_EQ(chosen({.colour = "#00FF00"}), std::vector<int>{1});
}

TEST(AxisSelection, APartIsNamedByItsPathOrTheEndOfIt) {
  ImportReport assembly = wires();
  assembly.curves[2].part = "bridge/left/rope";
  assembly.curves[3].part = "bridge/right/rope";
  EXPECT_EQ(chosen({.part = "bridge/left/rope"}, assembly), std::vector<int>{2});
  EXPECT_EQ(chosen({.part = "right/rope"}, assembly), std::vector<int>{3});
  expect_error({.part = "rop"}, "part", {"\"bridge/left/rope\"", "\"bridge/right/rope\""}, assembly);
}

TEST(AxisSelection, LayerAndColourNarrowWhatIsChosenFrom) {
  EXPECT_EQ(chosen({.layer = "thin", .longest = true}), (std::vector<int>{0, 1}));
  EXPECT_EQ(chosen({.layer = "thin", .colour = "#ff0000", .near = Eigen::Vector3d(0, 5, 0)}),
            std::vector<int>{0});
  expect_error({.curve_index = 3, .layer = "thin"}, "curve", {"index 3", "1-2, 4 \"far\""});
}

TEST(AxisSelection, TakesEveryChainWhenAsked) {
  const AxisSelection selection = select_axis({.all_chains = true}, wires());
  ASSERT_EQ(selection.chains.size(), 3U);
  EXPECT_EQ(selection.chains[0].curves, (std::vector<int>{0, 1}));
  EXPECT_EQ(selection.chains[2].curves, std::vector<int>{3});
}

TEST(AxisSelection, ErrorsListWhatThereIs) {
  expect_error({}, "", {"3 separate chains", "1-2 (2 m); 3 \"long\" (4 m); 4 \"far\" (1 m)", "\"longest\""});
  expect_error({.layer = "thicc"}, "layer", {"did you mean \"thick\"", "\"thin\""});
  expect_error({.colour = "#0000ff"}, "colour", {"#00ff00", "#ff0000"});
  expect_error({.curve_name = "lomg"}, "curve", {"no curve is named \"lomg\"", "3 \"long\""});
  expect_error({.curve_index = 9}, "curve", {"index 9 is out of range", "4 curves"});
  ImportReport plain = wires();
  for (ImportedCurve& c : plain.curves) c.layer.clear();
  expect_error({.layer = "x"}, "layer", {"no curve of wires.step has a layer"}, plain);
}

TEST(AxisSelection, SeveralCurvesOfOneNameAreTheirChain) {
  ImportReport report = wires();
  report.curves[0].name = report.curves[1].name = "bent";
  EXPECT_EQ(chosen({.curve_name = "bent"}, report), (std::vector<int>{0, 1}));
  report.curves[3].name = "bent";
  expect_error({.curve_name = "bent"}, "curve", {"several curves are named \"bent\"", "index"}, report);
}

ImportReport drawing(const std::vector<NurbsCurve>& curves) {
  ImportReport report{
      .file = "drawing.dxf", .unit = "m", .resolution = 1e-6, .curves = {}, .diagnostics = {}};
  for (const NurbsCurve& each : curves) report.curves.push_back({.entity = "curve", .curve = each});
  return report;
}

void expect_chain(const AxisFile& axis, const ImportReport& report, const Chain& expected) {
  const AxisSelection selection = select_axis(axis, report);
  ASSERT_EQ(selection.chains.size(), 1U) << selection.error;
  EXPECT_EQ(selection.chains[0].curves, expected.curves);
  EXPECT_EQ(selection.chains[0].reversed, expected.reversed);
  EXPECT_EQ(selection.chains[0].closed, expected.closed);
}

TEST(AxisSelection, TheSmoothChainOfACurveGoesOnPastThePlaceWhereALoopBegins) {
  const ImportReport square =
      drawing({line({1, 0, 0}, {2, 0, 0}), line({2, 0, 0}, {2, 2, 0}), line({2, 2, 0}, {0, 2, 0}),
               line({0, 2, 0}, {0, 0, 0}), line({1, 0, 0}, {0, 0, 0})});
  for (const int index : {1, 5})
    expect_chain({.curve_index = index, .chain = true}, square, {{4, 0}, {true, false}, false});
  expect_chain({.curve_index = 2, .chain = true}, square, {{1}, {false}, false});
}

// The quarters of the unit circle.
std::vector<NurbsCurve> quarters() {
  std::vector<NurbsCurve> found;
  for (const RationalCubic& quarter : BezierPath::from_nurbs(unit_circle(), 1e-9).segments)
    found.push_back(BezierPath{{quarter}, {0, 1}, 0}.to_nurbs());
  return found;
}

TEST(AxisSelection, ALoopWithoutCornersIsAClosedChainAndOneOfOneCornerBeginsThere) {
  expect_chain({.curve_index = 3, .chain = true}, drawing(quarters()),
               {{0, 1, 2, 3}, {false, false, false, false}, true});
  std::vector<NurbsCurve> drop = quarters();
  drop.back() = line({0, -1, 0}, {1, -1, 0});
  drop.push_back(line({1, -1, 0}, {1, 0, 0}));
  for (int index = 1; index <= 5; ++index)
    expect_chain({.curve_index = index, .chain = true}, drawing(drop),
                 {{4, 0, 1, 2, 3}, {false, false, false, false, false}, true});
}

// With its last control point doubled it has no speed there.
TEST(AxisSelection, ASplineThatStandsStillAtItsEndGoesOnSmoothly) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0;
  const NurbsCurve slowing =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1}), points, Eigen::Vector4d::Ones());
  const NurbsCurve on = line({2, 0, 0}, {4, 0, 0}), aside = line({2, 0, 0}, {4, 1, 0});
  expect_chain({.curve_index = 1, .chain = true}, drawing({slowing, on}), {{0, 1}, {false, false}, false});
  expect_chain({.curve_index = 2, .chain = true}, drawing({slowing.reversed(), on.reversed()}),
               {{1, 0}, {false, false}, false});
  expect_chain({.curve_index = 1, .chain = true}, drawing({slowing, aside}), {{0}, {false}, false});
}

TEST(AxisSelection, PrefersFreeCurvesToCentreLinesToEdgesOfFaces) {
  ImportReport report = wires();
  for (ImportedCurve& c : report.curves) c.free = false;
  report.curves[0].pipe_radius = report.curves[1].pipe_radius = 0.1;
  EXPECT_EQ(chosen({}, report), (std::vector<int>{0, 1}));
  report.curves[3].free = true;
  EXPECT_EQ(chosen({}, report), std::vector<int>{3});
  EXPECT_EQ(chosen({.curve_index = 3}, report), std::vector<int>{2});
}

TEST(AxisSelection, ClosesGapsUpToTheFilesOwnResolution) {
  ImportReport report = wires();
  report.curves.erase(report.curves.begin() + 2, report.curves.end());
  report.curves[1] = curve("", {1, 8e-7, 0}, {1, 1, 0});
  const AxisSelection selection = select_axis({}, report);
  ASSERT_EQ(selection.chains.size(), 1U);
  ASSERT_EQ(selection.gaps.size(), 1U);
  EXPECT_NEAR(selection.gaps[0].width, 8e-7, 1e-15);
  EXPECT_LT((selection.gaps[0].point - Eigen::Vector3d(1, 4e-7, 0)).norm(), 1e-15);
}

TEST(AxisSelection, ALargerGapIsAnErrorWithItsPlaceUnlessTheCaseAllowsIt) {
  ImportReport report = wires();
  report.curves.erase(report.curves.begin() + 2, report.curves.end());
  report.curves[1] = curve("", {1, 2e-6, 0}, {1, 1, 0});
  expect_error({}, "", {"curves 1 and 2 end 2e-06 m apart at (1, 1e-06, 0) m", "up to 1e-06 m", "\"gap\""},
               report);
  EXPECT_EQ(chosen({.gap = 1e-5}, report), (std::vector<int>{0, 1}));
}

TEST(AxisSelection, TheToleranceOfGapsIsBoundedByTheSizeOfTheCurves) {
  ImportReport report = wires();
  const double size = std::hypot(4, 50);
  EXPECT_DOUBLE_EQ(gap_tolerance(report, {}), 1e-6);
  report.resolution = 1;
  EXPECT_DOUBLE_EQ(gap_tolerance(report, {}), 1e-3 * size);
  report.resolution = 1e-30;
  EXPECT_DOUBLE_EQ(gap_tolerance(report, {}), 1e-9 * size);
  report.resolution = 0;
  EXPECT_DOUBLE_EQ(gap_tolerance(report, {}), 1e-6 * size);
}

TEST(AxisSelection, JunctionsAreWhereThreeOrMoreEndsOfCurvesMeet) {
  ImportReport report = wires();
  EXPECT_TRUE(junctions(report, 1e-6).empty());
  report.curves.push_back(curve("", {1, 0, 0}, {2, 0, 0}));
  const std::vector<Junction> found = junctions(report, 1e-6);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].curves, (std::vector<int>{0, 1, 4}));
  EXPECT_EQ(found[0].point, Eigen::Vector3d(1, 0, 0));
  for (ImportedCurve& c : report.curves) c.free = false;
  EXPECT_TRUE(junctions(report, 1e-6).empty());
}

// A file with a star of three legs and a wire of its own, in metres.
std::filesystem::path star(const test::TemporaryDirectory& directory) {
  const std::filesystem::path file = directory.path() / "star.step";
  EXPECT_TRUE(export_curves(file,
                            {{"a", line({0, 0, 0}, {1, 0, 0})},
                             {"b", line({0, 0, 0}, {0, 1, 0})},
                             {"c", line({0, 0, 0}, {-1, 0, 0})},
                             {"d", line({0, 5, 0}, {3, 5, 0})}},
                            LengthUnit::metre)
                  .empty());
  return file;
}

BuildReport build_axis(const test::TemporaryDirectory& directory, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {R"(beams[0].axis={"file": "star.step", "chains": "all"})",
                                       R"(beams[0].name="net")", R"(supports[0].beam="net")"});
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  for (const Diagnostic& d : report.diagnostics) ADD_FAILURE() << d.where << ": " << d.message;
  return build_model(report.value.value());
}

bool says(const BuildReport& report, Severity severity, const std::string& words) {
  return std::any_of(
      report.diagnostics.begin(), report.diagnostics.end(),
      [&](const Diagnostic& d) {
        return d.severity == severity && (d.where + ": " + d.message).find(words) != std::string::npos;
      });
}

TEST(AxisSelection, EveryChainOfAFileBecomesABeamAndIsSupportedAsTheWhole) {
  const test::TemporaryDirectory directory;
  star(directory);
  const BuildReport report = build_axis(directory, {});
  ASSERT_TRUE(report.value);
  const BeamModel& model = report.value->model;
  ASSERT_EQ(model.beams.size(), 4U);
  EXPECT_EQ(model.beams[0].name, "net 1");
  EXPECT_EQ(model.beams[3].name, "net 4");
  EXPECT_NEAR(model.beams[3].curve.length(), 3, 1e-12);
  std::vector<std::string> names;
  for (const BeamSource& source : report.value->sources) names.push_back(source.curve_name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
  ASSERT_EQ(model.constraints.size(), 4U);
  EXPECT_EQ(std::get<Support>(model.constraints[2]).beam, 2);
  EXPECT_TRUE(says(report, Severity::note, "curves 1 \"a\", 2 \"b\", 3 \"c\" of")) << "the junction";
}

TEST(AxisSelection, OneOfSeveralChainsIsNamedByItsNumber) {
  const test::TemporaryDirectory directory;
  star(directory);
  const BuildReport report =
      build_axis(directory, {R"(loads=[{"beam": "net 4", "at": "end", "force": [0, 1, 0]}])"});
  ASSERT_TRUE(report.value);
  ASSERT_EQ(report.value->model.forces.size(), 1U);
  EXPECT_EQ(std::get<PointLoad>(report.value->model.forces[0]).beam, 3);
  const BuildReport wrong =
      build_axis(directory, {R"(loads=[{"beam": "net 5", "at": "end", "force": [0, 1, 0]}])"});
  EXPECT_FALSE(wrong.value);
  EXPECT_TRUE(says(wrong, Severity::error, "loads[0].beam: there is no beam \"net 5\""));
}

TEST(AxisSelection, NothingElseIsNamedLikeTheBeamOfAChain) {
  const test::TemporaryDirectory directory;
  star(directory);
  const auto beam = [](const std::string& name, const std::string& axis) {
    return R"({"name": ")" + name + R"(", "axis": )" + axis +
           R"(, "section": {"radius": 0.01}, "material": {"density": 7200, "youngs_modulus": 20e6}})";
  };
  const std::string every_chain = R"({"file": "star.step", "chains": "all"})";
  const auto with_beam = [&](const std::string& name, const std::string& axis) {
    return build_axis(directory, {"beams=[" + beam("net", every_chain) + ", " + beam(name, axis) + "]"});
  };
  const std::string straight = R"({"polyline": [[0, 9, 0], [1, 9, 0]]})";
  const BuildReport named_alike = with_beam("net 4", straight);
  EXPECT_FALSE(named_alike.value);
  EXPECT_TRUE(
      says(named_alike, Severity::error,
           "beams[1].name: is \"net 4\", the name of a beam that \"net\" becomes by \"chains\": \"all\""));
  EXPECT_FALSE(with_beam("net 4", every_chain).value);
  EXPECT_FALSE(says(with_beam("net 5", straight), Severity::error, ".name"));
  const BuildReport spring =
      build_axis(directory, {R"(connectors=[{"name": "net 1", "from": {"beam": "net 4", "at": "end"},
                                  "to": {"point": [3, 6, 0]}, "stiffness": 5}])"});
  EXPECT_FALSE(spring.value);
  EXPECT_TRUE(says(spring, Severity::error, "connectors[0].name: is \"net 1\""));
}

TEST(AxisSelection, ABodySlidesOnOneBeamOnly) {
  const test::TemporaryDirectory directory;
  star(directory);
  const BuildReport report =
      build_axis(directory, {R"(bodies=[{"name": "bead", "mass": 1}])",
                             R"(sliding_joints=[{"body": "bead", "beam": "net", "at": "start"}])"});
  EXPECT_FALSE(report.value);
  EXPECT_TRUE(says(report, Severity::error, "choose one: \"net 1\", \"net 2\""));
}

TEST(AxisSelection, InspectListsChainsAndJunctions) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = star(directory);
  std::ostringstream table, json, errors;
  EXPECT_EQ(inspect_files({file}, false, table, errors), 0);
  EXPECT_NE(table.str().find("chains of curves: 4\n  3 m: curve 4 \"d\"\n"), std::string::npos)
      << table.str();
  EXPECT_NE(table.str().find("ends meet: 1\n  (0, 0, 0) m: curves 1 \"a\", 2 \"b\", 3 \"c\"\n"),
            std::string::npos)
      << table.str();
  EXPECT_EQ(inspect_files({file}, true, json, errors), 0);
  EXPECT_NE(json.str().find("\"junctions\""), std::string::npos);
  EXPECT_EQ(errors.str(), "");
}

TEST(AxisSelection, ACurveIsChosenByItsNameWhateverThatHolds) {
  const test::TemporaryDirectory directory;
  const std::string inches = "1/2\" pipe, left", ring = "缆索 Ø5";
  const std::filesystem::path file = directory.path() / "names.step";
  ASSERT_TRUE(export_curves(file, {{inches, line({0, 0, 0}, {1, 0, 0})}, {ring, line({0, 5, 0}, {4, 5, 0})}},
                            LengthUnit::metre)
                  .empty());
  const CaseFileReport read =
      read_case_file(directory.write("case.json", test::smallest_case),
                     {R"(beams[0].axis={"file": "names.step", "curve": "1/2\" pipe, left"})"});
  ASSERT_TRUE(read.value) << read.diagnostics.front().message;
  const BuildReport report = build_model(*read.value);
  ASSERT_TRUE(report.value);
  EXPECT_NEAR(report.value->model.beams[0].curve.length(), 1, 1e-12);
}

// Where the column of the kind begins in each row of the table, in characters, of which a Chinese one is
// twice as wide.
TEST(AxisSelection, InspectPrintsColumnsWhoseCharactersStandBelowEachOther) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "names.step";
  ASSERT_TRUE(export_curves(file,
                            {{"rope", line({0, 0, 0}, {1, 0, 0})},
                             {"Seil Ø5", line({0, 5, 0}, {4, 5, 0})},
                             {"缆索", line({0, 7, 0}, {4, 7, 0})}},
                            LengthUnit::metre)
                  .empty());
  std::ostringstream table, errors;
  ASSERT_EQ(inspect_files({file}, false, table, errors), 0);
  for (const std::string row :
       {"  1      rope     bspline ", "  2      Seil Ø5  bspline ", "  3      缆索     bspline "})
    EXPECT_NE(table.str().find(row), std::string::npos) << table.str();
}

TEST(PipeSection, IsThatOfTheDrawnPipe) {
  const test::TemporaryDirectory directory;
  const std::string file = test::source_directory() / "tests/corpus/pygem-pipe.step";
  const auto build_pipe = [&](const std::string& axis) {
    const CaseFileReport report = read_case_file(
        directory.write("case.json", test::smallest_case),
        {"beams[0].axis={\"file\": \"" + file + "\"" + axis + "}", R"(beams[0].section={"from": "cad"})"});
    return build_model(report.value.value());
  };
  const BuildReport pipe = build_pipe("");
  ASSERT_TRUE(pipe.value);
  const Beam& beam = pipe.value->model.beams[0];
  // A rod of radius 1 m and length 10 m, of 20 MPa and 7200 kg/m^3.
  EXPECT_NEAR(beam.curve.length(), 10, 1e-8);
  EXPECT_NEAR(beam.properties.axial_stiffness, 20e6 * std::numbers::pi, 1e-6 * 20e6);
  EXPECT_NEAR(beam.properties.bending_stiffness, 20e6 * std::numbers::pi / 4, 1e-6 * 20e6);
  EXPECT_NEAR(beam.properties.mass_per_length, 7200 * std::numbers::pi, 1e-6 * 7200);
  const BuildReport edge = build_pipe(R"(, "curve": 3)");
  EXPECT_FALSE(edge.value);
  EXPECT_TRUE(says(edge, Severity::error, "beams[0].section.from: is \"cad\", but curve 3 of"));
}

TEST(PipeSection, KeepsTheTorsionConstantThatIsGiven) {
  const test::TemporaryDirectory directory;
  const std::string file = test::source_directory() / "tests/corpus/pygem-pipe.step";
  const CaseFileReport report =
      read_case_file(directory.write("case.json", test::smallest_case),
                     {"beams[0].axis={\"file\": \"" + file + "\"}", "beams[0].torsion=true",
                      "beams[0].material.poissons_ratio=0.25",
                      R"(beams[0].section={"from": "cad", "torsion_constant": 1e-3})"});
  const BuildReport pipe = build_model(report.value.value());
  ASSERT_TRUE(pipe.value);
  EXPECT_NEAR(pipe.value->model.beams[0].properties.sections->torsion, 20e6 / 2.5 * 1e-3, 1e-6);
}

TEST(PipeSection, OfASquareTubeIsItsAreaAndSecondMoment) {
  const test::TemporaryDirectory directory;
  const std::string file = test::source_directory() / "tests/corpus/kinds/mitred_square_tube.step";
  const CaseFileReport report = read_case_file(
      directory.write("case.json", test::smallest_case),
      {"beams[0].axis={\"file\": \"" + file + "\", \"curve\": 41}", R"(beams[0].section={"from": "cad"})"});
  const BuildReport tube = build_model(report.value.value());
  ASSERT_TRUE(tube.value);
  const Beam& beam = tube.value->model.beams[0];
  EXPECT_NEAR(beam.curve.length(), 0.2, 1e-12);
  EXPECT_NEAR(beam.properties.axial_stiffness, 20e6 * (0.04 * 0.04 - 0.034 * 0.034), 1e-9);
  EXPECT_NEAR(beam.properties.bending_stiffness, 20e6 * (std::pow(0.04, 4) - std::pow(0.034, 4)) / 12, 1e-12);
}

TEST(PipeSection, NeedsACentreLine) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case),
                                               {R"(beams[0].section={"from": "cad"})"});
  EXPECT_TRUE(says(build_model(report.value.value()), Severity::error, "needs an axis from a file"));
}

TEST(Corners, AreSmoothedUpToTheAngleAskedForAndReported) {
  const test::TemporaryDirectory directory;
  const auto build_bent = [&](const std::string& corners, double y) {
    std::ostringstream axis;
    axis << R"(beams[0].axis={"polyline": [[0, 0, 0], [1, 0, 0], [2, )" << y << ", 0]]}";
    const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case),
                                                 {axis.str(), "beams[0].corners=" + corners});
    return build_model(report.value.value());
  };
  const BuildReport smooth = build_bent("smooth", 0.02);
  ASSERT_TRUE(smooth.value);
  EXPECT_TRUE(says(smooth, Severity::warning, "beams[0].corners: corners of up to 5 degrees were smoothed"));
  EXPECT_FALSE(build_bent("error", 0.02).value);
  EXPECT_TRUE(build_bent("hinge", 0.02).value);
  EXPECT_TRUE(build_bent("rigid", 0.05).value);
  const BuildReport sharp = build_bent("smooth", 0.2);
  EXPECT_FALSE(sharp.value);
  EXPECT_TRUE(says(sharp, Severity::error, "\"corners\": \"rigid\""));
  EXPECT_TRUE(says(sharp, Severity::error, "\"smooth_up_to\": 12"));
  EXPECT_TRUE(says(sharp, Severity::error, "a corner of 11.3"));
  EXPECT_TRUE(says(sharp, Severity::error, "at (1, 0, 0) m"));
}

// The pieces of a spline between its knots: what they turn by is round-off.
TEST(Corners, OfRoundOffAreNotSaidToBeSmoothed) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report =
      read_case_file(directory.write("case.json", test::smallest_case),
                     {R"(beams[0].axis={"nurbs": {"degree": 2, "knots": [0, 0, 0, 0.3, 0.7, 1, 1, 1],
           "control_points": [[0, 0, 0], [0.31, 0.1, 0.2], [0.53, 0.07, 0.3], [0.8, 0.2, 0.1], [1, 0, 0]]}})",
                      "beams[0].corners=smooth"});
  const BuildReport smooth = build_model(report.value.value());
  EXPECT_TRUE(smooth.value);
  EXPECT_FALSE(says(smooth, Severity::warning, "were smoothed"));
}

TEST(Corners, AboveThoseThatAreSmoothedAreWhatTheCaseSays) {
  const test::TemporaryDirectory directory;
  // Corners of 1 and 90 degrees.
  const std::string axis =
      R"(beams[0].axis={"polyline": [[0, 0, 0], [1, 0, 0], [2, 0.017455, 0], [2, 0.5, 0]]})";
  const auto kinds = [&](const std::vector<std::string>& overrides) {
    std::vector<std::string> all{axis, "gravity=[0, -1, 0]"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const BuildReport report =
        build_model(read_case_file(directory.write("case.json", test::smallest_case), all).value.value());
    std::vector<NodeKind> found;
    if (!report.value) return found;
    const Beam& beam = report.value->model.beams[0];
    for (const HomeNode& node : beam.home)
      if (node.permanent) found.push_back(node.kind);
    return found;
  };
  using enum NodeKind;
  EXPECT_EQ(kinds({"beams[0].corners=rigid"}), (std::vector{rigid, rigid}));
  EXPECT_EQ(kinds({"beams[0].corners=hinge"}), (std::vector{hinge, hinge}));
  EXPECT_EQ(kinds({"beams[0].corners=rigid", "beams[0].smooth_up_to=2"}), (std::vector{smooth, rigid}));
  EXPECT_EQ(kinds({"beams[0].corners=hinge", "beams[0].smooth_up_to=2"}), (std::vector{smooth, hinge}));
  EXPECT_TRUE(kinds({"beams[0].corners=error", "beams[0].smooth_up_to=2"}).empty());
}

}  // namespace
}  // namespace nurbeam
