#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

using std::numbers::pi;

/// A cantilever of 2 m along x, round, of steel; what comes behind its supports is `rest`.
std::string cantilever_case(const std::string& analysis, const std::string& rest = "") {
  return R"({ "nurbeam": 1,
  "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": "1 cm" },
              "material": { "density": 7850, "youngs_modulus": "210 GPa" }, "torsion": true }],
  "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }],)" +
         rest + R"("analysis": )" + analysis + R"(, "output": { "paraview": true } })";
}

/// What a run leaves in its directory.
struct Left {
  int code;
  std::string messages, table;
  nlohmann::json run;
  TemporaryDirectory directory;
};

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void run_modes_text(const std::string& text, Left& left) {
  const auto results = left.directory.path() / "results";
  std::ostringstream out, err;
  const CapturedErrors errors;
  left.code = run_command_line(
      {"run", left.directory.write("case.json", text).string(), "--out", results.string()}, out, err);
  left.messages = err.str() + errors.text();
  left.table = text_of_file(results / "modes.csv");
  if (std::filesystem::exists(results / "run.json"))
    left.run = nlohmann::json::parse(text_of_file(results / "run.json"));
}

/// Of each mode in a list of the summary.
std::vector<double> numbers_of(const Left& left, const char* list, const char* key) {
  EXPECT_EQ(left.code, 0) << left.messages;
  std::vector<double> numbers;
  if (left.code == 0)
    for (const auto& mode : left.run[list]) numbers.push_back(mode[key].get<double>());
  return numbers;
}

/// A bar of steel, 2 m long and 100 mm thick, on two springs across it and one along it.
std::string bar_on_springs(int elements) {
  std::string springs;
  for (const auto& [at, from] :
       {std::pair{"start", "[0, 0, -1]"}, {"end", "[2, 0, -1]"}, {"start", "[-1, 0, 0]"}})
    springs += (springs.empty() ? R"({"name": "s)" : R"(,{"name": "s)") + std::to_string(springs.size()) +
               R"(", "from": {"point": )" + from + R"(}, "to": {"beam": "bar", "at": ")" + at +
               R"("}, "type": "spring", "stiffness": 100})";
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.05 },
              "material": { "density": 7850, "youngs_modulus": "210 GPa" }, "elements": { "count": )" +
         std::to_string(elements) + R"( } }],
  "connectors": [)" +
         springs + R"(],
  "analysis": { "type": "modes", "modes": { "count": 4, "about": "drawn" } } })";
}

TEST(Modes, ThatAreLostInRoundOffAreTold) {
  Left few, many, most;
  run_modes_text(bar_on_springs(20), few);
  const std::vector<double> right = numbers_of(few, "modes", "frequency [Hz]");
  ASSERT_GE(right.size(), 3u);
  EXPECT_GT(right[0], 0.1);
  EXPECT_EQ(few.messages.find("round-off"), std::string::npos) << few.messages;
  run_modes_text(bar_on_springs(200), many);
  const std::vector<double> still = numbers_of(many, "modes", "frequency [Hz]");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(still.at(i), right[i], 0.02 * right[i]) << i;
  run_modes_text(bar_on_springs(2000), most);
  EXPECT_NE(most.messages.find("need not be a rigid motion"), std::string::npos) << most.messages;
}

