// Errors of mesh and step of a run, held against known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

using Json = nlohmann::json;

std::string text_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A run with --accuracy, and what it has left.
class AccurateRun {
 public:
  explicit AccurateRun(const std::string& text, const std::string& accuracy = "--accuracy",
                       std::vector<std::string> more = {}) {
    const auto file = directory_.write("case.json", text);
    std::vector<std::string> words = {"run", file.string(), "--quiet", "--out", results().string()};
    if (!accuracy.empty()) words.push_back(accuracy);
    words.insert(words.end(), more.begin(), more.end());
    std::ostringstream out, err;
    const CapturedErrors errors;
    code = run_command_line(words, out, err);
    messages = err.str() + errors.text();
    std::ifstream stream(results() / "run.json");
    if (stream) run = Json::parse(stream);
  }

  std::filesystem::path results() const { return directory_.path() / "results"; }
  const TemporaryDirectory& directory() const { return directory_; }
  /// The first number of that name.
  const Json& number(const std::string& quantity) const {
    for (const Json& each : run.at("accuracy").at("quantities"))
      if (each.at("quantity") == quantity) return each;
    throw std::out_of_range("no number " + quantity);
  }
  double error(const std::string& quantity) const { return number(quantity).at("error").get<double>(); }
  bool is_converged(const std::string& quantity) const {
    return number(quantity).at("not_converged").is_null();
  }

  int code = -1;
  std::string messages;
  Json run;

 private:
  TemporaryDirectory directory_;
};

// The bar holds the truth, and is no larger than `most` nor smaller than `least`.
void expect_holds(const AccurateRun& run, const std::string& quantity, double truth, double most,
                  double least = 0) {
  ASSERT_TRUE(run.run.contains("accuracy")) << run.messages;
  const Json& number = run.number(quantity);
  const double value = number.at("value").get<double>(), error = number.at("error").get<double>();
  EXPECT_LE(std::abs(value - truth), error) << quantity << " = " << value;
  EXPECT_LE(error, most) << quantity;
  EXPECT_GE(error, least) << quantity;
}

// P L^2/EI = 2, EA L^2/EI = 1e6.
const std::string elastica = R"({"nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"area": 1, "second_moment": 1e-6},
             "material": {"density": 1, "youngs_modulus": 1e6}, "elements": {"count": 12}}],
  "supports": [{"beam": "b", "at": "start", "type": "clamped", "name": "A"}],
  "loads": [{"beam": "b", "at": "end", "force": [0, 2, 0]}],
  "analysis": {"type": "static"},
  "output": {"report": false, "probes": [{"name": "tip", "beam": "b", "at": "end"}]}})";

TEST(Accuracy, HoldsTheElastica) {
  const AccurateRun run(elastica);
  ASSERT_EQ(run.code, 0) << run.messages;
  expect_holds(run, "tip.y", 0.4934584, 1e-5);
}

TEST(Accuracy, HoldsABendInSpace) {
  const AccurateRun run(text_in(sample("bend45/bend45.json")), "--accuracy",
                        {"--set", "beams[0].elements.count=8", "--set", "output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  for (const auto& [quantity, truth] :
       {std::pair{"tip.x", 15.68536}, {"tip.y", 47.15215}, {"tip.z", 53.47176}})
    expect_holds(run, quantity, truth, 0.02);
}

const std::string loaded_rope = R"({"gravity": [0, 0, -9.81], "nurbeam": 1,
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [304.8, 0, 0]]}, "stress_free": "straight",
             "section": {"area": 0.0005484, "second_moment": 1e-12}, "unstressed_length": 312.73,
             "material": {"density": 8572.803024050689, "youngs_modulus": 131e9}, "elements": {"count": 40}}],
  "supports": [{"beam": "b", "at": "start", "type": "pinned", "name": "A"},
               {"beam": "b", "at": "end", "type": "pinned", "name": "B"}],
  "loads": [{"beam": "b", "at": {"fraction": 0.402519745467336}, "force": [0, 0, -35586]}],
  "analysis": {"type": "static"},
  "output": {"report": false, "probes": [{"name": "p", "beam": "b", "at": {"fraction": 0.402519745467336}}]}})";

