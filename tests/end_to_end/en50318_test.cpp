#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::en50318_test {
namespace {

using Json = nlohmann::json;

// The collector's part of run.json, of the sample at a speed.
Json collector_at(const std::string& speed, const std::string& end_time) {
  const test::TemporaryDirectory directory;
  std::ostringstream out, err;
  const int code = run_command_line(
      {"run", test::sample("en50318/en50318.json").string(), "--quiet", "--out",
       (directory.path() / "r").string(), "--set", "collectors[0].motion.speed=" + speed, "--set",
       "analysis.end_time=" + end_time, "--set", "output.every=1", "--set", "output.report=false"},
      out, err);
  EXPECT_EQ(code, 0) << err.str();
  std::ifstream file(directory.path() / "r" / "run.json");
  const Json run = Json::parse(file);
  return run.at("collectors").at(0);
}

struct Range {
  double least, most;
};

void expect_in(const char* what, double value, Range range) {
  EXPECT_GE(value, range.least) << what;
  EXPECT_LE(value, range.most) << what;
}

struct Accepted {
  Range mean, deviation, mean_and_three, mean_less_three, greatest, least, uplift;
};

// EN 50318:2002, the reference model of 60 m spans: results up to 20 Hz while the collector is in spans 5
// and 6.
void expect_accepted(const Json& collector, const Accepted& ranges) {
  const Json& force = collector.at("force");
  EXPECT_EQ(force.at("frequencies [Hz]").at(1), 20);
  EXPECT_EQ(collector.at("evaluate [m]"), (Json{240, 360}));
  expect_in("mean", force.at("mean [N]"), ranges.mean);
  expect_in("deviation", force.at("standard deviation [N]"), ranges.deviation);
  expect_in("mean + 3 deviations", force.at("mean + 3 deviations [N]"), ranges.mean_and_three);
  expect_in("mean - 3 deviations", force.at("mean - 3 deviations [N]"), ranges.mean_less_three);
  expect_in("greatest", force.at("greatest [N]"), ranges.greatest);
  expect_in("least", force.at("least [N]"), ranges.least);
  EXPECT_EQ(collector.at("loss of contact").at("part of the time [%]"), 0);
  ASSERT_EQ(collector.at("uplift").size(), 3u);
  for (const Json& support : collector.at("uplift"))
    expect_in(support.at("probe").get<std::string>().c_str(), 1000 * support.at("value [m]").get<double>(),
              ranges.uplift);
}

TEST(En50318, IsMetAt250KilometresAnHour) {
  expect_accepted(collector_at("\"250 km/h\"", "5.184"), {.mean = {110, 120},
                                                          .deviation = {26, 31},
                                                          .mean_and_three = {190, 210},
                                                          .mean_less_three = {20, 40},
                                                          .greatest = {175, 210},
                                                          .least = {50, 75},
                                                          .uplift = {48, 55}});
}

TEST(En50318, IsMetAt300KilometresAnHour) {
  expect_accepted(collector_at("\"300 km/h\"", "4.32"), {.mean = {110, 120},
                                                         .deviation = {32, 40},
                                                         .mean_and_three = {210, 230},
                                                         .mean_less_three = {-5, 20},
                                                         .greatest = {190, 225},
                                                         .least = {30, 55},
                                                         .uplift = {55, 65}});
}

}  // namespace
}  // namespace nurbeam::en50318_test
