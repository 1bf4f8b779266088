#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

constexpr double weight = 9.81;
const char* const thirty_degrees = R"({"polyline": [[0, 0, 0], [17.320508075688775, 0, -10]]})";
const char* const level = R"({"polyline": [[0, 0, 0], [20, 0, 0]]})";

struct Happening {
  double time;
  std::string kind, body;
  double energy_before, energy_after;
};

/// A run and the events of its run.json.
struct StopRun {
  CaseRun run;
  std::vector<Happening> events;

  std::vector<double> times(const std::string& kind) const {
    std::vector<double> found;
    for (const Happening& event : events)
      if (event.kind == kind) found.push_back(event.time);
    return found;
  }
};

StopRun run_stops(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  const auto results = directory.path() / "results";
  std::vector<std::string> words = {"run", directory.write("stops.json", text).string(), "--quiet", "--out",
                                    results.string()};
  for (const std::string& override : overrides) words.insert(words.end(), {"--set", override});
  std::ostringstream out, err;
  const CapturedErrors errors;
  StopRun stops{{run_command_line(words, out, err), {}, {}, {}, {}}, {}};
  stops.run.messages = err.str() + errors.text();
  read_histories(results / "histories.csv", stops.run);
  std::ifstream file(results / "run.json");
  const auto json = file ? nlohmann::json::parse(file) : nlohmann::json();
  if (json.contains("events"))
    for (const auto& event : json.at("events"))
      stops.events.push_back({event.at("time [s]"), event.at("kind"), event.at("body"),
                              event.at("energy_before [J]"), event.at("energy_after [J]")});
  return stops;
}

std::string one_body(const std::string& axis, double mass, const std::string& joint, const std::string& stops,
                     const std::string& analysis) {
  std::ostringstream text;
  text << R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true, "axis": )" << axis
       << R"(}], "bodies": [{"name": "bead", "mass": )" << mass
       << R"(}], "sliding_joints": [{"body": "bead", "beam": "rail", )" << joint << R"(}], "stops": )"
       << stops << R"(, "analysis": )" << analysis << "}";
  return text.str();
}