TEST(Modes, OfACantileverAreInTheTableTheSummaryAndTheFrames) {
  Left left;
  run_modes_text(cantilever_case(R"({ "type": "modes", "modes": { "count": 5 } })"), left);
  ASSERT_EQ(left.code, 0) << left.messages;
  ASSERT_EQ(left.run["modes"].size(), 5u);
  const double omega =
      std::pow(1.87510407 / 2, 2) * std::sqrt(210e9 / 7850) * 0.005;  // under its own weight:
  EXPECT_NEAR(left.run["modes"][0]["frequency [Hz]"].get<double>(), omega / (2 * pi), 1e-3 * omega);
  EXPECT_NEAR(left.run["modes"][1]["frequency [Hz]"].get<double>(), omega / (2 * pi), 1e-3 * omega);
  EXPECT_NEAR(left.run["mass [kg]"].get<double>(), 7850 * pi * 1e-4 * 2, 1e-9);
  EXPECT_EQ(left.table.substr(0, 33), "number,frequency [Hz],period [s],");
  EXPECT_NE(left.messages.find("mode 1: "), std::string::npos);
  const auto results = left.directory.path() / "results";
  for (const char* file : {"results.nc", "report.html", "frames.pvd", "mode_1.pvd", "mode_5.pvd"})
    EXPECT_TRUE(std::filesystem::exists(results / file)) << file;
  std::ostringstream out, err;
  const auto shape = left.directory.path() / "shape.step";
  EXPECT_EQ(run_command_line({"export", results.string(), "--time", "3", "--to", shape.string()}, out, err),
            0)
      << err.str();
  // Another run clears away what this one left.
  const auto again = left.directory.write(
      "again.json", cantilever_case(R"({ "type": "modes", "modes": { "count": 1, "about": "drawn" } })"));
  const CapturedErrors quiet;
  EXPECT_EQ(run_command_line({"run", again.string(), "--quiet", "--out", results.string()}, out, err), 0);
  EXPECT_FALSE(std::filesystem::exists(results / "mode_5.pvd"));
  EXPECT_FALSE(std::filesystem::exists(results / "frames" / "mode_5_beams_000000.vtu"));
}

/// A disc on the end of a shaft of steel; `more` of the disc.
std::string disc_on_a_shaft(const std::string& more, const std::string& modes) {
  return cantilever_case(
      R"({ "type": "modes", "modes": )" + modes + " }",
      R"("gravity": [0, 0, 0], "bodies": [{ "name": "disc", "mass": 4, "position": [2, 0, 0], "inertia": [0.05, 0.03, 0.03])" +
          more +
          R"( }], "joints": [{ "between": [{ "body": "disc" }, { "beam": "bar", "at": "end" }], "type": "rigid" }],)");
}

TEST(ModesOverSpeed, AreThoseOfEachSpeedAndMeetItAtCriticalSpeeds) {
  const auto spins = [](double speed) {
    return R"(, "rotor": { "axis": [1, 0, 0], "inertia": 0.05, "speed": )" + std::to_string(speed) + " }";
  };
  Left over;
  run_modes_text(disc_on_a_shaft(spins(3), R"({ "count": 4, "speeds": ["0 rad/s", 4, 9, 100] })"), over);
  ASSERT_EQ(over.code, 0) << over.messages;
  const auto& table = over.run["modes_over_speed"];
  ASSERT_EQ(table["lines"].size(), 4u);
  EXPECT_EQ(table["lines"][0]["name"], "backward 1");
  EXPECT_EQ(table["lines"][3]["name"], "forward 2");
  Left at_9;
  run_modes_text(disc_on_a_shaft(spins(9), R"({ "count": 4 })"), at_9);
  const std::vector<double> modes = numbers_of(at_9, "modes", "frequency [Hz]");
  for (const auto& [line, mode] : {std::pair{0, 0}, {2, 1}, {1, 2}, {3, 3}})
    EXPECT_NEAR(table["lines"][line]["frequency [Hz]"][2].get<double>(), modes.at(mode), 1e-9) << line;
  ASSERT_GE(table["critical_speeds"].size(), 2u);
  const double critical = table["critical_speeds"][1]["speed [rad/s]"];
  EXPECT_EQ(table["critical_speeds"][0]["line"], "backward 1");
  EXPECT_EQ(table["critical_speeds"][1]["line"], "forward 1");
  EXPECT_NE(over.messages.find("critical speed: "), std::string::npos) << over.messages;
  Left there;
  run_modes_text(disc_on_a_shaft(spins(critical), R"({ "count": 4 })"), there);
  EXPECT_NEAR(2 * pi * numbers_of(there, "modes", "frequency [Hz]").at(1), critical, 1e-5 * critical);
  const std::string file = text_of_file(over.directory.path() / "results" / "speeds.csv");
  EXPECT_TRUE(file.starts_with("speed [rad/s],backward 1 [Hz],")) << file;
  EXPECT_EQ(std::ranges::count(file, '\n'), 5);
}

