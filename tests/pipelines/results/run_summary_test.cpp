#include "pipelines/results/run_summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "pipelines/results/file_hash.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

TEST(FileHash, AgreesWithThePublishedTestVectors) {  // FIPS 180-2, appendix B, and the empty message
  const test::TemporaryDirectory directory;
  EXPECT_EQ(sha256_of_file(directory.write("a", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(directory.write("b", "")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_file(directory.write("c", std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(sha256_of_file(directory.path() / "absent"), std::runtime_error);
}

TEST(RunSummary, IsWrittenAsJsonWithUnits) {
  const test::TemporaryDirectory directory;
  RunSummary summary;
  summary.version = "1.2.3";
  summary.case_name = "name that is no UTF-8: \xff";
  summary.inputs = {{"case.json", "00ff"}};
  summary.status = "done";
  summary.wall_times.length_control = 0.25;
  summary.steps = 700;
  summary.energy_drift = std::numeric_limits<double>::quiet_NaN();
  RunEvent event;
  event.time = 0.5;
  event.kind = EventKind::merge;
  event.energy_after = 2;
  event.momentum_before = {1, 2, 3};
  summary.events = {event};
  summary.evidence = {{"torsion", {{"torsion-helix", 3, 2e-7, 4e-6, {"torsion"}}}}, {"snow", {}}};
  summary.diagnostics = {{Severity::warning, "case.json: output", "message"}};
  summary.files = {"histories.csv"};
  write_run_summary(directory.path() / "run.json", summary);

  std::ifstream stream(directory.path() / "run.json");
  const nlohmann::json json = nlohmann::json::parse(stream);
  EXPECT_EQ(json.at("nurbeam"), "1.2.3");
  EXPECT_EQ(json.at("inputs").at(0).at("sha256"), "00ff");
  EXPECT_EQ(json.at("wall_times [s]").at("length_control"), 0.25);
  EXPECT_EQ(json.at("steps"), 700);
  EXPECT_TRUE(json.at("energy_drift [J]").is_null());
  EXPECT_EQ(json.at("events").at(0).at("momentum_before [kg m/s]"), nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_TRUE(json.at("events").at(0).at("s [m]").is_null());
  EXPECT_EQ(json.at("evidence").at(0).at("problems").at(0).at("problem"), "torsion-helix");
  EXPECT_EQ(json.at("evidence").at(0).at("problems").at(0).at("least_error"), 2e-7);
  EXPECT_EQ(json.at("evidence").at(0).at("covered"), true);
  EXPECT_EQ(json.at("evidence").at(1).at("covered"), false);
  EXPECT_EQ(json.at("diagnostics").at(0).at("severity"), "warning");
  EXPECT_EQ(json.at("files"), nlohmann::json::array({"histories.csv"}));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "run.json.part"));
}

TEST(RunSummary, AFileThatCannotBeWrittenIsNamed) {
  EXPECT_THROW(write_run_summary("/proc/no/run.json", {}), std::runtime_error);
}

}  // namespace
}  // namespace nurbeam
