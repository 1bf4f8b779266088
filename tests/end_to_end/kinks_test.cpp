// Kinks of ropes where something loads or holds them, and the layer of bending there.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

std::filesystem::path case_file(const std::string& name) { return source_directory() / "tests/cases" / name; }

std::string count(int elements) { return "beams[0].elements.count=" + std::to_string(elements); }

// A rope of 16 mm, 30 kN and 8200 kg/m^3 over 100 m; `more` are keys beside it.
std::string rope_on(const std::string& supports, const std::string& more) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [100, 0, 0]] }, "tension": "30 kN",
      "stress_free": "straight", "section": { "rope": { "diameter": "16 mm", "metallic_area": "110 mm^2" } },
      "material": { "density": 8200, "youngs_modulus": "100 GPa" }, "elements": { "count": 40 } }],
    "supports": [)" +
         supports + "], " + more + "}";
}
const std::string pinned_ends = R"({ "beam": "rope", "at": "start", "type": "pinned" },
                                   { "beam": "rope", "at": "end", "type": "pinned" })";
const std::string a_static = R"("analysis": { "type": "static" }, "output": { "report": false })";

// The published sag of a rope with a heavy load at two fifths of it: 5.626 m more than without; by shooting
// with Green's law 34.9588 m below its ends.
TEST(Kinks, GiveAPointLoadOnARopeItsSag) {
  const CaseRun run = run_file(case_file("rope_point_load_20.json"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.z [m]"), -34.9588, 2e-3);
}

TEST(Kinks, ConvergeWithTheSecondOrderAtLeast) {
  const auto sag = [](int elements) {
    return run_file(case_file("rope_point_load_20.json"), {count(elements)}).last("p.z [m]");
  };
  const double right = sag(80), coarse = std::abs(sag(5) - right), fine = std::abs(sag(10) - right),
               finest = std::abs(sag(20) - right);
  EXPECT_LT(fine, coarse / 4);
  EXPECT_LT(finest, fine / 4);
}

// Bending of a cable of 12 mm reaches over 0.24 m, an eighth of an element: with a smooth node the force
// between trolley and cable rings up to 1.2 kN with 40 elements, and 20 elements end at a change of the mesh.
// 160 and 320 elements with smooth nodes give 867 and 857 N.
TEST(Kinks, StandUnderATrolleyWhereBendingReachesOverLessThanHalfAnElement) {
  const std::string cable = R"({ "nurbeam": 1,
    "beams": [{ "name": "cable", "axis": { "file": ")" +
                            sample("zipline/cable.step").string() + R"(", "curve": "Zip cable" },
      "stress_free": "straight", "section": { "radius": "6 mm" },
      "material": { "density": 5200, "youngs_modulus": "60 GPa" }, "elements": { "count": 20 } }],
    "bodies": [{ "name": "trolley", "mass": 80 }],
    "supports": [{ "beam": "cable", "at": "start", "type": "pinned" },
                 { "beam": "cable", "at": "end", "type": "pinned" }],
    "sliding_joints": [{ "body": "trolley", "beam": "cable", "at": { "length": 1.5 } }],
    "analysis": { "initial": "equilibrium", "end_time": 1.5, "step": "5 ms" }, "output": { "report": false } })";
  for (const int elements : {10, 20, 40}) {
    const CaseRun run = run_text(cable, {count(elements)});
    ASSERT_EQ(run.code, 0) << run.messages;
    double peak = 0;
    for (std::size_t row = 0; row < run.rows.size(); ++row)
      peak = std::max(peak, std::hypot(run.value(row, "trolley.joint_force.x [N]"),
                                       run.value(row, "trolley.joint_force.y [N]"),
                                       run.value(row, "trolley.joint_force.z [N]")));
    EXPECT_NEAR(peak, 860, 0.02 * 860) << elements;
  }
  const CaseRun smooth = run_text(cable, {count(40), R"(sliding_joints[0].slope="continuous")"});
  EXPECT_TRUE(smooth.says("forces ring as the body runs from element to element")) << smooth.messages;
}

// 576 N a little beside the end of a cable of 35.5 m and 5 elements; heights by shooting.
TEST(Kinks, StandBesideSupportsToo) {
  const std::string cable = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [35.52349603791518, 0, 0]] },
      "section": { "area": 0.00038661615642010945, "second_moment": 7.7e-14 },
      "material": { "density": 6496.72803542013, "youngs_modulus": 6937373274.421487 },
      "unstressed_length": 35.530611679230226, "stress_free": "straight", "elements": { "count": 5 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "b", "at": { "fraction": 0.00476 }, "force": [0, 0, -576.3712568870395] }],
    "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "p", "beam": "b", "at": { "fraction": 0.00476 } }] } })";
  for (const auto& [at, height] :
       {std::pair{0.00476, -0.03856068}, {0.001, -0.00825139}, {1e-4, -0.00082887}, {0.201, -0.92253644}}) {
    const std::string place = ".at={\"fraction\": " + std::to_string(at) + "}";
    const CaseRun run = run_text(cable, {"loads[0]" + place, "output.probes[0]" + place});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("p.z [m]"), height, 1e-6 + 1e-6 * std::abs(height)) << at;
  }
}