TEST(ModesOverSpeed, AreRefusedWhereNothingTurns) {
  const std::string rotor = R"(, "rotor": { "axis": [1, 0, 0], "inertia": 0.05, "speed": 3 })";
  for (const auto& [more, speeds, said] :
       {std::array<std::string, 3>{"", "[0, 1]", "analysis.modes.speeds: has nothing that turns"},
        {rotor, "[2, 1]", "analysis.modes.speeds[1]: is 1 after 2"},
        {rotor, "[1]", "analysis.modes.speeds"}}) {
    Left left;
    run_modes_text(disc_on_a_shaft(more, R"({ "speeds": )" + speeds + " }"), left);
    EXPECT_EQ(left.code, 2);
    EXPECT_NE(left.messages.find(said), std::string::npos) << left.messages;
  }
}

// One element of a planar cantilever: its end has two coordinates of place and two of slope.
TEST(Modes, OfWhichThereAreFewerThanAskedForAreCounted) {
  Left left;
  run_modes_text(R"({ "nurbeam": 1, "gravity": [0, -9.81, 0],
    "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": "1 cm" },
                "material": "steel", "elements": { "count": 1 } }],
    "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }],
    "analysis": { "type": "modes", "modes": { "count": 50 } }, "output": { "report": false } })",
                 left);
  ASSERT_EQ(left.code, 0) << left.messages;
  const std::size_t found = left.run["modes"].size();
  EXPECT_LT(found, 50u);
  const std::string note = "note: " + (left.directory.path() / "case.json").string() +
                           ": analysis.modes.count: is 50, and there are " + std::to_string(found) + " modes";
  EXPECT_NE(left.messages.find(note), std::string::npos) << left.messages;
}

// On a stiff hanging arc it is a pendulum, wherever it was drawn: of half of them its mode was missing.
TEST(Modes, OfABeadThatSlidesAreFoundWhereverItIsDrawn) {
  for (const char* at : {"0.1", "0.35", "0.4", "0.45", "0.55", "0.7"}) {
    Left left;
    run_modes_text(std::string(R"({ "nurbeam": 1,
      "beams": [{ "name": "b", "axis": { "arc": { "center": [0, 0, 0], "start": [-1.7, 0, 0], "end": [1.7, 0, 0],
                                                   "normal": [0, -1, 0] } },
                  "section": { "radius": 0.05 }, "material": { "density": 7800, "youngs_modulus": 2.1e11 },
                  "elements": { "count": 20 } }],
      "supports": [{ "beam": "b", "at": "start", "type": "clamped" }, { "beam": "b", "at": "end", "type": "clamped" }],
      "bodies": [{ "name": "m", "mass": 1 }],
      "sliding_joints": [{ "body": "m", "beam": "b", "at": { "fraction": )") +
                       at + R"( } }],
      "analysis": { "type": "modes", "modes": { "count": 3, "bodies": "free" } }, "output": { "report": false } })",
                   left);
    ASSERT_EQ(left.code, 0) << left.messages;
    EXPECT_NEAR(left.run["modes"][0]["frequency [Hz]"].get<double>(), std::sqrt(9.81 / 1.7) / (2 * pi), 1e-4)
        << at;
    EXPECT_NE(left.messages.find("the model lies in a plane"), std::string::npos) << left.messages;
  }
}

/// The lowest frequency [Hz], or the first factor, of a bead of 0.5 kg that slides on a rigid half circle of
/// 2 m radius, with what else its joint and the case say; what is said of it.
std::pair<double, std::string> bead_in_half_circle(const std::string& joint, const std::string& rest = "",
                                                   const std::string& type = "modes") {
  Left left;
  run_modes_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "d", "axis": { "polyline": [[0, 3, 0], [0.1, 3, 0]] }, "section": { "radius": 0.02 },
                  "material": "steel", "elements": { "count": 2 } },
                { "name": "r", "rigid": true, "axis": { "arc": { "center": [0, 0, 0], "start": [-2, 0, 0],
                                                                  "end": [2, 0, 0], "normal": [0, -1, 0] } } }],
      "supports": [{ "beam": "d", "at": "start", "type": "clamped" }],
      "bodies": [{ "name": "m", "mass": 0.5 }],
      "sliding_joints": [{ "body": "m", "beam": "r", "at": { "fraction": 0.3 })" +
                     joint + "}]," + rest + R"(
      "analysis": { "type": ")" +
                     type +
                     R"(", "modes": { "count": 1, "bodies": "free" } }, "output": { "report": false } })",
                 left);
  EXPECT_EQ(left.code, 0) << left.messages;
  if (left.code != 0) return {0, left.messages};
  const nlohmann::json& first = left.run[type][0];
  return {first[type == "modes" ? "frequency [Hz]" : "factor"].get<double>(), left.messages};
}

