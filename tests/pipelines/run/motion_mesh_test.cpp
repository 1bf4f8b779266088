#include "pipelines/run/motion_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "fem/motion/run/simulation.h"
#include "pipelines/case/case_file.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {
namespace {

/// A rod that falls from level: straight, and so without a need of elements, where it starts.
CaseFile falling_rod(const std::string& elements,
                     const std::string& analysis = R"("end_time": 0.5, "step": 2e-3)") {
  CaseFileReport read = read_case_text(R"json({"nurbeam": 1, "gravity": [0, -9.81, 0],
    "beams": [{"name": "rod", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 1150, "youngs_modulus": 5e6}, "elements": )json" +
                                           elements + R"json(}],
    "supports": [{"beam": "rod", "at": "start", "type": "pinned"}],
    "analysis": {)json" + analysis + R"json(}, "output": {"every": 0.05}})json",
                                       "case.json");
  for (const Diagnostic& d : read.diagnostics)
    if (d.severity == Severity::error) ADD_FAILURE() << d.where << ": " << d.message;
  return std::move(*read.value);
}

/// Where the middle and the end are at the output times.
std::vector<Eigen::Vector3d> course_of(const CaseFile& c, const BuiltModel& built) {
  std::vector<Eigen::Vector3d> course;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& snapshot) {
    for (const ProbeRecord& probe : snapshot.probes) course.push_back(probe.position);
  };
  simulate(built.model, {{.beam = 0, .s = 0.5}, {.beam = 0, .s = 1}}, simulation_options(c), observer);
  return course;
}

double difference(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

TEST(MotionMesh, HoldsItsToleranceAgainstAFineRun) {
  const CaseFile fine = falling_rod(R"({"count": 96})");
  const auto known = course_of(fine, *build_model(fine).value);
  int elements = 0;
  for (const char* tolerance : {"1e-2", "1e-3", "1e-4"}) {
    const CaseFile c = falling_rod(std::string(R"({"over": "motion", "tolerance": )") + tolerance + "}");
    BuildReport report = build_model(c);
    const std::vector<Diagnostic> said = divide_for_motion(c, *report.value);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].severity, Severity::note) << said[0].message;
    EXPECT_NE(said[0].message.find("elements differ from twice as many by"), std::string::npos)
        << said[0].message;
    const double error = difference(course_of(c, *report.value), known);
    EXPECT_LT(error, std::stod(tolerance)) << tolerance;
    const int now = report.value->model.beams[0].home_intervals();
    EXPECT_GE(now, elements);
    EXPECT_LT(now, 96);
    elements = now;
  }
  EXPECT_GT(elements, 4);
}

TEST(MotionMesh, LeavesBeamsAloneThatDoNotAskForIt) {
  const CaseFile c = falling_rod(R"({"tolerance": 1e-4})");
  BuildReport report = build_model(c);
  const int before = report.value->model.beams[0].home_intervals();
  EXPECT_TRUE(divide_for_motion(c, *report.value).empty());
  EXPECT_EQ(report.value->model.beams[0].home_intervals(), before);
}

TEST(MotionMesh, EndsWhereItIsInterrupted) {
  const CaseFile c = falling_rod(R"({"over": "motion", "tolerance": 1e-6})");
  BuildReport report = build_model(c);
  EXPECT_TRUE(divide_for_motion(c, *report.value, [] { return true; }).empty());
}

TEST(MotionMesh, IsOfMotionsAlone) {
  const CaseFileReport read = read_case_text(
      R"json({"nurbeam": 1, "beams": [{"name": "rod", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]},
      "section": {"radius": 0.01}, "material": {"density": 1150, "youngs_modulus": 5e6},
      "elements": {"tolerance": 1e-3, "over": "motion"}}],
      "supports": [{"beam": "rod", "at": "start", "type": "clamped"}], "analysis": {"type": "static"}})json",
      "case.json");
  ASSERT_TRUE(read.value);
  const bool warned = std::any_of(read.diagnostics.begin(), read.diagnostics.end(), [](const Diagnostic& d) {
    return d.where == "case.json: beams[0].elements.over" && d.message.find("is of a motion") == 0;
  });
  EXPECT_TRUE(warned);
  BuildReport report = build_model(*read.value);
  EXPECT_TRUE(divide_for_motion(*read.value, *report.value).empty());
}

}  // namespace
}  // namespace nurbeam