double total_drift(const CaseRun& run) {
  double most = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    most = std::max(most, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return most;
}

TEST(StopsRun, ImpactsComeFasterAndFasterAndEnd) {
  // S1.
  const StopRun stops = run_stops(one_body(thirty_degrees, 5, R"("at": "start")",
                                           R"([{"beam": "rail", "at": {"length": 2}, "restitution": 0.6}])",
                                           R"({"end_time": 4, "step": "1 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const double a = weight / 2, v = std::sqrt(2 * a * 2);
  const std::vector<double> impacts = stops.times("hits a stop"), rests = stops.times("rests at a stop");
  ASSERT_GE(impacts.size(), 8u);
  double t = v / a, u = 0.6 * v;
  EXPECT_NEAR(t, 0.9030473, 1e-7);
  for (std::size_t i = 0; i < 8; ++i, t += 2 * u / a, u *= 0.6) EXPECT_NEAR(impacts[i], t, 1e-6) << i;
  ASSERT_EQ(rests.size(), 1u);
  EXPECT_NEAR(rests[0], v / a + 2 * 0.6 * v / a / 0.4, 1.1e-4);
  EXPECT_LT(impacts.size(), 40u);
  EXPECT_NEAR(stops.run.last("bead.s [m]"), 2, 1e-12);
  EXPECT_NEAR(stops.run.last("energy.dissipated [J]"), 5 * a * 2, 1e-6);
  EXPECT_LT(total_drift(stops.run), 1e-6);
  double highest = 2;
  for (std::size_t i = 0; i < stops.run.rows.size(); ++i) {
    EXPECT_LT(stops.run.value(i, "bead.s [m]"), 2 + 1e-11);
    const double time = stops.run.value(i, "time [s]");
    if (time > impacts[0] && time < impacts[1]) highest = std::min(highest, stops.run.value(i, "bead.s [m]"));
  }
  EXPECT_NEAR(2 - highest, 0.72, 2e-3);
}

TEST(StopsRun, WithFrictionTheWayBackIsShorter) {
  // S2: down with g (sin - mu cos), up with g (sin + mu cos).
  const StopRun stops =
      run_stops(one_body(thirty_degrees, 5, R"("at": "start", "friction": {"coefficient": 0.1})",
                         R"([{"beam": "rail", "at": {"length": 2}, "restitution": 0.6}])",
                         R"({"end_time": 4, "step": "1 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const double cosine = std::sqrt(0.75), down = weight * (0.5 - 0.1 * cosine),
               up = weight * (0.5 + 0.1 * cosine);
  double t = std::sqrt(4 / down), v = down * t;
  EXPECT_NEAR(v, 4.0276192, 1e-7);
  const std::vector<double> impacts = stops.times("hits a stop"), rests = stops.times("rests at a stop");
  ASSERT_GE(impacts.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(impacts[i], t, 1e-5) << i;
    const double u = 0.6 * v, height = u * u / (2 * up);
    v = std::sqrt(2 * down * height);
    t += u / up + v / down;
  }
  const double ratio = 0.6 * std::sqrt(down / up), first = 4.0276192;
  const double rest = std::sqrt(4 / down) + 0.6 * first * (1 / up + 1 / std::sqrt(up * down)) / (1 - ratio);
  EXPECT_NEAR(rest, 2.8471752, 1e-6);
  ASSERT_EQ(rests.size(), 1u);
  EXPECT_NEAR(rests[0], rest, 4e-5);
  EXPECT_LT(total_drift(stops.run), 1e-5);
}

// Between two buffers that lose nothing: pi/w in each, 2/3 s on the way.
TEST(StopsRun, BuffersThatLoseNothingThrowABodyToAndFro) {
  const StopRun stops = run_stops(one_body(level, 80, R"("at": {"length": 3}, "speed": 3)",
                                           R"([{"beam": "rail", "at": {"length": 4}, "stiffness": 20000},
                             {"beam": "rail", "at": {"length": 2}, "stiffness": 20000}])",
                                           R"({"end_time": 10, "step": "1 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const double in = std::numbers::pi / std::sqrt(2e4 / 80), between = 2.0 / 3;
  const std::vector<double> hits = stops.times("hits a stop"), leaves = stops.times("leaves a stop");
  ASSERT_EQ(hits.size(), 12u);
  ASSERT_EQ(leaves.size(), 11u);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    EXPECT_NEAR(hits[i], 1.0 / 3 + i * (in + between), 1e-5 * (i + 1)) << i;
    EXPECT_NEAR(leaves[i] - hits[i], in, 1e-5) << i;
  }
  EXPECT_LT(total_drift(stops.run), 0.02);
}

TEST(StopsRun, ABufferThatDoesNotStickLetsTheBodyGoWhereItsForceEnds) {
  // S3: x = v/w exp(-b t) sin(w t), away where k x + c dx/dt = 0.
  const double m = 80, k = 2e4, c = 800, v = 3, b = c / (2 * m), w = std::sqrt(k / m - b * b);
  const auto at_step = [&](const char* step) {
    return run_stops(
        one_body(level, m, R"("at": {"length": 1}, "speed": 3)",
                 R"([{"beam": "rail", "at": {"length": 4}, "stiffness": 20000, "damping": 800}])",
                 R"({"end_time": 1.3})"),
        {std::string("analysis.step=") + step, "output.every=0.01"});
  };
  const StopRun stops = at_step("0.0005"), coarse = at_step("0.001");
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const double deepest = std::atan2(w, b) / w, x = v / w * std::exp(-b * deepest) * std::sin(w * deepest);
  EXPECT_NEAR(x, 0.1251219, 1e-7);
  EXPECT_NEAR(deepest, 0.0832697, 1e-7);
  ASSERT_EQ(stops.times("hits a stop").size(), 1u);
  EXPECT_NEAR(stops.times("hits a stop")[0], 1, 1e-9);
  ASSERT_EQ(stops.times("leaves a stop").size(), 1u);
  EXPECT_NEAR(stops.times("leaves a stop")[0] - 1, 0.1665394, 1e-6);
  EXPECT_NEAR(stops.run.last("bead.vx [m/s]"), -1.3046243, 3e-5);
  double most = 0;
  for (std::size_t i = 0; i < stops.run.rows.size(); ++i)
    most = std::max(most, stops.run.value(i, "bead.s [m]"));
  EXPECT_NEAR(most - 4, x, 2e-3);
  EXPECT_NEAR(stops.run.last("energy.dissipated [J]"), 40 * (9 - 1.3046243 * 1.3046243), 2e-2);
  EXPECT_LT(total_drift(stops.run), 2e-2);
  EXPECT_GT(total_drift(coarse.run) / total_drift(stops.run), 3);
}

// At 1.54 s the force of a body drawn out at 5 m/s is 0 but for round-off, and a step ends there.
TEST(StopsRun, ABufferDoesNotPullWhereAStepEndsAsItsForceDoes) {
  const StopRun stops = run_stops(
      one_body(
          level, 1,
          R"("at": {"length": 1}, "motion": {"interpolation": "linear", "table": [[0, 1], [1, 6], [2, 1]]})",
          R"([{"beam": "rail", "at": {"length": 3}, "stiffness": 1000, "damping": 60}])",
          R"({"end_time": 2, "step": "1 ms"})"),
      {"output.every=0.01"});
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  ASSERT_EQ(stops.times("leaves a stop").size(), 1u);
  EXPECT_NEAR(stops.times("leaves a stop")[0], 1.54, 1e-6);
  for (std::size_t i = 0; i < stops.run.rows.size(); ++i)
    if (stops.run.value(i, "time [s]") > 1.541)
      EXPECT_NEAR(stops.run.value(i, "bead.holding_force [N]"), 0, 1e-5) << i;
}

// x = v (exp(-p t) - exp(-q t))/(q - p), p and q the roots of m q^2 - c q + k: away where m x'' = -(k x + c
// x') is zero, at q/p exp((p - q) t) = p/q.
TEST(StopsRun, ADamperStifferThanTheStepsStopsABodyAndMakesNoEnergy) {
  const double m = 80, k = 2e4, v = 3, h = 0.01;
  for (const double c : {4e3, 1e4, 4e4, 2e5, 1e7}) {
    SCOPED_TRACE(c);
    std::ostringstream stop;
    stop << R"([{"beam": "rail", "at": {"length": 4}, "stiffness": 20000, "damping": )" << c << "}]";
    const StopRun stops = run_stops(one_body(level, m, R"("at": {"length": 1}, "speed": 3)", stop.str(),
                                             R"({"end_time": 1.3, "step": "10 ms"})"));
    ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
    EXPECT_EQ(stops.run.messages, "");
    const double b = c / (2 * m), root = std::sqrt(b * b - k / m), q = b + root, p = k / m / q;
    const auto place = [&](double t) { return v * (std::exp(-p * t) - std::exp(-q * t)) / (q - p); };
    const double deepest = place(std::log(q / p) / (q - p)), away = 2 * std::log(q / p) / (q - p);
    double most = 0;
    for (std::size_t i = 0; i < stops.run.rows.size(); ++i) {
      most = std::max(most, stops.run.value(i, "bead.s [m]"));
      EXPECT_LT(stops.run.value(i, "energy.kinetic [J]"), 360 * (1 + 1e-9));
    }
    const double back = v * (p * std::exp(-p * away) - q * std::exp(-q * away)) / (q - p);
    ASSERT_EQ(stops.times("hits a stop").size(), 1u);
    EXPECT_NEAR(most - 4, deepest, 0.03 * deepest + v * h * 1e-3);
    EXPECT_NEAR(stops.run.last("bead.vx [m/s]"), -back, 3e-3);
    EXPECT_LT(total_drift(stops.run), 2e-3 * 360);
  }
}

// One that is stiff beyond all measure acts where its body has come to it, and not before.
TEST(StopsRun, ADamperOfAnySizeIsMetWhereItStands) {
  const StopRun stops =
      run_stops(one_body(level, 80, R"("at": {"length": 1}, "speed": 3)",
                         R"([{"beam": "rail", "at": {"length": 4}, "stiffness": 20000, "damping": 1e12}])",
                         R"({"end_time": 1.3, "step": "10 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  ASSERT_EQ(stops.times("hits a stop").size(), 1u);
  EXPECT_NEAR(stops.times("hits a stop")[0], 1, 1e-9);
  EXPECT_NEAR(stops.run.last("bead.s [m]"), 4, 1e-3);
  EXPECT_LT(total_drift(stops.run), 0.04 * 360);
}

// What a body that leaves the beam had pressed in is lost with it.
TEST(StopsRun, WhatABufferHoldsWhenItsBodyLeavesTheBeamIsLost) {
  const StopRun stops = run_stops(one_body(level, 5, R"("at": {"length": 18}, "speed": 5)",
                                           R"([{"beam": "rail", "at": {"length": 19}, "stiffness": 20}])",
                                           R"({"end_time": 1, "step": "1 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  ASSERT_EQ(stops.times("left the beam").size(), 1u);
  EXPECT_NEAR(stops.run.last("energy.dissipated [J]"), 10, 1e-4);
  EXPECT_LT(total_drift(stops.run), 1e-4);
}

const char* const two_bodies = R"({"nurbeam": 1,
  "beams": [{"name": "rail", "rigid": true, "axis": {"polyline": [[0, 0, 0], [20, 0, 0]]}}],
  "bodies": [{"name": "a", "mass": 2}, {"name": "b", "mass": 6}],
  "sliding_joints": [{"body": "a", "beam": "rail", "at": {"length": 2}, "speed": 4},
                     {"body": "b", "beam": "rail", "at": {"length": 6}}],
  "stops": [{"beam": "rail", "bodies": ["a", "b"], "gap": 1, "restitution": 0.5}],
  "analysis": {"end_time": 2, "step": "5 ms"}})";

TEST(StopsRun, ABodyThatStartsOnAStopAndMovesIntoItHitsIt) {
  const auto started = [](double speed, double restitution) {
    std::ostringstream joint, stop;
    joint << R"("at": {"length": 2}, "speed": )" << speed;
    stop << R"([{"beam": "rail", "at": {"length": 2}, "side": "before", "restitution": )" << restitution
         << "}]";
    return run_stops(one_body(level, 4, joint.str(), stop.str(), R"({"end_time": 0.1, "step": "1 ms"})"));
  };
  for (const double restitution : {0.0, 0.5}) {
    const StopRun stops = started(3, restitution);
    ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
    ASSERT_EQ(stops.events.size(), 1u) << restitution;
    EXPECT_EQ(stops.events[0].kind, restitution > 0 ? "hits a stop" : "rests at a stop");
    EXPECT_EQ(stops.events[0].time, 0);
    const double before = 18, after = before * restitution * restitution;
    EXPECT_NEAR(stops.events[0].energy_before, before, 1e-12);
    EXPECT_NEAR(stops.events[0].energy_after, after, 1e-12);
    EXPECT_NEAR(stops.run.value(0, "energy.dissipated [J]"), before - after, 1e-12);
    EXPECT_NEAR(stops.run.value(0, "energy.total [J]"), before, 1e-12);
    EXPECT_LT(total_drift(stops.run), 1e-10);
    EXPECT_NEAR(stops.run.last("bead.vx [m/s]"), -3 * restitution, 1e-9);
  }
  // At rest there, or on its way off, it hits nothing.
  for (const double speed : {0.0, -1.0}) EXPECT_EQ(started(speed, 0.5).events.size(), 0u) << speed;
}

TEST(StopsRun, TwoBodiesExchangeMomentumAcrossTheirGap) {
  const StopRun stops = run_stops(two_bodies);
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  ASSERT_EQ(stops.times("hits a stop").size(), 1u);
  EXPECT_NEAR(stops.times("hits a stop")[0], 0.75, 1e-9);
  // v = (m v -+ ... e): 4 (2 - 6/2)/8 and 4 * 2 * 1.5/8.
  EXPECT_NEAR(stops.run.last("a.vx [m/s]"), -0.5, 1e-9);
  EXPECT_NEAR(stops.run.last("b.vx [m/s]"), 1.5, 1e-9);
}

// On a wire that deforms too: the impulse went into the wire, which took a quarter of the energy.
TEST(StopsRun, BodiesOnAWireHitEachOtherAndNotTheWire) {
  const std::string wire = R"({"nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{"name": "wire", "axis": {"polyline": [[0, 0, 0], [6, 0, 0]]}, "section": {"radius": 0.008},
      "material": {"density": 7800, "youngs_modulus": 2e11}, "elements": {"count": 20}}],
    "supports": [{"beam": "wire", "at": "start", "type": "clamped"},
                 {"beam": "wire", "at": "end", "type": "clamped"}],
    "bodies": [{"name": "a", "mass": 1}, {"name": "b", "mass": 3}],
    "sliding_joints": [{"body": "a", "beam": "wire", "at": {"length": 1}, "speed": 10},
                       {"body": "b", "beam": "wire", "at": {"length": 3}}],
    "stops": [{"beam": "wire", "bodies": ["a", "b"], "gap": 0.7, "restitution": 1}],
    "analysis": {"end_time": 0.2, "step": 2.5e-4},
    "output": {"every": 0.01, "report": false, "probes": [{"name": "p", "beam": "wire", "at": {"length": 2.7}}]}})";
  for (const char* const carried : {"node", "point"}) {
    const std::string as = "sliding_joints[0].carried_as=" + std::string(carried),
                      too = "sliding_joints[1].carried_as=" + std::string(carried);
    const StopRun hard = run_stops(wire, {as, too});
    ASSERT_EQ(hard.run.code, 0) << hard.run.messages;
    EXPECT_EQ(hard.times("hits a stop").size(), 1u);
    // m (1 - 3)/(1 + 3) and 2 m/(1 + 3) of 10 m/s.
    EXPECT_NEAR(hard.run.last("a.vx [m/s]"), -5, 1e-6);
    EXPECT_NEAR(hard.run.last("b.vx [m/s]"), 5, 1e-6);
    const StopRun buffer = run_stops(
        wire, {as, too, R"(stops[0]={"beam": "wire", "bodies": ["a", "b"], "gap": 0.7, "stiffness": 2e4})"});
    ASSERT_EQ(buffer.run.code, 0) << buffer.run.messages;
    EXPECT_NEAR(buffer.run.last("a.vx [m/s]"), -5, 2e-3);
    EXPECT_NEAR(buffer.run.last("b.vx [m/s]"), 5, 2e-3);
    for (const StopRun* run : {&hard, &buffer})
      for (std::size_t i = 0; i < run->run.rows.size(); ++i)
        EXPECT_LT(std::abs(run->run.value(i, "p.axial_force [N]")), 0.1);  // 1000 N once
  }
}

// The second of two that lean against each other gets nothing from the beam along it, which is not pulled
// between them.
TEST(StopsRun, ABodyLeansAgainstTheOneBelowIt) {
  const double c = std::sqrt(0.75);
  std::ostringstream text;
  text.precision(17);
  text << R"({"nurbeam": 1, "beams": [{"name": "bar", "axis": {"polyline": [[0, 0, 0], [)" << 3 * c
       << R"(, 0, 1.5]]}, "section": {"radius": 0.02}, "elements": {"count": 48},
      "material": {"density": 1, "youngs_modulus": 2e11, "damping": 1e-3, "mass_damping": 50}}],
    "supports": [{"beam": "bar", "at": "start", "type": "clamped"},
                 {"beam": "bar", "at": "end", "type": "guided", "direction": [)"
       << c << R"(, 0, 0.5]}],
    "bodies": [{"name": "a", "mass": 10}, {"name": "b", "mass": 20}],
    "sliding_joints": [{"body": "a", "beam": "bar", "at": {"length": 1.0001}},
                       {"body": "b", "beam": "bar", "at": {"length": 1.5002}}],
    "stops": [{"beam": "bar", "bodies": ["a"], "at": {"length": 1}}, {"beam": "bar", "bodies": ["a", "b"], "gap": 0.5}],
    "analysis": {"end_time": 1, "step": 1e-3},
    "output": {"every": 0.5, "report": false, "probes": [{"name": "p", "beam": "bar", "at": {"length": 1.25}}]}})";
  const StopRun stops = run_stops(text.str());
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const auto along = [&](const std::string& body) {
    return stops.run.last(body + ".joint_force.x [N]") * c + stops.run.last(body + ".joint_force.z [N]") / 2;
  };
  EXPECT_NEAR(along("b"), 0, 0.2);  // 98.1 once
  EXPECT_NEAR(along("a"), 30 * weight / 2, 0.3);
  EXPECT_LT(std::abs(stops.run.last("p.axial_force [N]")), 3);  // 115.6 once
}

TEST(StopsRun, BodiesThatDoNotPartGoOnTogetherUntilTheyArePulledApart) {
  const StopRun stops = run_stops(two_bodies, {"stops[0].restitution=0", "bodies[0].drag_area=0.5",
                                               "air={\"density\": 1.2}", "gravity=[1, 0, -9.81]"});
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  // The air drags on the first alone, and both fall along: they part, after the impact took place.
  ASSERT_GE(stops.events.size(), 1u);
  EXPECT_GT(stops.run.last("b.s [m]") - stops.run.last("a.s [m]"), 1);
}

TEST(StopsRun, WithoutAStopBodiesOnAGuideNeverPassEachOther) {
  const StopRun stops = run_stops(two_bodies, {"stops=[]"});
  EXPECT_EQ(stops.run.code, 3);
  EXPECT_TRUE(stops.run.says("sliding bodies \"a\" and \"b\" meet on beam \"rail\" at t = 1 s") ||
              stops.run.says("sliding bodies \"a\" and \"b\" meet on beam \"rail\" at t = 0.99999"))
      << stops.run.messages;
}

TEST(StopsRun, BodiesMeetToTheMomentEvenWhereAStepBeginsThere) {
  // 5 ns into a step of 2 ms, which is less than steps resolve.
  const StopRun stops = run_stops(
      two_bodies, {"stops=[]", "analysis.step=0.002", "sliding_joints[1].at={\"length\": 6.00000002}"});
  EXPECT_EQ(stops.run.code, 3);
  EXPECT_TRUE(stops.run.says("sliding bodies \"a\" and \"b\" meet on beam \"rail\" at t = 1 s"))
      << stops.run.messages;
}

TEST(StopsRun, ATrainComesToRestAgainstAStopAndAChainOfImpactsEnds) {
  const StopRun stops = run_stops(R"({"nurbeam": 1,
    "beams": [{"name": "rail", "rigid": true, "axis": {"polyline": [[0, 0, 0], [17.320508075688775, 0, -10]]}}],
    "bodies": [{"name": "a", "mass": 2}, {"name": "b", "mass": 6}, {"name": "c", "mass": 1}],
    "sliding_joints": [{"body": "a", "beam": "rail", "at": {"length": 1}}, {"body": "b", "beam": "rail", "at": {"length": 3}},
                       {"body": "c", "beam": "rail", "at": {"length": 5}}],
    "stops": [{"beam": "rail", "bodies": ["a", "b"], "gap": 0.5, "restitution": 0.4},
              {"beam": "rail", "bodies": ["c", "b"], "gap": 0.5, "restitution": 0.4},
              {"beam": "rail", "at": {"length": 8}, "restitution": 0.4}],
    "analysis": {"end_time": 6, "step": "2 ms"}})");
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_NEAR(stops.run.last("c.s [m]"), 8, 1e-9);
  EXPECT_NEAR(stops.run.last("b.s [m]"), 7.5, 1e-9);
  EXPECT_NEAR(stops.run.last("a.s [m]"), 7, 1e-9);
  EXPECT_LT(stops.events.size(), 400u);
  EXPECT_LT(total_drift(stops.run), 1e-4);
}