TEST(Modes, OfABeadThatSlidesAreWithoutFrictionAndRelease) {
  const double pendulum = std::sqrt(9.81 / 2) / (2 * pi);
  for (const char* held : {R"(, "friction": { "coefficient": 0.5 })", R"(, "release": 1)"}) {
    const auto [frequency, messages] = bead_in_half_circle(held);
    EXPECT_NEAR(frequency, pendulum, 1e-6 * pendulum) << held;
    EXPECT_NE(messages.find("has no effect on modes and buckling"), std::string::npos) << messages;
  }
}

// A pressed buffer, 0.1 pi before the bottom, is a spring: k e = m g sin(a) with the bead at the angle a.
TEST(Modes, OfABeadAtAStopAreWhatIsSaidOfIt) {
  const double k = 100, m = 0.5, R = 2;
  double a = 0.1 * pi;
  for (int i = 0; i < 50; ++i) a = 0.1 * pi - m * 9.81 * std::sin(a) / k / R;
  const double on_buffer = std::sqrt(k / m + 9.81 * std::cos(a) / R) / (2 * pi);
  const auto [frequency, messages] =
      bead_in_half_circle("", R"("stops": [{ "beam": "r", "at": { "fraction": 0.4 }, "stiffness": 100 }],)");
  EXPECT_NEAR(frequency, on_buffer, 1e-6 * on_buffer);
  EXPECT_EQ(messages.find("stops[0]"), std::string::npos) << messages;
  const auto [held, note] =
      bead_in_half_circle("", R"("stops": [{ "beam": "r", "at": { "fraction": 0.4 } }],)");
  EXPECT_GT(held, 1000);  // of the beam beside it
  EXPECT_NE(note.find("stops[0]: holds what rests against it"), std::string::npos) << note;
}

// One that rests against a stop is held in the state with the loads too.
TEST(Buckling, IsFoundWhereABodyRestsAgainstAStop) {
  const std::string load = R"("loads": [{ "beam": "d", "at": "end", "force": [-1, 0, 0] }],)",
                    stop = R"("stops": [{ "beam": "r", "at": { "fraction": 0.4 } }],)";
  const double alone = bead_in_half_circle("", load, "buckling").first;
  EXPECT_NEAR(bead_in_half_circle("", load + stop, "buckling").first, alone, 1e-9 * alone);
}

TEST(Buckling, OfACantileverGivesTheFactorOfItsLoad) {
  const double EI = 210e9 * pi * 1e-8 / 4, euler = pi * pi * EI / 16;
  Left left;
  run_modes_text(
      cantilever_case(
          R"({ "type": "buckling", "modes": { "count": 2 } })",
          R"("gravity": [0, 0, 0], "loads": [{ "beam": "bar", "at": "end", "force": [-100, 0, 0] }],)"),
      left);
  ASSERT_EQ(left.code, 0) << left.messages;
  EXPECT_NEAR(left.run["buckling"][0]["factor"].get<double>(), euler / 100, 1e-4 * euler / 100);
  EXPECT_EQ(left.table.substr(0, 13), "number,factor");
}

/// The factor on a thrust of 1 N at the end of a bar of 2 m between a pin and a guide, where something pulls.
double factor_of_pulled_bar(const std::string& guide, const std::string& rest, double gravity = 0) {
  Left left;
  run_modes_text(R"({ "nurbeam": 1, "gravity": [0, )" + std::to_string(-gravity) +
                     R"(, 0],
      "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.01 },
                  "material": { "density": 7800, "youngs_modulus": 2e11 }, "elements": { "count": 16 } }],
      "supports": [{ "beam": "bar", "at": "start", "type": "pinned" },
                   { "beam": "bar", "at": "end", "type": "guided", "direction": [1, 0, 0])" +
                     guide + R"( }],
      "loads": [{ "beam": "bar", "at": "end", "force": [-1, 0, 0] }],)" +
                     rest + R"(
      "analysis": { "type": "buckling", "modes": { "count": 1 } }, "output": { "report": false } })",
                 left);
  EXPECT_EQ(left.code, 0) << left.messages;
  return left.code == 0 ? left.run["buckling"][0]["factor"].get<double>() : 0;
}

