#include "pipelines/command/catenary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "pipelines/case/case_file.h"
#include "pipelines/command/command_line.h"
#include "pipelines/model/build_model.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam::catenary_test {
namespace {

struct Written {
  int code;
  std::string messages;
  std::optional<CaseFile> file;
  bool has_curves;
};

Written catenary(std::vector<std::string> words) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "line.json", curves = directory.path() / "wires.json";
  words.insert(words.begin(), {"catenary", file.string()});
  words.insert(words.end(), {"--curves", curves.string()});
  std::ostringstream out, err;
  Written written{run_command_line(words, out, err), {}, {}, false};
  written.messages = err.str();
  if (!std::filesystem::exists(file)) return written;
  CaseFileReport report = read_case_file(file);
  for (const Diagnostic& said : report.diagnostics)
    written.messages += said.where + ": " + said.message + "\n";
  written.file = std::move(report.value);
  written.has_curves = std::filesystem::exists(curves);
  return written;
}

TEST(Catenary, BecomesACaseThatIsAModel) {
  const Written line = catenary(
      {"--spans", "3x60,50", "--droppers", "5,17,30,43,55", "--element", "2", "--pantograph", "180 km/h"});
  ASSERT_EQ(line.code, 0) << line.messages;
  ASSERT_TRUE(line.file) << line.messages;
  EXPECT_TRUE(line.has_curves);
  const CaseFile& c = *line.file;
  ASSERT_EQ(c.connectors.size(), 20u);
  EXPECT_EQ(c.supports.size(), 7u);
  ASSERT_EQ(c.collectors.size(), 1u);
  EXPECT_NEAR(*c.collectors[0].motion.speed, 50, 1e-12);
  // In the last span, which is shorter, the droppers stand nearer together.
  EXPECT_NEAR(c.connectors[16].ends[0].at.value, 180 + 17 * 50 / 60.0, 1e-9);
  const BuildReport report = build_model(c);
  for (const Diagnostic& said : report.diagnostics) EXPECT_NE(said.severity, Severity::error) << said.message;
  ASSERT_TRUE(report.value);
  const BeamModel& model = report.value->model;
  EXPECT_EQ(model.dimension, 2);
  EXPECT_EQ(c.loads.size(), 3u);
  EXPECT_NEAR(c.loads[0].value.z(), 1.35 * 9.81 * 5, 1e-9);
  for (const auto& [beam, mass, tension, bending] :
       {std::tuple{0, 1.07, 16e3, 131.7}, std::tuple{1, 1.35, 20e3, 195.0}}) {
    const BeamProperties& p = model.beams[beam].properties;
    EXPECT_NEAR(p.mass_per_length, mass, 1e-9);
    EXPECT_NEAR(p.drawn_tension(), tension, 1e-6);
    EXPECT_NEAR(p.bending_stiffness, bending, 1e-6);
    EXPECT_NEAR(model.beams[beam].curve.length(), 230, 0.2);
  }
}

// A wire that is lower in the middle of its spans, and stands aside at its arms.
TEST(Catenary, DrawsThePreSagAndTheStagger) {
  CatenaryData data{
      .spans = {60, 60, 60}, .droppers = {10, 30, 50}, .pre_sag = 0.06, .stagger = 0.2, .arm = 1.2};
  check(data);
  EXPECT_NEAR(data.contact_at(30).z(), -0.06, 1e-15);
  EXPECT_NEAR(data.contact_at(30).y(), 0, 1e-15);
  EXPECT_NEAR(data.contact_at(60).z(), 0, 1e-15);
  EXPECT_NEAR(data.contact_at(60).y(), -0.2, 1e-15);
  EXPECT_NEAR(data.contact_at(120).y(), 0.2, 1e-15);
  EXPECT_NEAR(data.contact_at(75).z(), -4 * 0.06 * 0.25 * 0.75, 1e-15);

  const Written line = catenary({"--spans", "3x60", "--droppers", "10,30,50", "--pre-sag", "60 mm",
                                 "--stagger", "0.2", "--arm", "1.2", "--arm-mass", "1", "--element", "2"});
  ASSERT_TRUE(line.file) << line.messages;
  const BuildReport report = build_model(*line.file);
  for (const Diagnostic& said : report.diagnostics) EXPECT_NE(said.severity, Severity::error) << said.message;
  ASSERT_TRUE(report.value);
  EXPECT_EQ(report.value->model.dimension, 3);
  EXPECT_EQ(line.file->connectors.size(), 11u);
}

TEST(Catenary, RefusesDataThatAreNone) {
  const auto expect = [](const std::vector<std::string>& words, const std::string& part) {
    const Written line = catenary(words);
    EXPECT_EQ(line.code, 2) << line.messages;
    EXPECT_NE(line.messages.find(part), std::string::npos) << line.messages;
    EXPECT_FALSE(line.file);
  };
  expect({"--spans", "60", "--droppers", "10,70"}, "must be inside the first span");
  expect({"--spans", "60", "--droppers", "10,5"}, "places must increase");
  expect({"--spans", "0x60", "--droppers", "10,20"}, "is no number of spans");
  expect({"--spans", "60,0", "--droppers", "10,20"}, "each must be above 0 m");
  expect({"--spans", "60", "--droppers", "10,20", "--stagger", "0.2"}, "needs registration arms");
  expect({"--spans", "60", "--droppers", "10,20", "--dropper-lengths", "1"}, "1 lengths for 2");
  expect({"--spans", "60", "--droppers", "10,20", "--pantograph", "100 km/h"}, "needs two spans");
  expect({"--droppers", "10,20"}, "--spans");
  expect({"--spans", "60", "--droppers", "10"}, "hangs on two droppers");
}

}  // namespace
}  // namespace nurbeam::catenary_test