// A row that comes down onto a stop with friction: ever more impacts among ever more of them, which all end.
TEST(StopsRun, ARowOfBodiesWithFrictionComesToRestOnAStop) {
  const StopRun run = run_stops(R"({"nurbeam": 1,
    "beams": [{"name": "rail", "rigid": true, "axis": {"polyline": [[0, 0, 0], [20, 0, -2]]}}],
    "bodies": [{"name": "a", "mass": 3}, {"name": "b", "mass": 4}, {"name": "c", "mass": 5}, {"name": "d", "mass": 6},
               {"name": "e", "mass": 7}],
    "sliding_joints": [
      {"body": "a", "beam": "rail", "at": {"length": 2}, "friction": {"coefficient": 0.05}},
      {"body": "b", "beam": "rail", "at": {"length": 2.5}, "friction": {"coefficient": 0.05}},
      {"body": "c", "beam": "rail", "at": {"length": 3}, "friction": {"coefficient": 0.05}},
      {"body": "d", "beam": "rail", "at": {"length": 3.5}, "friction": {"coefficient": 0.05}},
      {"body": "e", "beam": "rail", "at": {"length": 4}, "friction": {"coefficient": 0.05}}],
    "stops": [{"beam": "rail", "bodies": ["a", "b"], "gap": 0.3, "restitution": 0.5},
              {"beam": "rail", "bodies": ["b", "c"], "gap": 0.3, "restitution": 0.5},
              {"beam": "rail", "bodies": ["c", "d"], "gap": 0.3, "restitution": 0.5},
              {"beam": "rail", "bodies": ["d", "e"], "gap": 0.3, "restitution": 0.5},
              {"beam": "rail", "at": {"length": 8}, "restitution": 0.5}],
    "analysis": {"end_time": 6, "step": "2 ms"}})");
  ASSERT_EQ(run.run.code, 0) << run.run.messages;
  double place = 8;
  for (const char* body : {"e", "d", "c", "b", "a"}) {
    EXPECT_NEAR(run.run.last(std::string(body) + ".s [m]"), place, 1e-8) << body;
    place -= 0.3;
  }
  EXPECT_LT(run.run.last("energy.kinetic [J]"), 1e-12);
  EXPECT_LT(run.events.size(), 400u);
  EXPECT_LT(total_drift(run.run), 1e-8);
}