const double euler_of_pulled_bar = pi * pi * 2e11 * pi * 1e-8 / 4 / 4;

// A spring of 1000 N/m and 0.5 m over the metre between the end and a wall: its force is there before the
// load.
TEST(Buckling, DoesNotMultiplyWhatAConnectorPullsAnyway) {
  for (const char* length : {R"("force": 500)", R"("length": 0.5)"})
    EXPECT_NEAR(factor_of_pulled_bar("", std::string(R"("connectors": [{ "name": "k", "type": "spring",
      "from": { "beam": "bar", "at": "end" }, "to": { "point": [3, 0, 0] }, "stiffness": 1000,)") +
                                             length + "}],"),
                euler_of_pulled_bar + 500, 1)
        << length;
}

// With what it is held up by it stands as drawn, a column half of whose length counts.
TEST(Buckling, HasConnectorsAsLongAsTheyAreFoundUnderGravity) {
  EXPECT_NEAR(
      factor_of_pulled_bar("", R"("connectors": [{ "name": "k", "type": "spring", "length": "as-drawn",
      "from": { "beam": "bar", "at": { "fraction": 0.5 } }, "to": { "point": [1, 1, 0] }, "stiffness": 1e7 }],)",
                           9.81),
      4 * euler_of_pulled_bar, 0.01 * euler_of_pulled_bar);
}

TEST(Buckling, DoesNotMultiplyWhatAGuidedSupportPulls) {
  EXPECT_NEAR(factor_of_pulled_bar(R"(, "force": 500)", ""), euler_of_pulled_bar + 500, 1);
}

// A lump of 10 kg on a light column, whose weight is 98.1 N of its load.
TEST(Buckling, DoesNotMultiplyTheWeightOfLumps) {
  Left left;
  run_modes_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [0, 0, 2]] }, "section": { "radius": 0.01 },
                  "material": { "density": 1, "youngs_modulus": 2e11 }, "elements": { "count": 16 } }],
      "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }],
      "connectors": [{ "name": "k", "from": { "beam": "bar", "at": "end" }, "end_masses": [10, 0], "to": { "point": [0, 0, 3] },
                       "direction": [0, 0, 1], "stiffness": 1e-6 }],
      "loads": [{ "beam": "bar", "at": "end", "force": [0, 0, -1] }],
      "analysis": { "type": "buckling", "modes": { "count": 1 } }, "output": { "report": false } })",
                 left);
  ASSERT_EQ(left.code, 0) << left.messages;
  EXPECT_NEAR(left.run["buckling"][0]["factor"].get<double>(), euler_of_pulled_bar / 4 - 98.1, 0.5);
}

// Differences of a stiff bar that lies askew left less of the symmetry than was asked for, and how far the
// loads may be multiplied was told by components of its way.
TEST(Buckling, OfABarThatLiesAskewIsThatOfOneAlongAnAxis) {
  const auto buckle = [](const Eigen::Vector3d& load, const Eigen::Matrix3d& turn, Left& left) {
    const auto text = [&](const Eigen::Vector3d& v) {
      const Eigen::Vector3d turned = turn * v;
      return nlohmann::json{turned[0], turned[1], turned[2]}.dump();
    };
    run_modes_text(
        R"({ "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], )" +
            text({3, 0, 0}) + R"(] }, "elements": { "count": 24 },
                  "torsion": true, "section": { "rectangle": [0.02, 0.05] }, "orientation": { "up": )" +
            text({0.1, 0.3, 1}) + R"( },
                  "material": { "density": 7800, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3 } }],
      "supports": [{ "beam": "b", "at": "start", "type": "clamped" },
                   { "beam": "b", "at": { "fraction": 0.267 }, "type": "pinned" }],
      "loads": [{ "beam": "b", "force_per_length": )" +
            text(load) + R"( }],
      "analysis": { "type": "buckling", "modes": { "count": 3 } }, "output": { "report": false } })",
        left);
  };
  const auto factors = [&](const Eigen::Matrix3d& turn) {
    Left left;
    buckle({-900, 17, -12}, turn, left);
    return numbers_of(left, "buckling", "factor");
  };
  // What bends it by its own size before it buckles is no load that has no energy.
  const auto bends = [&](const Eigen::Matrix3d& turn) {
    Left left;
    buckle({-9, 17, -12}, turn, left);
    EXPECT_EQ(left.code, 3);
    EXPECT_NE(left.messages.find("nothing buckles under the loads"), std::string::npos) << left.messages;
  };
  bends(Eigen::Matrix3d::Identity());
  const std::vector<double> along = factors(Eigen::Matrix3d::Identity());
  ASSERT_FALSE(along.empty());
  for (const double angle : {0.3, 1.0, 2.0}) {
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, -2, 3).normalized());
    bends(turn.toRotationMatrix());
    const std::vector<double> askew = factors(turn.toRotationMatrix());
    ASSERT_EQ(askew.size(), along.size()) << angle;
    for (std::size_t i = 0; i < along.size(); ++i)
      EXPECT_NEAR(askew[i], along[i], 1e-5 * std::abs(along[i])) << angle;
  }
}

