#include "pipelines/command/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "pipelines/results/results.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

struct CommandOutcome {
  int code;
  std::string out, err;
};

CommandOutcome run_line(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = run_command_line(arguments, out, err);
  return {code, out.str(), err.str()};
}

bool text_holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A quarter of the unit circle about the origin, moved along x.
NurbsCurve quarter_circle(double x = 0) {
  Eigen::Matrix3Xd points(3, 3);
  points << 1 + x, 1 + x, x, 0, 1, 1, 0, 0, 0;
  return make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), points,
                          Eigen::Vector3d(1, std::numbers::sqrt2 / 2, 1));
}

NurbsCurve line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3Xd points(3, 2);
  points << a, b;
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), points, Eigen::Vector2d::Ones());
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput) {
  EXPECT_EQ(run_line({"--help"}).code, 0);
  EXPECT_TRUE(text_holds(run_line({"--help"}).out, "nurbeam compare A B"));
  EXPECT_TRUE(text_holds(run_line({"--help"}).out, "nurbeam run CASE.json [options]\n"));
  EXPECT_TRUE(
      text_holds(run_line({"--help"}).out, "nurbeam export RESULTS_DIR --time T --to FILE [options]"));
  std::istringstream help(run_line({"--help"}).out);
  for (std::string line; std::getline(help, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_TRUE(text_holds(run_line({"run", "--help"}).out, "--set path=value"));
  EXPECT_TRUE(run_line({"--version"}).out.starts_with("nurbeam "));
  EXPECT_EQ(run_line({}).code, 2);
}

TEST(CommandLine, UnknownCommandsAndOptionsNameTheClosestOne) {
  const CommandOutcome command = run_line({"inspct"}), option = run_line({"run", "case.json", "--quite"});
  EXPECT_EQ(command.code, 2);
  EXPECT_TRUE(text_holds(command.err, "did you mean \"inspect\"")) << command.err;
  EXPECT_EQ(option.code, 2);
  EXPECT_TRUE(text_holds(option.err, "did you mean \"--quiet\"")) << option.err;
}

TEST(CommandLine, ArgumentsThatDoNotFitShowTheUsage) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run"},
                                                {"compare", "a"},
                                                {"run", "a", "b"},
                                                {"run", "a", "--out"},
                                                {"run", "a", "--out", ""},
                                                {"run", "a", "--quiet=1"},
                                                {"run", "a", "--threads", "0"},
                                                {"export", "d", "--to", "f.step"},
                                                {"export", "d", "--time", "x", "--to", "f.step"},
                                                {"compare", "a", "b", "--tolerance", "-1"},
                                                {"schema", "cases"}}) {
    const CommandOutcome outcome = run_line(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(text_holds(outcome.err, "usage: nurbeam " + words[0])) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(CommandLine, ACommandThatIsNotThereIsNeitherOfferedNorRun) {
  const CommandOutcome outcome = run_line({"draw", "s.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(text_holds(outcome.err, "draw")) << outcome.err;
  EXPECT_FALSE(text_holds(run_line({"--help"}).out, "draw "));
  EXPECT_TRUE(text_holds(run_line({"schema", "run"}).err, "there is no schema \"run\""));
}

TEST(CommandLine, ABadCaseFileEndsWithTwoAndItsPlace) {
  const test::TemporaryDirectory directory;
  const std::string file = directory.write("case.json", test::smallest_case).string();
  const CommandOutcome outcome = run_line({"check", file, "--set", "beams[0].section.radius=-1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(text_holds(outcome.err, "error: " + file + ": beams[0].section.radius: is -1 m"))
      << outcome.err;
  EXPECT_EQ(run_line({"run", (directory.path() / "absent.json").string()}).code, 2);
}

TEST(CommandLine, ANameThatNoFileSystemTakesIsNamed) {
  const std::string name(300, 'a');
  for (const std::vector<std::string>& line : {std::vector<std::string>{"check", name + ".json"},
                                               {"export", name, "--time", "0", "--to", "x.step"}}) {
    const CommandOutcome outcome = run_line(line);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err.find("filesystem error"), std::string::npos) << outcome.err;
    EXPECT_TRUE(text_holds(outcome.err, "error: " + name)) << outcome.err;
  }
}

TEST(CommandLine, TheSchemaIsPrinted) {
  EXPECT_TRUE(nlohmann::json::parse(run_line({"schema"}).out).contains("properties"));
  EXPECT_EQ(run_line({"schema", "case"}).out, run_line({"schema"}).out);
}

TEST(CommandLine, InspectListsTheCurvesOfAFile) {
  const test::TemporaryDirectory directory;
  const std::string file = (directory.path() / "curves.step").string();
  ASSERT_TRUE(export_curves(file, {{"arc", quarter_circle()}, {"line", line({0, 0, 0}, {0, 0, 2})}},
                            LengthUnit::millimetre)
                  .empty());
  const CommandOutcome table = run_line({"inspect", file}), json = run_line({"inspect", "--json", file});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_TRUE(text_holds(table.out, "unit mm")) << table.out;
  EXPECT_TRUE(text_holds(table.out, "(1, 0, 0)")) << table.out;
  const nlohmann::json curves = nlohmann::json::parse(json.out).at(0).at("curves");
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0].at("index"), 1);
  EXPECT_EQ(curves[0].at("name"), "arc");
  EXPECT_EQ(curves[0].at("rational"), true);
  EXPECT_EQ(curves[0].at("degree"), 2);
  EXPECT_NEAR(curves[0].at("length [m]"), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(curves[1].at("closed"), false);
}

TEST(CommandLine, InspectOfAnUnreadableFileEndsWithTwoAndStillListsTheOthers) {
  const test::TemporaryDirectory directory;
  const std::string good = (directory.path() / "good.igs").string();
  ASSERT_TRUE(export_curves(good, {{"arc", quarter_circle()}}, LengthUnit::metre).empty());
  const std::string bad = directory.write("bad.step", "this is no CAD file").string();
  const CommandOutcome outcome = run_line({"inspect", bad, good});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(text_holds(outcome.err, "error: ")) << outcome.err;
  EXPECT_TRUE(text_holds(outcome.out, "good.igs: 1 curve,")) << outcome.out;
}

TEST(CommandLine, CompareMeasuresBothWaysAgainstAllCurves) {
  const test::TemporaryDirectory directory;
  const auto write = [&](const std::string& name, const std::vector<NamedCurve>& curves) {
    EXPECT_TRUE(export_curves(directory.path() / name, curves, LengthUnit::millimetre).empty());
    return (directory.path() / name).string();
  };
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  const std::string whole = write("whole.step", {{"whole", line(a, c)}});
  const std::string halves = write("halves.igs", {{"first", line(a, b)}, {"second", line(b, c)}});
  const std::string half = write("half.step", {{"first", line(a, b)}});
  const CommandOutcome same = run_line({"compare", whole, halves, "--tolerance", "1e-12"});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  for (const auto& [first, second] : {std::pair{whole, half}, {half, whole}}) {
    const CommandOutcome different = run_line({"compare", first, second, "--tolerance", "999 mm"});
    EXPECT_EQ(different.code, 1) << different.out;
    EXPECT_TRUE(text_holds(different.out, "largest distance: 1 m")) << different.out;
    EXPECT_EQ(run_line({"compare", first, second, "--tolerance=1001 mm"}).code, 0);
  }
  EXPECT_EQ(run_line({"compare", whole, (directory.path() / "absent.step").string()}).code, 2);
  // Without a tolerance it is a millionth of the size, here of 2 m.
  const std::string near = write("near.step", {{"whole", line({0, 0, 1.9e-6}, {2, 0, 1.9e-6})}});
  const std::string off = write("off.step", {{"whole", line({0, 0, 2.1e-6}, {2, 0, 2.1e-6})}});
  EXPECT_EQ(run_line({"compare", whole, near}).code, 0);
  const CommandOutcome differs = run_line({"compare", whole, off});
  EXPECT_EQ(differs.code, 1);
  EXPECT_TRUE(text_holds(differs.out, "1.05e-06 of the size")) << differs.out;
  EXPECT_TRUE(text_holds(differs.out, "the curves differ: the tolerance is 2e-06 m")) << differs.out;
}

TEST(CommandLine, ExportWritesTheStoredCurveExactly) {
  const test::TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), {{}, {}, {"cable"}}, "title");
  const NurbsCurve arc = quarter_circle();
  const BezierPath path = BezierPath::from_nurbs(arc, 1e-9);
  Snapshot frame{};
  frame.beams.resize(1);
  for (std::size_t i = 0; i < path.segments.size(); ++i)
    frame.beams[0].elements.push_back({.control_points = path.segments[i].points(),
                                       .s_start = path.breaks[i],
                                       .s_end = path.breaks[i + 1]});
  writer.write(frame);
  writer.finish();
  const std::string file = (directory.path() / "deformed.step").string();
  const CommandOutcome outcome =
      run_line({"export", directory.path().string(), "--time", "0 ms", "--to", file, "--unit", "inch"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "the time is stored";
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.curves.size(), 1u);
  EXPECT_EQ(report.curves[0].name, "cable");
  EXPECT_EQ(report.unit, "inch");
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(report.curves[0].curve.point(0.1 * i).norm(), 1, 1e-14);
}

TEST(CommandLine, ExportTellsBadInputFromWhatCannotBeWritten) {
  const test::TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), {{}, {}, {"cable"}}, "title");
  Snapshot frame{};
  frame.beams.resize(1);
  const BezierPath path = BezierPath::from_nurbs(quarter_circle(), 1e-9);
  frame.beams[0].elements = {{.control_points = path.segments[0].points(), .s_start = 0, .s_end = 1}};
  writer.write(frame);
  writer.finish();
  const auto code = [&](const std::string& results, const std::string& time, const std::string& file) {
    return run_line({"export", results, "--time", time, "--to", file}).code;
  };
  const std::string results = directory.path().string();
  EXPECT_EQ(code(results, "0", results + "/good.igs"), 0);
  EXPECT_EQ(code(results, "7", results + "/late.igs"), 2);
  EXPECT_EQ(code(results, "0", results + "/curve.obj"), 2);
  EXPECT_EQ(code(results + "/absent", "0", results + "/a.igs"), 2);
  EXPECT_EQ(code(results, "0", results + "/absent/a.igs"), 4);
}

}  // namespace
}  // namespace nurbeam