/// Bodies in a row on a straight rail or rope that goes down by `slope`, the first of which moves.
std::string row(const std::vector<double>& masses, double restitution, double friction, double slope,
                const std::string& beam = R"("rigid": true)") {
  std::ostringstream bodies, joints, stops;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i)), next(1, static_cast<char>('b' + i)),
        comma = i == 0 ? "" : ", ";
    bodies << comma << R"({"name": ")" << name << R"(", "mass": )" << masses[i] << "}";
    joints << comma << R"({"body": ")" << name << R"(", "beam": "rail", "at": {"length": )"
           << 2 + 0.4 * static_cast<double>(i) << R"(}, "speed": )" << (i == 0 ? 3 : 0);
    if (friction > 0) joints << R"(, "friction": {"coefficient": )" << friction << "}";
    joints << "}";
    if (i + 1 < masses.size())
      stops << comma << R"({"beam": "rail", "bodies": [")" << name << R"(", ")" << next
            << R"("], "gap": 0.3, "restitution": )" << restitution << "}";
  }
  std::ostringstream text;
  text << R"({"nurbeam": 1, "beams": [{"name": "rail", "axis": {"polyline": [[0, 0, 0], [20, 0, )"
       << -20 * slope << "]]}, " << beam << R"(}], "bodies": [)" << bodies.str()
       << R"(], "sliding_joints": [)" << joints.str() << R"(], "stops": [)" << stops.str()
       << R"(], "analysis": {"end_time": 3, "step": "2 ms"}})";
  return text.str();
}