/// Beams without weight and what else there is; its factors.
std::vector<double> factors_of(const std::string& rest) {
  Left left;
  run_modes_text(
      R"({ "nurbeam": 1, "gravity": [0, 0, 0], "analysis": { "type": "buckling", "modes": { "count": 2 } },
      "output": { "report": false }, )" +
          rest + "}",
      left);
  return numbers_of(left, "buckling", "factor");
}
const std::string steel =
    R"("material": { "density": 7800, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3 })";

// The stiffness of a spring that turns as the load bends the column is no load: it is that of a bar that is
// pinned in its place.
TEST(Buckling, HasConnectorsThatTurnAsBarsThatDo) {
  const std::string column = R"({ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, 2]] },
      "section": { "rectangle": [0.02, 0.02] }, "elements": { "count": 12 }, )" +
                             steel + "}",
                    clamp = R"({ "beam": "b", "at": "start", "type": "clamped" })";
  const std::string load = R"("loads": [{ "beam": "b", "at": "end", "force": [200, 0, -500] }])";
  const std::vector<double> spring = factors_of(
      R"("beams": [)" + column + R"(], "supports": [)" + clamp +
      R"(], "connectors": [{ "name": "k", "from": { "beam": "b", "at": "end" }, "to": { "point": [0, 0, 3] },
             "stiffness": 1e6 }], )" +
      load);
  const std::vector<double> bar = factors_of(
      R"("beams": [)" + column + R"(, { "name": "k", "axis": { "polyline": [[0, 0, 2], [0, 0, 3]] },
          "section": { "area": 4.761904761904762e-6, "second_moment": 1e-5 }, "elements": { "count": 1 }, )" +
      steel + R"(}], "joints": [{ "beams": ["b", "k"], "type": "hinged" }], "supports": [)" + clamp +
      R"(, { "beam": "k", "at": "end", "type": "pinned" }], )" + load);
  ASSERT_EQ(spring.size(), 1u);
  ASSERT_EQ(bar.size(), 1u);
  EXPECT_NEAR(spring[0], bar[0], 1e-6 * bar[0]);
  EXPECT_NEAR(spring[0], 3.6785, 1e-4);
}

// Stays that are tight carry either way, however little that is.
TEST(Buckling, HasTightStaysAsSprings) {
  const auto factors = [](const std::string& type) {
    const auto stay = [&](const std::string& name, const std::string& x) {
      return R"({ "name": ")" + name + R"(", "from": { "beam": "b", "at": "end" }, "to": { "point": [)" + x +
             R"(, 0, 0] }, "stiffness": 2e5, "type": ")" + type + R"(", "force": 500 })";
    };
    return factors_of(R"("beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, 10]] },
          "section": { "area": 0.01, "second_moment": 8.33e-6 }, "elements": { "count": 16 }, )" +
                      steel + R"(}], "supports": [{ "beam": "b", "at": "start", "type": "pinned" }],
        "loads": [{ "beam": "b", "at": "end", "force": [3, 0, -10] }], "connectors": [)" +
                      stay("left", "-5") + ", " + stay("right", "5") + "]");
  };
  const std::vector<double> ropes = factors("tension-only"), springs = factors("spring");
  ASSERT_EQ(ropes.size(), springs.size());
  for (std::size_t i = 0; i < ropes.size(); ++i) EXPECT_NEAR(ropes[i], springs[i], 1e-9 * springs[i]);
}

