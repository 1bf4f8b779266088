#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "pipelines/case/case_file.h"
#include "pipelines/run/run.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam::collectors_test {
namespace {

using std::numbers::pi;
using test::CaseRun;

constexpr double stiffness[] = {50, 4200}, damping[] = {90, 10}, masses[] = {15, 7.2}, contact = 50e3;

// A rigid guide z = A sin(2 pi x/l) over 15 s of travel, and a collector of two masses that presses on it
// from below.
std::string wavy_guide(double amplitude, double period, double speed, const std::string& end = "15",
                       const std::string& more = "") {
  const double length = std::ceil(speed * 15 / period + 1) * period;
  std::ostringstream points;
  points.precision(16);
  const int n = static_cast<int>(std::lround(length / period)) * 40;
  for (int i = 0; i <= n; ++i) {
    const double x = length * i / n;
    points << (i ? ", " : "") << "[" << x << ", 0, " << amplitude * std::sin(2 * pi * x / period) << "]";
  }
  std::ostringstream text;
  text.precision(16);
  text << R"({ "nurbeam": 1, "beams": [{ "name": "wire", "rigid": true, "axis": { "through": [)"
       << points.str()
       << R"(] } }], "collectors": [{ "name": "pan", "beam": "wire", "at": "start", "travel": [1, 0, 0],
         "up": [0, 0, 1], "motion": { "speed": )"
       << speed << R"( }, "masses": [15, 7.2], "stiffness": [50, 4200], "damping": [90, 10], "force": 120,
         "contact": { "stiffness": 50000 })"
       << more << R"( }], "analysis": { "initial": "equilibrium", "end_time": )" << end
       << R"(, "step": 1e-3 }, "output": { "every": 1, "report": false } })";
  return text.str();
}

// Mean and amplitude of the force over the last whole periods of about 2 s. Steps also end where the shoe
// crosses points of the guide: each counts as long as it is.
struct Force {
  double mean, amplitude;
};
Force last_force(const CaseRun& run, double period_in_time) {
  const double window = std::max(1.0, std::floor(2 / period_in_time)) * period_in_time,
               end = run.last("time [s]");
  std::complex<double> first = 0;
  double sum = 0;
  for (std::size_t i = 1; i < run.rows.size(); ++i) {
    const double t = run.value(i, "time [s]"), before = std::max(run.value(i - 1, "time [s]"), end - window);
    if (t <= before) continue;
    const double force = (run.value(i, "pan.force [N]") + run.value(i - 1, "pan.force [N]")) / 2;
    sum += force * (t - before);
    first += force * (t - before) * std::polar(1.0, -pi * (t + before) / period_in_time);
  }
  return {sum / window, 2 * std::abs(first) / window};
}

// The force amplitude of two masses on springs and dampers under a moved end, by their equations.
double amplitude_of_force(double amplitude, double omega) {
  using C = std::complex<double>;
  const C i(0, 1), k1 = stiffness[0] + i * omega * damping[0], k2 = stiffness[1] + i * omega * damping[1];
  const C a = k1 + k2 - masses[0] * omega * omega, d = k2 + contact - masses[1] * omega * omega;
  // [a, -k2; -k2, d] (z1, z2) = (0, k_c A)
  const C z2 = contact * amplitude * a / (a * d - k2 * k2);
  return std::abs(contact * (z2 - amplitude));
}

// Known answers of a solution at 1e-11; and the equations themselves.
TEST(Collectors, FollowAWavyGuideAsTheirEquationsSay) {
  struct Case {
    double length, amplitude, speed, force;
  };
  for (const Case& of : {Case{50, 0.01, 50, 10.920465}, Case{10, 0.003, 50, 5.431881},
                         Case{6.5, 0.001, 250 / 3.6, 63.545664}}) {
    const CaseRun run = test::run_text(wavy_guide(of.amplitude, of.length, of.speed));
    ASSERT_EQ(run.code, 0) << run.messages;
    const double period = of.length / of.speed;
    const Force found = last_force(run, period);
    EXPECT_NEAR(found.mean, 118.471158, 2e-3) << of.length;
    // Of second order in the step: 63 steps a period in the last case.
    EXPECT_NEAR(found.amplitude, of.force, 5e-3 * of.force) << of.length;
    EXPECT_NEAR(amplitude_of_force(of.amplitude, 2 * pi / period), of.force, 1e-6);
  }
}