const std::vector<double> unequal = {3, 1, 4, 1.5, 5, 9};

TEST(RowsOfBodies, GoOnTogetherWhereNoneRebounds) {
  for (std::size_t n = 2; n <= unequal.size(); ++n) {
    const std::vector<double> masses(unequal.begin(), unequal.begin() + static_cast<std::ptrdiff_t>(n));
    const StopRun stops = run_stops(row(masses, 0, 0, 0));
    ASSERT_EQ(stops.run.code, 0) << n << stops.run.messages;
    double mass = 0;
    for (const double m : masses) mass += m;
    // All have the momentum of the first.
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(stops.run.last(std::string(1, static_cast<char>('a' + i)) + ".vx [m/s]"), 9 / mass, 1e-9)
          << n << i;
    EXPECT_NEAR(stops.run.last("energy.dissipated [J]"), 13.5 - 40.5 / mass, 1e-9) << n;
    EXPECT_LT(total_drift(stops.run), 1e-9) << n;
    EXPECT_LT(stops.events.size(), 10 * n) << n;
  }
}

TEST(RowsOfBodies, OfOneMassHandTheSpeedOnWhereNoneIsLost) {
  for (std::size_t n = 2; n <= 6; ++n) {
    const StopRun stops = run_stops(row(std::vector<double>(n, 2.0), 1, 0, 0));
    ASSERT_EQ(stops.run.code, 0) << n << stops.run.messages;
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(stops.run.last(std::string(1, static_cast<char>('a' + i)) + ".vx [m/s]"),
                  i + 1 == n ? 3 : 0, 1e-9)
          << n << i;
    EXPECT_EQ(stops.times("hits a stop").size(), n - 1);
  }
}