TEST(Accuracy, HoldsARopeWithALoad) {
  const AccurateRun run(loaded_rope);
  ASSERT_EQ(run.code, 0) << run.messages;
  expect_holds(run, "p.z", -34.95876, 0.5);
  expect_holds(run, "A.fx", -89301.84, 2000);
}

// The same rope as two beams with a hinge at the load, where nothing bends within an element.
TEST(Accuracy, OfARopeInTwoBeamsIsAThousandTimesSmaller) {
  const auto half = [](const std::string& name, double from, double to, double length) {
    std::ostringstream beam;
    beam.precision(17);
    beam << R"({"name": ")" << name << R"(", "axis": {"polyline": [[)" << from << ", 0, 0], [" << to
         << R"(, 0, 0]]}, "stress_free": "straight", "unstressed_length": )" << length << R"(,
             "section": {"area": 0.0005484, "second_moment": 1e-12},
             "material": {"density": 8572.803024050689, "youngs_modulus": 131e9}, "elements": {"count": 16}})";
    return beam.str();
  };
  constexpr double part = 0.402519745467336, span = 304.8, length = 312.73;
  const AccurateRun run(R"({"gravity": [0, 0, -9.81], "nurbeam": 1, "beams": [)" +
                        half("b", 0, span * part, length * part) + ", " +
                        half("c", span * part, span, length * (1 - part)) + R"(],
  "joints": [{"type": "hinged", "beams": ["b", "c"]}],
  "supports": [{"beam": "b", "at": "start", "type": "pinned", "name": "A"},
               {"beam": "c", "at": "end", "type": "pinned", "name": "B"}],
  "loads": [{"beam": "b", "at": "end", "force": [0, 0, -35586]}],
  "analysis": {"type": "static"},
  "output": {"report": false, "probes": [{"name": "p", "beam": "b", "at": "end"}]}})");
  ASSERT_EQ(run.code, 0) << run.messages;
  expect_holds(run, "p.z", -34.958758, 2e-5);
  expect_holds(run, "A.fx", -89301.84, 1);
}

// Half the weight of the part between clamp and pin, at each.
const std::string held_bar = R"({"nurbeam": 1, "gravity": [-1, 0, 0],
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"area": 1, "second_moment": 1e-4},
             "material": {"density": 1, "youngs_modulus": 1e6}, "elements": {"count": 56}}],
  "supports": [{"beam": "b", "at": "start", "type": "clamped", "name": "A"},
               {"beam": "b", "at": {"length": 0.3}, "type": "pinned", "name": "P"}],
  "analysis": {"type": "static"}, "output": {"report": false}})";

TEST(Accuracy, HoldsABarWhosePullASupportTakes) {
  const AccurateRun run(held_bar);
  ASSERT_EQ(run.code, 0) << run.messages;
  const double clamp = run.number("A.fx").at("value").get<double>();
  expect_holds(run, "A.fx", clamp > 0 ? 0.15 : -0.15, 0.02);
}

// Waves on both sides of the mass: T k (cot ka + cot kb) = M w^2.
TEST(Accuracy, HoldsAStringWithAMass) {
  const AccurateRun run(R"({"nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [10, 0, 0]]}, "section": {"area": 1e-4, "second_moment": 1e-14},
             "material": {"density": 5000, "youngs_modulus": 1e10}, "tension": 2000, "elements": {"count": 16}}],
  "supports": [{"beam": "b", "at": "start", "type": "pinned"}, {"beam": "b", "at": "end", "type": "pinned"}],
  "bodies": [{"name": "m", "mass": 1.5, "fastened": {"beam": "b", "at": {"fraction": 0.37}}}],
  "analysis": {"type": "modes", "modes": {"count": 3}}, "output": {"report": false}})");
  ASSERT_EQ(run.code, 0) << run.messages;
  expect_holds(run, "mode 1", 2.51605320616, 1e-3);
  expect_holds(run, "mode 2", 5.68388910324, 1e-2);
  expect_holds(run, "mode 3", 9.15998274109, 1e-1);
}