// At rest on a level guide: the springs of both stages and the contact share the force.
TEST(Collectors, StartInEquilibriumWithContact) {
  const CaseRun run = test::run_text(wavy_guide(0, 10, 20, "0.5"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double mean = 120 / (1 + 50 * (1 / 4200.0 + 1 / 50e3));
  for (const std::size_t row : {std::size_t{0}, run.rows.size() - 1}) {
    EXPECT_NEAR(run.value(row, "pan.force [N]"), mean, 1e-7);
    EXPECT_NEAR(run.value(row, "pan.height [m]"), mean / 50e3, 1e-12);
    EXPECT_NEAR(run.value(row, "pan.mass_1.z [m]"), mean / 50e3 + mean / 4200, 1e-10);
  }
  EXPECT_GE(run.rows.size(), 501u);
  EXPECT_NEAR(run.last("pan.mass_2.x [m]"), 10, 1e-9);
  EXPECT_NEAR(run.last("pan.shoe.x [m]"), 10, 1e-9);
}

// The head leaves the wire where the mean force is less than the amplitude: 108.485 mm at 50 m and 50 m/s.
TEST(Collectors, LoseContactWhereTheWireTurnsAway) {
  const auto least = [](double amplitude) {
    const CaseRun run = test::run_text(wavy_guide(amplitude, 50, 50));
    double least = 1e9;
    for (std::size_t i = run.rows.size() - 1000; i < run.rows.size(); ++i)
      least = std::min(least, run.value(i, "pan.force [N]"));
    return least;
  };
  EXPECT_GT(least(0.104), 0);
  EXPECT_EQ(least(0.113), 0);
}

// Lift by the square of the speed, which a table ramps up; two collectors on one wire do not know of each
// other.
TEST(Collectors, AreLiftedByTheirSpeed) {
  const std::string second =
      R"( }, { "name": "other", "beam": "wire", "at": { "length": 40 }, "travel": [1, 0, 0],
    "masses": [10], "stiffness": [0], "force": 80, "motion": { "table": [[0, 0], [1, 5], [2, 20], [4, 60], [6, 100]] })";
  std::string text = wavy_guide(0, 10, 20, "4", second);
  text.replace(text.find("\"force\": 120"), 12,
               R"("force": { "per_speed_squared": 0.05, "offset": [[0, 100], [1, 100]] })");
  const CaseRun run = test::run_text(text);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("pan.force [N]"), (100 + 0.05 * 400) / (1 + 50 * (1 / 4200.0 + 1 / 50e3)), 0.05);
  EXPECT_NEAR(run.last("other.force [N]"), 80, 1e-6);
  EXPECT_NEAR(run.last("other.mass_1.x [m]"), 100, 1e-6);
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// In the middle of the window a run is interrupted, and goes on.
TEST(Collectors, HaveTheStatisticsOfAnUnbrokenRun) {
  const test::TemporaryDirectory directory;
  const auto file = directory.write("case.json", wavy_guide(0.003, 10, 50, "2", R"(, "evaluate": [20, 80])"));
  const CaseFileReport report = read_case_file(file);
  ASSERT_TRUE(report.value);
  const auto run = [&](const char* out, bool resume, long most_steps) {
    long asked = 0;
    std::ostringstream messages;
    RunOptions options{.out = directory.path() / out, .quiet = true, .resume = resume, .messages = &messages};
    options.interrupted = [&] { return ++asked > most_steps; };
    return run_case(*report.value, options);
  };
  constexpr long all = 1'000'000;
  EXPECT_EQ(run("whole", false, all), 0);
  EXPECT_EQ(run("cut", false, 900), 130);
  EXPECT_EQ(run("cut", true, all), 0);
  const auto outcome = [&](const char* out) {
    return nlohmann::json::parse(content_of(directory.path() / out / "run.json")).at("collectors");
  };
  EXPECT_GT(outcome("whole").at(0).at("samples"), 1000);
  EXPECT_EQ(outcome("cut"), outcome("whole"));
  EXPECT_EQ(content_of(directory.path() / "cut" / "histories.csv"),
            content_of(directory.path() / "whole" / "histories.csv"));
}

TEST(Collectors, RefuseWhatMeansNothing) {
  const auto messages = [](const std::string& key, const std::string& value) {
    const CaseRun run = test::run_text(wavy_guide(0, 10, 20, "0.5"), {"collectors[0]." + key + "=" + value});
    EXPECT_EQ(run.code, 2) << key;
    return run.messages;
  };
  const auto expect = [&](const std::string& key, const std::string& value, const std::string& part) {
    EXPECT_NE(messages(key, value).find(part), std::string::npos) << messages(key, value);
  };
  expect("stiffness", "[50]", "has 1 values for 2 \"masses\"");
  expect("stiffness", "[50, 0]", "nothing lifts the mass above");
  expect("damping", "[1, 2, 3]", "has 3 values for 2 \"masses\"");
  expect("up", "[1, 0, 1]", "is not across \"travel\"");
  expect("travel", "[0, 0, 0]", "give a direction");
  expect("force_on", "3", "must be at most 2");
  expect("evaluate", "[5, 2]", "from < to");
  expect("uplift", "[\"nowhere\"]", "there is no probe \"nowhere\"");
  expect("motion", R"({"speed": 2000})", "beyond the end of beam \"wire\"");
  expect("motion", R"({"table": [[0, 0], [0.1, 2]]})", "before analysis.end_time");
  expect("motion", R"({"table": [[0, 1], [1, 2]]})", "must begin with [0, 0]");
  expect("beam", "\"wires\"", "there is no beam \"wires\"");
}

}  // namespace
}  // namespace nurbeam::collectors_test