TEST(RowsOfBodies, KeepTheirEnergyAndEndWithFrictionAndOnSlopes) {
  for (const double restitution : {0.0, 0.5, 1.0})
    for (const double friction : {0.0, 0.05, 0.12})
      for (const double slope : {0.0, 0.1})
        for (const std::size_t n : {3, 6}) {
          const std::vector<double> masses(unequal.begin(), unequal.begin() + static_cast<std::ptrdiff_t>(n));
          const StopRun stops = run_stops(row(masses, restitution, friction, slope));
          std::ostringstream which;
          which << n << " bodies, e = " << restitution << ", mu = " << friction << ", slope " << slope
                << "\n";
          ASSERT_EQ(stops.run.code, 0) << which.str() << stops.run.messages;
          // Of 13.5 J and more, at the step in which one comes to rest; 1e-7 with a fourth of the step.
          EXPECT_LT(total_drift(stops.run), 2e-5) << which.str();
          EXPECT_LT(stops.events.size(), 150u) << which.str();
          if (friction == 0.12 && slope == 0)
            EXPECT_LT(stops.run.last("energy.kinetic [J]"), 1e-12) << which.str();
        }
}

TEST(RowsOfBodies, EndOnAnElasticRope) {
  std::string rope =
      row({30, 10, 40, 15}, 0, 0, 0.1,
          R"("section": {"radius": "6 mm"}, "material": {"density": 5200, "youngs_modulus": "60 GPa"},
             "tension": "30 kN", "elements": {"count": 20})");
  rope.insert(1, R"("supports": [{"beam": "rail", "at": "start", "type": "pinned"},
                                 {"beam": "rail", "at": "end", "type": "pinned"}], )");
  // In steps that follow the waves which an impact sends along the rope.
  const StopRun stops =
      run_stops(rope, {"analysis.end_time=0.15", "analysis.step=0.02 ms",
                       R"(analysis.integrator={"type": "generalized-alpha", "rho_infinity": 1})"});
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_GE(stops.times("rests at a stop").size(), 3u);
  EXPECT_LT(stops.events.size(), 100u);
  // Of 135 J that the first one brings; 0.001 with a fourth of the step.
  EXPECT_LT(total_drift(stops.run), 0.3);
}

/// A body that moves off the stop at which it starts, and one that starts at another one's side.
TEST(StopsRun, WhatStartsAtAStopMayMoveAway) {
  const StopRun stops =
      run_stops(one_body(level, 5, R"("at": {"length": 2}, "speed": 3)",
                         R"([{"beam": "rail", "at": {"length": 2}, "restitution": 0.5, "side": "after"}])",
                         R"({"end_time": 1, "step": "1 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_NEAR(stops.run.last("bead.s [m]"), 5, 1e-9);
  EXPECT_EQ(stops.events.size(), 0u);
}

TEST(DrivesRun, ThatTurnAtTheEndOfTheBeamKeepTheirBody) {
  const auto driven = [](const std::string& table) {
    return run_stops(one_body(level, 5, R"("at": {"length": 1}, "motion": {"table": )" + table + "}", "[]",
                              R"({"end_time": 2, "step": "1 ms"})"));
  };
  const StopRun turns = driven("[[0, 1], [1, 20], [1.5, 18]]"),
                waits = driven("[[0, 1], [1, 20], [1.25, 20], [1.5, 18]]"),
                ends = driven("[[0, 1], [1, 20]]");
  for (const StopRun* run : {&turns, &waits}) {
    ASSERT_EQ(run->run.code, 0) << run->run.messages;
    EXPECT_EQ(run->events.size(), 0u);
    EXPECT_NEAR(run->run.last("bead.s [m]"), 18, 1e-9);
    EXPECT_NEAR(run->run.last("bead.z [m]"), 0, 1e-9);
  }
  ASSERT_EQ(ends.times("left the beam").size(), 1u);
  EXPECT_NEAR(ends.times("left the beam")[0], 1, 1e-9);
}

/// Two heavy bodies catch three light ones at a stop: infinitely many impacts in no time.
TEST(RowsOfBodies, EndEndlesslyManyImpactsOfOneMoment) {
  const std::vector<double> masses = {30, 2, 1, 1, 1};
  const StopRun stops = run_stops(row(masses, 0.2, 0, 0.2), {"analysis.end_time=9"});
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_LT(total_drift(stops.run), 1e-6);
}

/// 3.3 m - 3.2 m is less than 0.1 m by round-off.
TEST(StopsRun, BodiesMayStartTheirGapApart) {
  const std::vector<std::string> beside = {
      R"(sliding_joints[0]={"body": "a", "beam": "rail", "at": {"length": 3.2}})",
      R"(sliding_joints[1]={"body": "b", "beam": "rail", "at": {"length": 3.3}})"};
  const auto with_gap = [&](const std::string& gap) {
    return run_stops(two_bodies, {beside[0], beside[1], "stops[0].gap=" + gap});
  };
  const StopRun stops = with_gap("0.1");
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_EQ(stops.events.size(), 0u);
  EXPECT_NEAR(stops.run.last("b.s [m]") - stops.run.last("a.s [m]"), 0.1, 1e-12);
  EXPECT_TRUE(with_gap("0.1001").run.says("must be at most that"));
}

TEST(StopsRun, OnARingAStopIsMetFromBothSides) {
  const std::string ring =
      R"({"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
        "control_points": [[0, -2, 0], [2, -2, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [-2, 2, 0], [-2, 0, 0], [-2, -2, 0],
                           [0, -2, 0]],
        "weights": [1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1]}})";
  const double L = 4 * std::numbers::pi;
  const StopRun stops = run_stops(one_body(ring, 2, R"("at": {"length": 1}, "speed": 3)",
                                           R"([{"beam": "rail", "at": {"length": 0.5}, "restitution": 1}])",
                                           R"({"end_time": 12, "step": "5 ms"})"),
                                  {"beams[0].closed=true"});
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  const std::vector<double> impacts = stops.times("hits a stop");
  ASSERT_EQ(impacts.size(), 2u);
  EXPECT_NEAR(impacts[0], (L - 0.5) / 3, 1e-4);
  EXPECT_NEAR(impacts[1], (2 * L - 0.5) / 3, 2e-4);
}