// A rope of 30 m that is drawn level and held at one end hangs straight down.
TEST(Accuracy, HoldsAHangingRope) {
  const AccurateRun run(R"({"nurbeam": 1,
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [30, 0, 0]]}, "stress_free": "straight",
             "section": {"rope": {"diameter": 0.006, "metallic_area": 1.4e-5}},
             "material": {"density": 9000, "youngs_modulus": 1e11}, "elements": {"count": 20}}],
  "supports": [{"beam": "b", "at": "start", "type": "pinned", "name": "A"}],
  "analysis": {"type": "static"},
  "output": {"report": false, "probes": [{"name": "z", "beam": "b", "at": "end"}]}})");
  ASSERT_EQ(run.code, 0) << run.messages;
  const double weight = 9000 * 1.4e-5 * 9.81 * 30;
  expect_holds(run, "A.fz", weight, 1e-3);
  expect_holds(run, "z.z", -30 - weight * 30 / 2 / (1e11 * 1.4e-5), 1e-3);
}

// A hinged column under 15 EI/L^2, beyond its buckling load: its middle is aside by k/K(k), 4 K(k)^2 = 15.
std::string pushed_column(const std::string& aside) {
  return R"({"nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"area": 1, "second_moment": 1e-6},
             "material": {"density": 1, "youngs_modulus": 1e6}, "elements": {"count": 20}}],
  "supports": [{"beam": "b", "at": "start", "type": "pinned"},
               {"beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0]}],
  "loads": [{"beam": "b", "at": "end", "force": [-15, 0, 0]},
            {"beam": "b", "at": {"fraction": 0.5}, "force": [0, )" +
         aside + R"(, 0]}],
  "analysis": {"type": "static"},
  "output": {"report": false, "probes": [{"name": "mid", "beam": "b", "at": {"fraction": 0.5}}]}})";
}

TEST(Accuracy, SaysWhenHalfTheElementsBuckleTheOtherWay) {
  const AccurateRun pushed(pushed_column("1e-6"));
  ASSERT_EQ(pushed.code, 0) << pushed.messages;
  EXPECT_TRUE(pushed.is_converged("mid.y"));
  expect_holds(pushed, "mid.y", 0.395877447, 5e-3);
  const AccurateRun alone(pushed_column("0"));
  ASSERT_EQ(alone.code, 0) << alone.messages;
  if (alone.error("mid.y") > 5e-3)
    EXPECT_FALSE(alone.is_converged("mid.y"));
  else  // by chance on the same branch
    EXPECT_NEAR(std::abs(alone.number("mid.y").at("value").get<double>()), 0.395877447, alone.error("mid.y"));
}

const std::string example_1 = R"({"nurbeam": 1, "gravity": [0, -9.81, 0],
  "beams": [{"name": "beam", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
             "material": {"density": 7200, "youngs_modulus": 20e6}, "elements": {"count": 20},
             "curvature": "spatial"}],
  "supports": [{"beam": "beam", "at": "start", "type": "clamped"}],
  "bodies": [{"name": "mass", "mass": 0.8}],
  "sliding_joints": [{"body": "mass", "beam": "beam", "at": {"length": 0.1}}],
  "analysis": {"end_time": END, "step": 5e-4},
  "output": {"every": 0.01, "report": false}})";

std::string with_end(std::string text, const std::string& end) {
  return text.replace(text.find("END"), 3, end);
}

TEST(Accuracy, HoldsABodyOnAFallingBeam) {
  const AccurateRun there(with_end(example_1, "0.5"));
  ASSERT_EQ(there.code, 0) << there.messages;
  expect_holds(there, "mass.x", 0.110137, 0.005);
  const AccurateRun run(with_end(example_1, "0.75"));
  expect_holds(run, "mass left the beam", 0.71356, 0.02);
}