TEST(Kinks, AreMissedWithAWordWhereElementsAreTooFew) {
  const CaseRun run = run_file(case_file("rope_point_load_20.json"), {count(1)});
  EXPECT_TRUE(run.says("loads[0]: makes no kink, as the beam has too few elements for a node there"))
      << run.messages;
  EXPECT_FALSE(run_file(case_file("rope_point_load_20.json"), {count(2)}).says("makes no kink"));
}

TEST(Kinks, AreCountedByTheToleranceOfElements) {
  const CaseRun run = run_file(case_file("rope_point_load_tolerance.json"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.z [m]"), -34.9588, 0.0305);
}

// A rope of 100 N m^2 over 50 m: its kinks sink by a few centimetres where bending would round them. Another
// load, another span, a clamp.
TEST(Kinks, AreNoneWhereTheToleranceOfElementsForbidsThem) {
  const auto rope = [](double span, double slack, double bending, const std::string& start,
                       const std::string& elements) {
    const CaseRun run =
        run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [)" +
                 std::to_string(span) + R"(, 0, 0]] }, "section": { "area": 5.484e-4, "second_moment": )" +
                 std::to_string(bending) + R"(e-11 }, "material": { "density": 8573, "youngs_modulus": 1e11 },
        "elements": )" +
                 elements + R"(, "unstressed_length": )" + std::to_string(slack * span) +
                 R"(, "stress_free": "straight" }],
      "supports": [{ "beam": "b", "at": "start", "type": ")" +
                 start + R"(" },
                   { "beam": "b", "at": "end", "type": "pinned" }],
      "loads": [{ "beam": "b", "at": { "fraction": 0.5 }, "force": [0, 0, -3000] }],
      "analysis": { "type": "static" },
      "output": { "report": false, "probes": [{ "name": "p", "beam": "b", "at": { "fraction": 0.5 } },
                                              { "name": "q", "beam": "b", "at": { "fraction": 0.02 } }] } })");
    EXPECT_EQ(run.code, 0) << run.messages;
    return std::array{run.last("p.z [m]"), run.last("q.z [m]")};
  };
  for (const auto& [span, bending, start] :
       {std::tuple(50.0, 100.0, "pinned"), std::tuple(50.0, 100.0, "clamped"),
        std::tuple(20.0, 10.0, "pinned")}) {
    const auto right = rope(span, 1.02, bending, start, R"({ "count": 400 })");
    for (const double tolerance : {1e-3, 1e-4, 2e-5}) {
      const auto found =
          rope(span, 1.02, bending, start, R"({ "tolerance": )" + std::to_string(tolerance) + " }");
      for (const int i : {0, 1})
        EXPECT_NEAR(found[i], right[i], tolerance * span) << span << start << tolerance;
    }
  }
}

TEST(Kinks, LetANetOfCablesConverge) {
  const auto sag = [](int elements) {
    std::vector<std::string> counts;
    for (int b = 0; b < 4; ++b)
      counts.push_back("beams[" + std::to_string(b) + "].elements.count=" + std::to_string(elements));
    return run_file(case_file("cable_net.json"), counts).last("n11.z [m]");
  };
  const double right = sag(48), coarse = std::abs(sag(6) - right), fine = std::abs(sag(12) - right),
               finest = std::abs(sag(24) - right);
  EXPECT_LT(finest, 1e-3 * std::abs(right));
  EXPECT_TRUE(fine < 1e-9 * std::abs(right) || fine < coarse / 4) << coarse << " " << fine;
  EXPECT_TRUE(finest < 1e-9 * std::abs(right) || finest < fine / 4) << fine << " " << finest;
}

// Two straight parts of a string without weight, with the tension of Green's law.
TEST(Kinks, MakeALoadedStringOfTwoStraightParts) {
  const CaseRun run = run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [3, 0, 0]] },
      "section": { "area": 1e-5, "second_moment": 1e-16 }, "material": { "density": 1000, "youngs_modulus": 1e8 },
      "elements": { "count": 3 }, "unstressed_length": 2.9, "stress_free": "straight" }],
    "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                 { "beam": "string", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "string", "at": { "fraction": 0.5 }, "force": [0, 0, -10] }],
    "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "p", "beam": "string", "at": { "fraction": 0.5 } }] } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  const double z = -run.last("p.z [m]"), half = std::hypot(1.5, z), stretch = 2 * half / 2.9;
  EXPECT_NEAR(2 * 1e3 * (stretch * stretch - 1) / 2 * stretch * z / half, 10, 1e-6);
}