TEST(StopsRun, TheImpulseGoesIntoARopeThatDeforms) {
  const StopRun stops = run_stops(R"({"nurbeam": 1,
    "beams": [{"name": "rope", "axis": {"polyline": [[0, 0, 0], [10, 0, -1]]},
      "section": {"radius": 0.006}, "material": {"density": 5200, "youngs_modulus": "60 GPa"}, "elements": {"count": 20}}],
    "supports": [{"beam": "rope", "at": "start", "type": "pinned"}, {"beam": "rope", "at": "end", "type": "pinned"}],
    "bodies": [{"name": "bead", "mass": 5}],
    "sliding_joints": [{"body": "bead", "beam": "rope", "at": {"length": 3}, "speed": 4, "friction": {"coefficient": 0.05}}],
    "stops": [{"beam": "rope", "at": {"length": 5.2}, "restitution": 0.5, "side": "before"}],
    "analysis": {"initial": "equilibrium", "end_time": 2, "step": "1 ms"}})");
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  ASSERT_GE(stops.times("hits a stop").size(), 1u);
  for (std::size_t i = 0; i < stops.run.rows.size(); ++i)
    EXPECT_LT(stops.run.value(i, "bead.s [m]"), 5.2 + 1e-9);
  // Waves that the impact leaves and the steps hardly follow are damped by them: energy is lost, but none is
  // made.
  const double start = stops.run.value(0, "energy.total [J]");
  for (std::size_t i = 0; i < stops.run.rows.size(); ++i) {
    EXPECT_LT(stops.run.value(i, "energy.total [J]"), start + 0.1);
    EXPECT_GT(stops.run.value(i, "energy.total [J]"), start - 6);
  }
}

TEST(StopsRun, AtRestABodyLeansAgainstItsStop) {
  const StopRun stops =
      run_stops(one_body(thirty_degrees, 5, R"("at": "start")", R"([{"beam": "rail", "at": {"length": 2}}])",
                         R"({"type": "static"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_NEAR(stops.run.last("bead.s [m]"), 2, 1e-12);
  EXPECT_NEAR(stops.run.last("bead.holding_force [N]"), -5 * weight / 2, 1e-8);
  const StopRun buffer = run_stops(one_body(thirty_degrees, 5, R"("at": "start")",
                                            R"([{"beam": "rail", "at": {"length": 2}, "stiffness": 1000}])",
                                            R"({"type": "static"})"));
  ASSERT_EQ(buffer.run.code, 0) << buffer.run.messages;
  EXPECT_NEAR(buffer.run.last("bead.s [m]"), 2 + 5 * weight / 2 / 1000, 1e-6);
}

// As at rest: what keeps each body in its place is what is missing to its weight along the beam.
TEST(StopsRun, ABodyThatHasComeToRestIsHeldByItsStopAndByItsNeighbour) {
  const StopRun stops = run_stops(R"({"nurbeam": 1,
    "beams": [{"name": "rail", "rigid": true, "axis": )" +
                                  std::string(thirty_degrees) + R"(}],
    "bodies": [{"name": "upper", "mass": 2}, {"name": "lower", "mass": 3}],
    "sliding_joints": [{"body": "upper", "beam": "rail", "at": {"length": 1}},
      {"body": "lower", "beam": "rail", "at": {"length": 2}}],
    "stops": [{"beam": "rail", "bodies": ["upper", "lower"], "gap": 0.3},
      {"beam": "rail", "at": {"length": 5}, "bodies": ["lower"]}],
    "analysis": {"end_time": 3, "step": "10 ms"}})");
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_EQ(stops.run.value(0, "lower.holding_force [N]"), 0);
  EXPECT_NEAR(stops.run.last("upper.s [m]"), 4.7, 1e-9);
  EXPECT_NEAR(stops.run.last("upper.holding_force [N]"), -2 * weight / 2, 1e-8);
  EXPECT_NEAR(stops.run.last("lower.holding_force [N]"), -3 * weight / 2, 1e-8);
}

TEST(StopsRun, OnItsWayBackABodyIsHeldFromBelow) {
  const StopRun stops = run_stops(
      one_body(R"({"polyline": [[0, 0, 0], [17.320508075688775, 0, 10]]})", 5, R"("at": {"length": 3})",
               R"([{"beam": "rail", "at": {"length": 2}}])", R"({"end_time": 2, "step": "10 ms"})"));
  ASSERT_EQ(stops.run.code, 0) << stops.run.messages;
  EXPECT_NEAR(stops.run.last("bead.holding_force [N]"), 5 * weight / 2, 1e-8);
}

// Which of two bodies passes its end first in a step does not hang on their order.
TEST(StopsRun, BodiesThatReachEndsInOneStepReachThemWhenTheyDo) {
  const double slope = weight / std::sqrt(5), length = std::sqrt(20);
  const auto two_bodies = [](const char* first, const char* second, const char* analysis) {
    return std::string(R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true,
        "axis": {"polyline": [[0, 0, 0], [4, 0, -2]]}}],
      "bodies": [{"name": "m", "mass": 1}, {"name": "n", "mass": 1}], "sliding_joints": [)") +
           first + ", " + second + R"(], "output": {"every": 0.25, "report": false}, "analysis": )" +
           analysis + "}";
  };
  const char *const m = R"({"body": "m", "beam": "rail", "at": {"length": 1.3}})",
                    *const n = R"({"body": "n", "beam": "rail", "at": {"length": 1.8}})";
  for (const char* analysis : {R"({"end_time": 2})", R"({"end_time": 2, "step": 0.25})"})
    for (const bool n_first : {false, true}) {
      const StopRun run = run_stops(n_first ? two_bodies(n, m, analysis) : two_bodies(m, n, analysis));
      ASSERT_EQ(run.run.code, 0) << run.run.messages;
      const std::vector<double> left = run.times("left the beam");
      ASSERT_EQ(left.size(), 2u);
      for (const int i : {0, 1}) {
        const double t = std::sqrt(2 * (length - (i == 0 ? 1.8 : 1.3)) / slope);
        EXPECT_NEAR(left[i], t, 1e-9) << n_first;
        EXPECT_NEAR(run.run.last(i == 0 ? "n.x [m]" : "m.x [m]"), 4 + slope * t * (2 - t) * 2 / std::sqrt(5),
                    1e-8);
      }
    }
}

// A stop where the body would go over to another element: a support, a vertex, a seam.
TEST(StopsRun, AtASupportAVertexAndASeamAreAsElsewhere) {
  const auto speed_behind = [](const std::string& beam, const std::string& at, const std::string& stop,
                               const std::string& joint = "") {
    const StopRun run = run_stops(
        R"({"nurbeam": 1, "gravity": [0, 0, 0], "beams": [{"name": "rail", )" + beam +
        R"(}], "bodies": [{"name": "bead", "mass": 1}],
        "sliding_joints": [{"body": "bead", "beam": "rail", "speed": 3, "at": {"length": )" +
        at + "}" + joint + R"(}], "stops": [{"beam": "rail", "at": {"length": )" + stop +
        R"(}], "analysis": {"end_time": 0.9, "step": "1 ms"}, "output": {"every": 0.9, "report": false}})");
    EXPECT_EQ(run.run.code, 0) << run.run.messages;
    return run.run.last("bead.vx [m/s]");
  };
  const std::string hard = R"(}, "restitution": 0.8)", soft = R"(}, "stiffness": 1e4)";
  const std::string vertices = R"("rigid": true, "axis": {"polyline": [[0, 0, 0], [2, 0, 0], [4, 0, 0]]})";
  const std::string supported = R"("axis": {"polyline": [[0, 0, 0], [4, 0, 0]]}, "elements": {"count": 20},
      "section": {"radius": 0.05}, "material": "steel")";
  EXPECT_NEAR(speed_behind(vertices, "1", "2" + hard), -2.4, 1e-9);
  EXPECT_NEAR(speed_behind(vertices, "1", "2" + soft), -3, 1e-3);
  EXPECT_NEAR(speed_behind(supported + R"(}], "supports": [{"beam": "rail", "at": "start", "type": "clamped"},
      {"beam": "rail", "at": {"length": 2}, "type": "pinned")",
                           "1", "2" + hard),
              -2.4, 1e-6);
  // The beam takes a part of the impulse.
  const std::string clamped =
      supported + R"(}], "supports": [{"beam": "rail", "at": "start", "type": "clamped")";
  const std::string as_point = R"(, "carried_as": "point")";
  EXPECT_NEAR(speed_behind(clamped, "1", "2.2" + hard, as_point),
              speed_behind(clamped, "1", "2.19999" + hard, as_point), 1e-4);
  // Round a circle of one metre back from where it starts, on the other side of its seam.
  const StopRun ring =
      run_stops(R"({"nurbeam": 1, "gravity": [0, 0, 0], "beams": [{"name": "rail", "rigid": true,
      "closed": true, "axis": {"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [1, 0, 0],
      "normal": [0, 0, 1]}}}], "bodies": [{"name": "bead", "mass": 1}],
      "sliding_joints": [{"body": "bead", "beam": "rail", "speed": -2, "at": {"length": 0.6}}],
      "stops": [{"beam": "rail", "at": "start", "restitution": 1}], "analysis": {"end_time": 1}})");
  ASSERT_EQ(ring.run.code, 0) << ring.run.messages;
  EXPECT_NEAR(ring.run.last("bead.s [m]"), 1.4, 2e-4);
}