// R = 3 m, mu = 0.25: Runge and Kutta's method in the angle.
const std::string swing = R"({"nurbeam": 1, "gravity": [0, -9.81, 0],
  "beams": [{"name": "guide", "rigid": true,
             "axis": {"arc": {"center": [0, 0, 0], "start": [-3, 0, 0], "end": [3, 0, 0], "normal": [0, 0, 1]}}}],
  "bodies": [{"name": "m", "mass": 5}],
  "sliding_joints": [{"body": "m", "beam": "guide", "at": "start", "friction": {"coefficient": 0.25}}],
  "analysis": {"end_time": END}, "output": {"every": 0.05, "report": false}})";

TEST(Accuracy, HoldsASwingWithFriction) {
  const AccurateRun there(with_end(swing, R"(1.0, "step": 2.5e-3)"));
  ASSERT_EQ(there.code, 0) << there.messages;
  expect_holds(there, "m.s", 3.8324096, 3e-4);
  const AccurateRun run(with_end(swing, R"(1.95, "step": 2.5e-3)"));
  expect_holds(run, "m slides", 1.8858066, 1e-3);
}

TEST(Accuracy, OfErrorControlIsNotThatOfTheSameSteps) {
  for (const char* method : {R"(1.0, "integrator": {"type": "radau"})", "1.0"}) {
    const AccurateRun run(with_end(swing, method));
    ASSERT_EQ(run.code, 0) << run.messages;
    expect_holds(run, "m.speed", 5.5684762, 1e-2, 1e-6);
  }
}

// Rods of 1 m from 2 and 2.5 rad.
const std::string pendulum = R"({"nurbeam": 1, "gravity": [0, -9.81, 0],
  "beams": [{"name": "guide", "rigid": true, "axis": {"polyline": [[0, 5, 0], [1, 5, 0]]}}],
  "bodies": [{"name": "a", "mass": 1, "position": [0.9092974268256817, 0.4161468365471424, 0]},
             {"name": "b", "mass": 1, "position": [1.507769570929638, 1.2172904520940758, 0]}],
  "connectors": [{"name": "r1", "type": "rod", "from": {"point": [0, 0, 0]}, "to": {"body": "a"}},
                 {"name": "r2", "type": "rod", "from": {"body": "a"}, "to": {"body": "b"}}],
  "analysis": {"end_time": 20, "step": 1.25e-3}, "output": {"every": 0.05, "report": false}})";

TEST(Accuracy, SaysWhenChaoticMotionsPart) {
  const AccurateRun run(pendulum);
  ASSERT_EQ(run.code, 0) << run.messages;
  for (const char* each : {"a.x", "a.y", "b.x", "b.y"}) EXPECT_FALSE(run.is_converged(each)) << each;
  const double parted = run.run.at("accuracy").at("parted [s]").get<double>();
  EXPECT_GT(parted, 3);
  EXPECT_LT(parted, 6);
}

TEST(Accuracy, OfAChaoticMotionIsNotReached) {
  const AccurateRun run(pendulum, "--accuracy=1%");
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.run.at("status").get<std::string>().substr(0, 8), "accuracy");
  EXPECT_FALSE(run.run.at("accuracy").at("reached").get<bool>());
  EXPECT_TRUE(std::filesystem::exists(run.results() / "errors.csv"));
}

TEST(Accuracy, OfAFrontIsNoBound) {
  const AccurateRun run(R"({"nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"area": 1e-4, "second_moment": 1e-9},
               "material": {"density": 7800, "youngs_modulus": 2e11}, "elements": {"count": 20}}],
    "supports": [{"beam": "b", "at": "start", "type": "clamped", "name": "A"}],
    "loads": [{"beam": "b", "at": "end", "force": [1000, 0, 0]}],
    "analysis": {"end_time": 2e-3, "step": 1e-6},
    "output": {"every": 2e-5, "report": false, "probes": [{"name": "tip", "beam": "b", "at": "end"}]}})");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.is_converged("A.fx"));
  EXPECT_NE(run.number("A.fx").at("not_converged").get<std::string>().find("forces of waves"),
            std::string::npos);
}