// M = (F/2) sqrt(EI/H), sigma = N/A + M c/I, with any mesh: H = 32.270 kN by an integral of the stretch of
// both halves, which hang in parabolas, and c/I of the rope's wires.
TEST(BendingLayers, HaveMomentAndStressOfARopeUnderATrolley) {
  for (const int elements : {20, 40, 80, 320}) {
    const CaseRun run =
        run_file(case_file("rope_stress_single_span.json"), {count(elements), "output.report=false"});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("rope.moment.max [N m]"), -2.158, 2e-3) << elements;
    EXPECT_NEAR(run.last("rope.stress.max [Pa]"), 435e6, 0.5e6) << elements;
    EXPECT_FALSE(run.says("fiftieth")) << run.messages;
  }
}

TEST(BendingLayers, AreToldOfInRunJson) {
  const TemporaryDirectory directory;
  std::ostringstream out, err;
  run_command_line({"run", case_file("rope_stress_single_span.json").string(), "--quiet", "--out",
                    (directory.path() / "r").string()},
                   out, err);
  const auto run = nlohmann::json::parse(std::ifstream(directory.path() / "r/run.json"));
  bool found = false;
  for (const auto& extreme : run["extremes"])
    if (extreme["quantity"] == "rope.moment.max") {
      found = true;
      EXPECT_NEAR(extreme.value("in a layer of [m]", 0.0), 5.116e-3, 1e-5);
      EXPECT_NEAR(extreme["s [m]"].get<double>(), 50, 1e-6);
    }
  EXPECT_TRUE(found);
  const auto& slope = run["model"]["slopes"].at(0);
  EXPECT_EQ(slope["slope"], "discontinuous");
  EXPECT_EQ(slope["of"], "sliding_joints[0]");
}

// A probe in the layer sees it fall off with exp(-s/reach).
TEST(BendingLayers, AreSeenByProbes) {
  const CaseRun run = run_text(rope_on(pinned_ends, R"(
    "loads": [{ "beam": "rope", "at": { "length": 40 }, "force": [0, 0, -800] }], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "at", "beam": "rope", "at": { "length": 40 } },
                                            { "name": "near", "beam": "rope", "at": { "length": 40.01 } },
                                            { "name": "far", "beam": "rope", "at": { "length": 41 } }] })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double moment = run.last("at.moment [N m]"),
               reach = std::sqrt(0.832 / run.last("at.axial_force [N]"));
  EXPECT_NEAR(moment, run.last("rope.moment.max [N m]"), 1e-3);
  EXPECT_NEAR(run.last("near.moment [N m]"), moment * std::exp(-0.01 / reach), 0.03 * std::abs(moment));
  EXPECT_LT(std::abs(run.last("far.moment [N m]")), 0.01 * std::abs(moment));
  EXPECT_NEAR(run.last("at.stress [Pa]"), run.last("rope.stress.max [Pa]"), 1e5);
}

// A clamp turns the rope into its direction within the layer: a sqrt(EI T).
TEST(BendingLayers, StandAtClamps) {
  const std::string clamped = R"({ "beam": "rope", "at": "start", "type": "clamped" },
                                 { "beam": "rope", "at": "end", "type": "pinned" })";
  for (const int elements : {20, 80}) {
    const CaseRun run = run_text(rope_on(clamped, a_static), {count(elements)});
    ASSERT_EQ(run.code, 0) << run.messages;
    // w L/2 at the end, of which T cos takes none.
    const double N = run.last("rope.axial_force.max [N]"), w = 110e-6 * 8200 * 9.81;
    EXPECT_NEAR(std::abs(run.last("rope.moment.max [N m]")), w * 50 / N * std::sqrt(0.844638 * N), 0.03)
        << elements;
  }
}