TEST(StopsRun, WhatCannotStopIsRefused) {
  const std::string text =
      one_body(thirty_degrees, 5, R"("at": {"length": 3})", R"([{"beam": "rail", "at": {"length": 5}}])",
               R"({"end_time": 1, "step": "5 ms"})");
  const auto says = [&](const std::vector<std::string>& overrides, const std::string& part) {
    const StopRun stops = run_stops(text, overrides);
    EXPECT_EQ(stops.run.code, 2) << overrides[0];
    EXPECT_TRUE(stops.run.says(part)) << stops.run.messages;
  };
  says({"stops[0].restitution=0.5", "stops[0].stiffness=100"}, "exclude each other");
  says({"stops[0].restitution=1.5"}, "must be between 0 and 1");
  says({R"(stops[0].at={"length": 2})", "stops[0].side=before"}, "starts beyond, at s = 3 m");
  says({"stops[0].at=null"}, "stands nowhere");
  says({"stops[0].bodies=[\"bed\"]"}, "there is no body \"bed\"");
  says({"stops[0].beam=rial"}, "there is no beam \"rial\"");
  says({"stops[0].at=end", "sliding_joints[0].at_beam_end=stop"}, "keep one of them");
  says({"stops[0].at=end", "stops[0].stiffness=100"}, "a buffer has no way to be pressed in");
  says({R"(sliding_joints[0].motion={"speed": 1})"}, "is prescribed by its \"motion\"");
  says(
      {R"(stops=[{"beam": "rail", "at": {"length": 3}}, {"beam": "rail", "at": {"length": 3}, "side": "after"}])"},
      "stops: hard stops at s = 3 m and 3 m leave body \"bead\" no room");
  says({"sliding_joints[0].speed=1e20"}, "sliding_joints[0].speed: is 1e+20 m/s; must be between");
  says({"stops=[]", R"(sliding_joints[0].motion={"table": [[0, 3], [1e-12, 4]]})"},
       "sliding_joints[0].motion.table[1]: is reached at 1e+12 m/s");
}

}  // namespace
}  // namespace nurbeam::test