// ---- Files and refinement ----

TEST(Accuracy, LeavesTheFilesOfTheRunAsTheyAre) {
  const std::string text = with_end(swing, R"(1.0, "step": 2.5e-3)");
  const AccurateRun with(text), without(text, "");
  for (const char* name : {"histories.csv", "results.nc"})
    EXPECT_EQ(text_in(with.results() / name), text_in(without.results() / name)) << name;
  EXPECT_FALSE(without.run.contains("accuracy"));
  EXPECT_FALSE(std::filesystem::exists(without.results() / "errors.csv"));
}

TEST(Accuracy, ErrorsStandBesideHistoriesAndNeverFall) {
  const AccurateRun run(with_end(example_1, "0.5"));
  CaseRun histories, errors;
  read_histories(run.results() / "histories.csv", histories);
  read_histories(run.results() / "errors.csv", errors);
  EXPECT_EQ(histories.header, errors.header);
  ASSERT_EQ(histories.rows.size(), errors.rows.size());
  for (std::size_t column = 1; column < errors.header.size(); ++column)
    for (std::size_t i = 0; i < errors.rows.size(); ++i) {
      EXPECT_EQ(std::isnan(histories.rows[i][column]), std::isnan(errors.rows[i][column]));
      if (i > 0 && !std::isnan(errors.rows[i][column]) && !std::isnan(errors.rows[i - 1][column]))
        EXPECT_GE(errors.rows[i][column], errors.rows[i - 1][column]) << errors.header[column];
    }
  EXPECT_TRUE(std::filesystem::exists(run.results() / "errors.nc"));
}

TEST(Accuracy, IsRefinedToATarget) {
  const AccurateRun run(elastica, "--accuracy=0.001%");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_TRUE(run.run.at("accuracy").at("reached").get<bool>());
  EXPECT_GT(run.run.at("accuracy").at("runs")[0].at("level").get<int>(), 0);
  expect_holds(run, "tip.y", 0.4934584, 1e-5);
}

TEST(Accuracy, GoesOnFromAFinishedRun) {
  const std::string text = with_end(example_1, "0.3");
  const AccurateRun plain(text, "");
  std::ostringstream out, err;
  const CapturedErrors errors;
  EXPECT_EQ(run_command_line({"run", (plain.directory().path() / "case.json").string(), "--quiet", "--out",
                              plain.results().string(), "--accuracy", "5%"},
                             out, err),
            0)
      << err.str() << errors.text();
  std::ifstream stream(plain.results() / "run.json");
  const Json again = Json::parse(stream);
  EXPECT_FALSE(again.at("resumed_at [s]").is_null());
  const AccurateRun at_once(text, "--accuracy=5%");
  EXPECT_EQ(again.at("accuracy").at("quantities"), at_once.run.at("accuracy").at("quantities"));
}

TEST(Accuracy, RefusesWhatItCannotBe) {
  EXPECT_EQ(AccurateRun(elastica, "--accuracy=70%").code, 2);
  const AccurateRun length(elastica, "--accuracy=1mm");
  EXPECT_EQ(length.code, 2);
  EXPECT_NE(length.messages.find("%"), std::string::npos) << length.messages;
  const AccurateRun name(elastica, "", {"--set", R"(analysis.accuracy={"of": ["tip.yy"]})"});
  EXPECT_EQ(name.code, 2);
  EXPECT_NE(name.messages.find("tip.y"), std::string::npos) << name.messages;
  EXPECT_EQ(AccurateRun(elastica, "", {"--set", R"(analysis.accuracy={"target": 1e-9})"}).code, 2);
}

TEST(Accuracy, NoErrorIsZeroUnlessTheNumberIs) {
  const AccurateRun run(with_end(example_1, "0.3"));
  for (const Json& each : run.run.at("accuracy").at("quantities"))
    if (each.at("error") == 0.0) EXPECT_EQ(each.at("value"), 0.0) << each;
}

}  // namespace
}  // namespace nurbeam::test