// The rod carries it all: P d turns the end sideways, 3 EI/L^3 turns it back.
TEST(Buckling, IsThatOfALoadThatARodCarries) {
  const std::vector<double> factors = factors_of(
      R"("beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
          "section": { "area": 4e-4, "second_moments": [1.3e-8, 1.3e-9], "torsion_constant": 2e-9 },
          "orientation": { "up": [0, 0, 1] }, "elements": { "count": 12 }, )" +
      steel + R"(}], "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
      "loads": [{ "beam": "b", "at": "end", "force": [0, 0, -1] }],
      "connectors": [{ "name": "strut", "type": "rod", "from": { "beam": "b", "at": "end" },
                       "to": { "point": [1, 0, -0.7] } }])");
  ASSERT_FALSE(factors.empty());
  EXPECT_NEAR(factors[0], 3 * 2.1e11 * 1.3e-9 * 0.7, 1e-4 * factors[0]);
}

// Two rods hold a beam on them upright, as far as a spring does: P = k l/2, whatever the loads are beside
// that.
TEST(Buckling, OfLoadsThatRodsCarryIsInProportionToThem) {
  for (const double load : {1.0, 1e-3, 1e-6}) {
    std::ostringstream text;
    text << R"("beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
        "section": { "area": 0.01, "second_moment": 1e-4 }, "elements": { "count": 4 }, )"
         << steel << R"(}], "loads": [{ "beam": "b", "at": "start", "force": [0, 0, )" << -load << R"(] },
        { "beam": "b", "at": "end", "force": [0, 0, )"
         << -load << R"(] }], "connectors": [
        { "name": "left", "type": "rod", "from": { "beam": "b", "at": "start" }, "to": { "point": [0, 0, -1.5] } },
        { "name": "right", "type": "rod", "from": { "beam": "b", "at": "end" }, "to": { "point": [1, 0, -1.5] } },
        { "name": "spring", "from": { "beam": "b", "at": "end" }, "to": { "point": [2, 0, 0] }, "stiffness": 2000 }])";
    const std::vector<double> factors = factors_of(text.str());
    ASSERT_FALSE(factors.empty());
    EXPECT_NEAR(factors[0] * load, 2000 * 1.5 / 2, 1e-2) << load;
  }
}

// Wind across the weight turns the way in which a strut without torsion is bent, and no stiffness with it.
TEST(Buckling, OfAStrutInAWindIsEulers) {
  const auto strut = [](const std::string& loads, Left& left) {
    run_modes_text(R"({ "nurbeam": 1, "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] },
        "section": { "radius": 0.01 }, "elements": { "count": 16 }, )" +
                       steel + R"(}],
      "supports": [{ "beam": "b", "at": "start", "type": "pinned" },
                   { "beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0] }],
      "loads": [)" + loads +
                       R"({ "beam": "b", "force_per_length": [0, 10, 0] }],
      "analysis": { "type": "buckling", "modes": { "count": 1 } }, "output": { "report": false } })",
                   left);
  };
  Left left, wind;
  strut(R"({ "beam": "b", "at": "end", "force": [-1000, 0, 0] }, )", left);
  ASSERT_EQ(left.code, 0) << left.messages;
  const double euler = pi * pi * 2.1e11 * pi * 1e-8 / 4 / 4;
  EXPECT_NEAR(left.run["buckling"][0]["factor"].get<double>(), euler / 1000, 2e-3);
  strut("", wind);
  EXPECT_EQ(wind.code, 3) << wind.messages;
}

// What strains itself, and without a load has no stress, has no part in what loads do.
TEST(Buckling, AboutTheDrawingOfWhatExpandsIsEulers) {
  for (const char* strain : {"", R"("temperature": 10, )", R"("unstressed_length": 1.0001, )"}) {
    Left left;
    run_modes_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "b", )" +
                       std::string(strain) +
                       R"("axis": { "polyline": [[0, 0, 0], [0, 0, 1]] }, "section": { "radius": 0.005 },
        "material": { "density": 7800, "youngs_modulus": 2.1e11, "thermal_expansion": 1e-5 },
        "elements": { "count": 12 } }],
      "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
      "loads": [{ "beam": "b", "at": "end", "force": [0, 0, -1] }],
      "analysis": { "type": "buckling", "modes": { "count": 1, "about": "drawn" } },
      "output": { "report": false } })",
                   left);
    ASSERT_EQ(left.code, 0) << left.messages;
    const double euler = pi * pi / 4 * 2.1e11 * pi / 4 * std::pow(0.005, 4);
    EXPECT_NEAR(left.run["buckling"][0]["factor"].get<double>(), euler, 1e-3 * euler) << strain;
  }
}