// A trolley rides over the support at a tower, where the rope has a kink of its own: it keeps its energy, and
// stresses stay those of a wire rope. (With a slope that is one on both sides they were 17 GPa.)
TEST(BendingLayers, AreBelievableOnARideOverATower) {
  const CaseRun run = run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [150, 0, -15]] }, "tension": "40 kN",
      "stress_free": "straight", "section": { "rope": { "diameter": "16 mm", "metallic_area": "110 mm^2" } },
      "material": { "density": 8200, "youngs_modulus": "100 GPa", "damping": 1e-4 }, "elements": { "count": 30 } }],
    "bodies": [{ "name": "trolley", "mass": 86 }],
    "supports": [{ "beam": "rope", "at": "start", "type": "pinned" },
                 { "beam": "rope", "at": { "fraction": 0.3333333 }, "type": "pinned" },
                 { "beam": "rope", "at": { "fraction": 0.6666667 }, "type": "pinned" },
                 { "beam": "rope", "at": "end", "type": "pinned" }],
    "sliding_joints": [{ "body": "trolley", "beam": "rope", "at": { "length": 44 }, "speed": 12 }],
    "analysis": { "initial": "equilibrium", "end_time": 1.2, "step": 4e-3 },
    "output": { "report": false, "every": 0.02 } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says("fiftieth")) << run.messages;
  EXPECT_GT(run.last("trolley.s [m]"), 55);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 5);
  // sqrt(v^2 + 2 g h) of the trolley alone; the rope takes a little.
  const double h = run.value(0, "trolley.z [m]") - run.last("trolley.z [m]");
  EXPECT_NEAR(run.last("trolley.speed [m/s]"), std::sqrt(144 + 2 * 9.81 * h), 0.03);
  for (std::size_t row = 0; row < run.rows.size(); ++row) {
    EXPECT_LT(run.value(row, "rope.stress.max [Pa]"), 1e9);
    EXPECT_GT(run.value(row, "rope.stress.max [Pa]"), 360e6);
  }
}

TEST(Kinks, AreNoneOnAStiffBeam) {
  const auto deflection = [](const std::string& slope) {
    return run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "rail", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] },
        "section": { "area": 2e-3, "second_moment": 4e-6 }, "material": { "density": 7850, "youngs_modulus": 2.1e11 } }],
      "supports": [{ "beam": "rail", "at": "start", "type": "pinned" },
                   { "beam": "rail", "at": { "fraction": 0.5 }, "type": "pinned" },
                   { "beam": "rail", "at": "end", "type": "pinned" }],
      "loads": [{ "beam": "rail", "at": { "length": 2.3 }, "force": [0, 0, -8000])" +
                    slope + R"( }],
      "analysis": { "type": "static" },
      "output": { "report": false, "probes": [{ "name": "p", "beam": "rail", "at": { "length": 2.3 } }] } })")
        .last("p.z [m]");
  };
  EXPECT_EQ(deflection(""), deflection(R"(, "slope": "continuous")"));
}

TEST(Kinks, AreRefusedOrWarnedOfWhereTheyCannotBeOrShouldBe) {
  const auto says = [](const std::string& load, const std::string& part) {
    const CaseRun run = run_text(rope_on(pinned_ends, R"("loads": [)" + load + "], " + a_static));
    EXPECT_TRUE(run.says(part)) << run.messages;
    return run.code;
  };
  EXPECT_EQ(says(R"({ "beam": "rope", "at": { "length": 40 }, "force": [0, 0, -1], "slope": "discontinuous",
                      "moves": { "speed": 1 } })",
                 "moves along the beam"),
            2);
  EXPECT_EQ(
      says(R"({ "beam": "rope", "at": { "length": 40 }, "force": [0, 0, -800], "slope": "continuous" })",
           "sags too little"),
      0);
}

// A string with a mass in its middle: in phase, x tan(x) = (mass of the string)/(mass) with x = omega L/(2c).
TEST(Kinks, GiveAStringWithAMassItsFrequency) {
  const auto frequency = [](int elements) {
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory.write("modes.json", R"({ "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] }, "tension": 1000,
        "section": { "area": 1e-4, "second_moment": 1e-14 }, "material": { "density": 1000, "youngs_modulus": 1e9 },
        "torsion": false }],
      "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                   { "beam": "string", "at": "end", "type": "pinned" }],
      "connectors": [{ "name": "c", "from": { "beam": "string", "at": { "fraction": 0.5 } },
        "to": { "point": [5, 0, 1] }, "stiffness": 0, "end_masses": [3, 0] }],
      "analysis": { "type": "modes", "modes": { "count": 8, "about": "drawn" } }, "output": { "report": false } })");
    std::ostringstream out, err;
    EXPECT_EQ(run_command_line({"run", file.string(), "--quiet", "--out", (directory.path() / "r").string(),
                                "--set", count(elements)},
                               out, err),
              0)
        << err.str();
    const auto run = nlohmann::json::parse(std::ifstream(directory.path() / "r/run.json"));
    for (const auto& mode : run["modes"])
      if (mode["frequency [Hz]"].get<double>() > 0.5) return mode["frequency [Hz]"].get<double>();
    return 0.0;
  };
  double x = 0.5;  // Newton's method
  for (int i = 0; i < 50; ++i)
    x -= (x * std::tan(x) - 1.0 / 3) / (std::tan(x) + x / std::pow(std::cos(x), 2));
  const double c = std::sqrt(1000 / 0.1), right = x * c / 5 / (2 * M_PI);
  EXPECT_NEAR(frequency(8), right, 1e-5 * right);
}

}  // namespace
}  // namespace nurbeam::test