// What a drawing says of a connector is its force, which gives its length.
TEST(Modes, AboutTheDrawingHaveTheForcesOfConnectors) {
  const auto frequencies = [](const std::string& length) {
    Left left;
    run_modes_text(cantilever_case(R"({ "type": "modes", "modes": { "count": 3, "about": "drawn" } })",
                                   R"("connectors": [{ "name": "p", "from": { "beam": "bar", "at": "end" },
          "to": { "point": [2, 0.5, 0] }, "stiffness": 2e4, "type": "tension-only", )" +
                                       length + "}],"),
                   left);
    return numbers_of(left, "modes", "frequency [Hz]");
  };
  const std::vector<double> by_force = frequencies(R"("force": 500)"),
                            by_length = frequencies(R"("length": 0.475)");
  ASSERT_EQ(by_force.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(by_force[i], by_length[i], 1e-9 * by_length[i]);
}

// A load that hangs on a stiff spring swings as drawn without weight: round-off of that was a growing motion.
TEST(Modes, OfFreeMotionsBesideStiffOnesAreZero) {
  for (const char* stiffness : {"300", "3e5"})
    for (const int count : {4, 8, 12}) {
      Left left;
      run_modes_text(cantilever_case(R"({ "type": "modes", "modes": { "about": "drawn", "count": )" +
                                         std::to_string(count) + "}}",
                                     R"("bodies": [{ "name": "h", "mass": 2, "position": [2, 0, -1] }],
          "connectors": [{ "name": "k", "from": { "beam": "bar", "at": "end" }, "to": { "body": "h" },
                           "stiffness": )" +
                                         std::string(stiffness) + "}],"),
                     left);
      ASSERT_EQ(left.code, 0) << left.messages;
      EXPECT_EQ(left.run["modes"][0]["frequency [Hz]"].get<double>(), 0);
      EXPECT_EQ(left.run["modes"][1]["frequency [Hz]"].get<double>(), 0);
      EXPECT_GT(left.run["modes"][2]["frequency [Hz]"].get<double>(), 1);
    }
}

TEST(Modes, ThatCannotBeAreRefusedInWords) {
  const auto expect = [](const std::string& text, int code, const std::string& words) {
    Left left;
    run_modes_text(text, left);
    EXPECT_EQ(left.code, code) << left.messages;
    EXPECT_NE(left.messages.find(words), std::string::npos) << left.messages;
  };
  expect(cantilever_case(R"({ "type": "buckling" })"), 2, "there are no \"loads\"");
  expect(
      cantilever_case(R"({ "type": "modes" })",
                      R"("loads": [{ "beam": "bar", "at": "end", "force": [-1, 0, 0], "follower": true }],)"),
      2, "has no energy");
  expect(cantilever_case(R"({ "type": "modes" })",
                         R"("loads": [{ "beam": "bar", "at": "end", "moment": [50, 20, 10] }],)"),
         3, "moments in space");
  // An arch that turns about the line between its pins.
  expect(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "bar", "section": { "radius": 0.01 }, "material": { "density": 7850, "youngs_modulus": 2e11 },
                "torsion": true, "axis": { "arc": { "center": [0, 0, 0], "start": [-0.8, 0, 0.6], "end": [0.8, 0, 0.6],
                "normal": [0, 1, 0] } }, "elements": { "count": 24 } }],
    "supports": [{ "beam": "bar", "at": "start", "type": "pinned" }, { "beam": "bar", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "bar", "at": { "fraction": 0.5 }, "force": [0, 0, -1000] }],
    "analysis": { "type": "buckling" } })",
         3, "is the model held everywhere?");
  expect(R"({ "nurbeam": 1,
    "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.01 },
                "material": { "density": 7850, "youngs_modulus": 2e11 } }],
    "analysis": { "type": "modes" } })",
         3, "the model has no support");
}

}  // namespace
}  // namespace nurbeam::test
