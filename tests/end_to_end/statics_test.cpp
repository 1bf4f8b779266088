#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "pipelines/verification/verify_oracles.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using std::numbers::pi;
using test::CaseRun;
using namespace verification;

CaseRun run(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const CaseRun result = test::run_file(test::sample("statics/" + name), overrides);
  EXPECT_EQ(result.code, 0) << result.messages;
  EXPECT_EQ(result.rows.size(), 1u);
  return result;
}

std::string set(const std::string& path, double value) {
  std::ostringstream text;
  text.precision(17);
  text << path << "=" << value;
  return text.str();
}
std::string set_y(const std::string& path, double value) {
  return set(path, value).replace(path.size() + 1, 0, "[0,") + ",0]";
}

// ---- Cantilevers ----

// Full Newton steps also lead to another of its equilibria.
TEST(Frame, IsWhereItsLoadInStepsBringsIt) {
  const std::string frame = R"({ "nurbeam": 1, "beams": [{ "name": "w", "corners": "rigid",
      "axis": { "polyline": [[0, 0, 0], [5, 0, 0], [5, 0, 5]] }, "section": { "radius": 0.027 },
      "material": { "density": 7850, "youngs_modulus": 2e11 }, "elements": { "count": 5 } }],
    "supports": [{ "beam": "w", "at": "start", "type": "clamped" }],
    "loads": [{ "beam": "w", "at": "end", "force": [-12089.8, 0, -31007.9] }], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "e", "beam": "w", "at": "end" }] } })";
  const CaseRun once = test::run_text(frame), steps = test::run_text(frame, {"analysis.load_steps=50"});
  ASSERT_EQ(once.code, 0) << once.messages;
  ASSERT_EQ(steps.code, 0) << steps.messages;
  EXPECT_NEAR(once.last("e.x [m]"), steps.last("e.x [m]"), 1e-7);
  EXPECT_NEAR(once.last("e.z [m]"), steps.last("e.z [m]"), 1e-7);
}

// Nothing is strained: what is left of forces and reactions after a step is round-off, from which the next
// one starts.
TEST(Cantilever, GoesWithItsClampInSteps) {
  const std::string cantilever = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] },
      "section": { "rectangle": [0.03, 0.02] },
      "material": { "density": 1000, "youngs_modulus": 2e11, "poissons_ratio": 0.3 },
      "elements": { "count": 8 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped",
                   "motion": [[0, 0, 0, 0], [0.6, 0.01, 0.005, 0.02], [1, 0.01, 0.005, 0.02]] }],
    "analysis": { "type": "static", "load_steps": 5 },
    "output": { "report": false, "probes": [{ "name": "e", "beam": "b", "at": "end" }] } })";
  for (const char* torsion : {"true", "false"}) {
    const CaseRun r = test::run_text(cantilever, {std::string("beams[0].torsion=") + torsion});
    ASSERT_EQ(r.code, 0) << r.messages;
    ASSERT_EQ(r.rows.size(), 5u);
    EXPECT_NEAR(r.value(2, "e.z [m]"), 0.02, 1e-9);
    EXPECT_NEAR(r.last("e.x [m]"), 2.01, 1e-9);
    EXPECT_NEAR(r.last("e.y [m]"), 0.005, 1e-9);
    EXPECT_NEAR(r.last("e.z [m]"), 0.02, 1e-9);
  }
}

TEST(SimpleBeam, TiltsWithItsSupportInSteps) {
  const CaseRun r = test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] },
      "section": { "rectangle": [0.03, 0.02] }, "material": { "density": 1000, "youngs_modulus": 2e11 },
      "elements": { "count": 8 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" },
                 { "beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0],
                   "motion": [[0, 0, 0, 0], [1, 0, 0.02, 0]] }],
    "analysis": { "type": "static", "load_steps": 5 },
    "output": { "report": false, "probes": [{ "name": "e", "beam": "b", "at": "end" }] } })");
  ASSERT_EQ(r.code, 0) << r.messages;
  EXPECT_NEAR(r.last("e.x [m]"), std::sqrt(4 - 0.02 * 0.02), 1e-9);
}

TEST(RollUp, ClosesTheCircle) {
  const CaseRun r = run("rollup.json", {set("beams[0].elements.count", 200)});
  EXPECT_NEAR(r.last("tip.x [m]"), 0, 1e-8);
  EXPECT_NEAR(r.last("tip.y [m]"), 0, 1e-8);
  EXPECT_NEAR(r.last("beam.length [m]"), 1, 1e-8);
}

TEST(Elastica, TheOracleAgreesWithThePublishedTable) {
  EXPECT_NEAR(elastica_tip(1).y, -0.301721, 1e-6);
  EXPECT_NEAR(elastica_tip(5).x, 1 - 0.387628, 1e-6);
  EXPECT_NEAR(elastica_tip(10).y, -0.810609, 1e-6);
}

TEST(Elastica, ADeadTipLoadBendsTheBeamAsMattiassonSays) {
  for (const double q : {1.0, 2.0, 5.0, 10.0}) {
    const CaseRun r = run("elastica.json", {set_y("loads[0].force", -q)});
    EXPECT_NEAR(r.last("tip.x [m]"), elastica_tip(q).x, 1e-5) << q;
    EXPECT_NEAR(r.last("tip.y [m]"), elastica_tip(q).y, 1e-5) << q;
  }
}

// ---- Snapping through ----

// A flat truss of two hinged bars: P = E A (h^2 - u^2) u / l^3 at a rise of u, greatest at h / sqrt(3).
TEST(SnapThrough, OfATrussIsToldWithTheLoadThatItIsUnder) {
  const double h = 0.01, area = pi * 0.005 * 0.005, l = std::hypot(0.5, h);
  const double greatest = 2 / (3 * std::sqrt(3.0)) * 7e10 * area * std::pow(h, 3) / std::pow(l, 3);
  const std::string truss =
      R"({ "nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "b", "corners": "hinge",
      "axis": { "polyline": [[0, 0, 0], [0.5, 0.01, 0], [1, 0, 0]] }, "section": { "radius": 0.005 },
      "material": { "density": 2700, "youngs_modulus": 7e10 }, "elements": { "count": 8 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "b", "at": { "fraction": 0.5 }, "force": [0, -1, 0] }], "analysis": { "type": "static" },
    "output": { "report": false } })";
  const std::string told = "the model snaps through or buckles under ";
  for (const double over : {1.3, 4.0, 30.0}) {
    const CaseRun beyond = test::run_text(truss, {set_y("loads[0].force", -over * greatest)});
    ASSERT_EQ(beyond.code, 0) << beyond.messages;
    const auto at = beyond.messages.find(told);
    ASSERT_NE(at, std::string::npos) << over << beyond.messages;
    EXPECT_NEAR(std::stod(beyond.messages.substr(at + told.size())), 1 / over, 2e-3) << over;
  }
  const CaseRun steps =
      test::run_text(truss, {set_y("loads[0].force", -4 * greatest), "analysis.load_steps=10"});
  EXPECT_TRUE(steps.says(told + "0.25 of its loads")) << steps.messages;
  const CaseRun below = test::run_text(truss, {set_y("loads[0].force", -0.97 * greatest)});
  ASSERT_EQ(below.code, 0) << below.messages;
  EXPECT_FALSE(below.says(told)) << below.messages;
}

// It may buckle to either side.
TEST(SnapThrough, IsToldOfAStraightStrutThatBuckles) {
  const double euler = pi * pi * 7e10 * pi * std::pow(0.005, 4) / 4;
  const std::string strut = R"({ "nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "b",
      "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.005 },
      "material": { "density": 2700, "youngs_modulus": 7e10 }, "elements": { "count": 12 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" },
                 { "beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0] }],
    "loads": [{ "beam": "b", "at": "end", "force": [0, 0, 0] }], "analysis": { "type": "static" },
    "output": { "report": false } })";
  const auto pressed = [&](double over) {
    const std::string force = set("loads[0].force", -over * euler);
    const auto value = force.find('=') + 1;
    return test::run_text(strut, {force.substr(0, value) + "[" + force.substr(value) + ",0,0]"});
  };
  EXPECT_TRUE(pressed(1.6).says("buckles under 0.62")) << pressed(1.6).messages;
  EXPECT_FALSE(pressed(0.99).says("buckles")) << pressed(0.99).messages;
}

// By 4 pi^2 EI/L^2, of which heat and a drawn thrust of 12 kN have more; weight buckles at 7.837 EI/L^3.
TEST(SnapThrough, IsToldOfWhatHeatThrustOrWeightBuckles) {
  const auto bar = [](const std::string& axis, const std::string& more) {
    return R"({ "nurbeam": 1, "gravity": [0, 0, -3433.5], "beams": [{ "name": "b",
        "axis": { "polyline": [[0, 0, 0], )" +
           axis + R"(] }, "section": { "area": 1e-4, "second_moment": 1e-9 },
        "material": { "density": 7800, "youngs_modulus": 2e11, "thermal_expansion": 1e-5 },
        "elements": { "count": 8 } }], "analysis": { "type": "static" }, "output": { "report": false },
      "supports": [{ "beam": "b", "at": "start", "type": "clamped" })" +
           more + "] }";
  };
  const std::string held = bar("[1, 0, 0]", R"(, { "beam": "b", "at": "end", "type": "clamped" })"),
                    stands = bar("[0, 0, 1]", ""), weightless = "gravity=[0, 0, 0]";
  const CaseRun hot = test::run_text(held, {weightless, "beams[0].temperature=60"}),
                warm = test::run_text(held, {weightless, "beams[0].temperature=38"}),
                pressed = test::run_text(held, {weightless, "beams[0].tension=-12000"}),
                heavy = test::run_text(stands, {}),
                in_steps = test::run_text(stands, {"analysis.load_steps=[0.1, 0.5, 1]"});
  for (const CaseRun* run : {&hot, &warm, &pressed, &heavy, &in_steps})
    ASSERT_EQ(run->code, 0) << run->messages;
  EXPECT_TRUE(hot.says("buckles under 0.65")) << hot.messages;
  EXPECT_FALSE(warm.says("buckles")) << warm.messages;
  EXPECT_TRUE(pressed.says("buckles without any load")) << pressed.messages;
  EXPECT_TRUE(heavy.says("buckles under 0.58")) << heavy.messages;
  EXPECT_FALSE(heavy.says("load_steps")) << heavy.messages;
  EXPECT_TRUE(in_steps.says(" of its weight and 0.058")) << in_steps.messages;
}

// What moves far, but smoothly, is on one branch.
TEST(SnapThrough, IsNotToldOfWhatMovesFar) {
  const CaseRun bent = run("elastica.json", {set_y("loads[0].force", -10)});
  EXPECT_FALSE(bent.says("buckles")) << bent.messages;
  const CaseRun rolled = run("rollup.json");
  EXPECT_FALSE(rolled.says("buckles")) << rolled.messages;
  const CaseRun hanging = test::run_text(R"({ "nurbeam": 1, "gravity": [0, -9.81, 0], "beams": [{ "name": "b",
      "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] }, "section": { "radius": 0.002 },
      "unstressed_length": 10.5, "material": { "density": 7850, "youngs_modulus": 2e11 },
      "elements": { "count": 20 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "b", "at": { "fraction": 0.3 }, "force": [0, -50, 0] }], "analysis": { "type": "static" },
    "output": { "report": false } })");
  ASSERT_EQ(hanging.code, 0) << hanging.messages;
  EXPECT_FALSE(hanging.says("buckles")) << hanging.messages;
}

// Along these axes the roll came out otherwise from load to load.
TEST(SnapThrough, IsNotToldOfARoundRodThatMayRollInItsPlace) {
  const auto rod = [](const std::string& end, const std::string& second, double at, const std::string& load,
                      const std::vector<std::string>& overrides = {}) {
    return test::run_text(
        R"({ "nurbeam": 1, "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], )" + end +
            R"(] }, "section": { "radius": 0.01 }, "material": { "name": "steel" }, "torsion": true,
        "elements": { "count": 10 } }],
      "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", )" +
            second + R"( }], "loads": [{ "beam": "b", "at": { "fraction": )" + std::to_string(at) +
            R"( }, "force": )" + load + R"( }], "analysis": { "type": "static" },
      "output": { "report": false } })",
        overrides);
  };
  for (const char* const end : {"[2, 0, 0]", "[1.2, -1.6, 0]", "[1.7320508075688772, 0, 1]"}) {
    const CaseRun bent = rod(end, R"("type": "pinned")", 0.4, "[0, 0, -60]");
    ASSERT_EQ(bent.code, 0) << end << bent.messages;
    EXPECT_EQ(bent.messages, "") << end;
  }
  // Pressed along its axis it buckles with all that.
  const CaseRun buckled = rod("[1.2, -1.6, 0]", R"("type": "guided", "direction": [0.6, -0.8, 0])", 1,
                              "[-2640, 3520, 0]", {"gravity=[0, 0, 0]"});
  ASSERT_EQ(buckled.code, 0) << buckled.messages;
  EXPECT_TRUE(buckled.says("buckles under 0.92")) << buckled.messages;
}

// ---- Struts ----

/// A steel bar of 2 m along z, clamped at its start A; its middle is p, its end e.
std::string strut(const std::string& of_the_beam, const std::string& loads, bool held = false) {
  const std::string end = held ? R"(, { "beam": "b", "at": "end", "type": "clamped" })" : "";
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, 2]] }, "elements": { "count": 20 },
                "material": { "density": 7800, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3,
                              "thermal_expansion": 1e-5 }, )" +
         of_the_beam + R"( }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped", "name": "A" })" +
         end + R"(], "loads": [)" + loads + R"(], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "p", "beam": "b", "at": { "fraction": 0.5 } },
                                            { "name": "e", "beam": "b", "at": "end" }] } })";
}

// By 100 K to three times Euler's load N = 4 pi^2 EI/L^2. It bends to a/2 (1 - cos(2 pi z/L)), as far as it
// is too long under N: pi^2 a^2/(4 L).
TEST(Strut, ThatIsHeatedBucklesUnderLoadsWithoutEnergyToo) {
  const double EI = 2.1e11 * 0.03 * std::pow(0.02, 3) / 12, EA = 2.1e11 * 6e-4, N = pi * pi * EI;
  const double a = 4 / pi * std::sqrt(1e-3 - N / EA);
  for (const std::string load :
       {R"({ "beam": "b", "at": { "fraction": 0.4 }, "force": [50, 0, 0], "follower": true })",
        R"({ "beam": "b", "at": { "fraction": 0.4 }, "moment": [0, 20, 0] })",
        R"({ "beam": "b", "at": { "fraction": 0.4 }, "moment": [0, 0, 20] })",
        R"({ "beam": "b", "torque_per_length": 20 })"}) {
    const CaseRun r = test::run_text(strut(
        R"("section": { "rectangle": [0.02, 0.03] }, "torsion": true, "temperature": 100)", load, true));
    ASSERT_EQ(r.code, 0) << load << r.messages;
    EXPECT_NEAR(r.last("A.fz [N]"), N, 2e-3 * N) << load;
    EXPECT_NEAR(std::abs(r.last("p.uy [m]")), a, 2e-3 * a) << load;
  }
}

/// The end of an elastica that is clamped at its start, of length 2, under q times its critical load.
struct ElasticaEnd {
  double along, across;
};
ElasticaEnd buckled_end(double q) {
  double low = 0, high = 1;  // p with K(p) = pi/2 sqrt(q)
  for (int i = 0; i < 60; ++i) {
    const double p = (low + high) / 2;
    (std::comp_ellint_1(p) < pi / 2 * std::sqrt(q) ? low : high) = p;
  }
  const double K = std::comp_ellint_1(low);
  return {2 * (2 * std::comp_ellint_2(low) / K - 1), 4 * low / K};
}

std::string force(const std::string& at, double x, double z, bool follower = false) {
  std::ostringstream text;
  text.precision(17);
  text << R"({ "beam": "b", "at": )" << at << R"(, "force": [)" << x << ", 0, " << z << R"(], "follower": )"
       << (follower ? "true }" : "false }");
  return text.str();
}
const std::string round = R"("section": { "radius": 0.01 })";
const double round_EI = 2.1e11 * pi * 1e-8 / 4;

TEST(Strut, InAPlaneBucklesBesideALoadThatFollows) {
  const CaseRun r = test::run_text(strut(round, force(R"("end")", 0, -4 * pi * pi / 16 * round_EI) + ", " +
                                                    force(R"({ "fraction": 0.5 })", 0.01, 0, true)));
  ASSERT_EQ(r.code, 0) << r.messages;
  EXPECT_NEAR(r.last("e.z [m]"), buckled_end(4).along, 2e-3);
  EXPECT_NEAR(std::abs(r.last("e.ux [m]")), buckled_end(4).across, 2e-3);
}

// Without anything that breaks the symmetry about its axis one state is as good as all around it.
TEST(Strut, ThatIsRoundAndHasTorsionBucklesIntoAnyPlane) {
  for (const double lateral : {0.0, 1e-3, 1e-2, 0.1}) {
    const CaseRun r = test::run_text(
        strut(round + R"(, "torsion": true)",
              force(R"("end")", 0, -3.9 * pi * pi / 16 * round_EI) + ", " + force(R"("end")", lateral, 0)));
    ASSERT_EQ(r.code, 0) << lateral << r.messages;
    EXPECT_NEAR(r.last("e.z [m]"), buckled_end(3.9).along, 2e-3) << lateral;
    EXPECT_NEAR(std::hypot(r.last("e.ux [m]"), r.last("e.uy [m]")), buckled_end(3.9).across, 2e-3) << lateral;
  }
}

// Beck's column flutters above 20.05 EI/L^2, and never leaves without it: not above the 2.47 of a force that
// keeps its direction. The force of 40 nothing holds, with any damping.
TEST(Strut, UnderAForceThatFollowsItsEndStaysStraight) {
  for (const double P : {2.4, 5.0, 10.0, 19.0}) {
    const CaseRun r = test::run_text(strut(round, force(R"("end")", 0, -P * round_EI / 4, true)));
    ASSERT_EQ(r.code, 0) << P << r.messages;
    EXPECT_LT(std::abs(r.last("e.ux [m]")), 1e-9) << P;
    EXPECT_FALSE(r.says("unstable")) << P;
  }
  const CaseRun r = test::run_text(strut(round, force(R"("end")", 0, -40 * round_EI / 4, true)));
  EXPECT_TRUE(r.says("the equilibrium is unstable")) << r.messages;
}

// ---- Hanging cables ----

constexpr StringLaw cable{.EA = 1e6, .w = 10};

TEST(Catenary, TheOracleGivesThePublishedValues) {
  const Hanging straight = hang(cable, 100, 100, 0), slack = hang(cable, 102, 100, 0);
  EXPECT_NEAR(straight.H, 3462.027912, 1e-6);
  EXPECT_NEAR(cable.shape(straight.H, 0, 50).y, 3.60440202, 1e-8);
  EXPECT_NEAR(slack.H, 1396.162404, 1e-6);
  EXPECT_NEAR(cable.shape(slack.H, 0, 51).y, 9.03621513, 1e-8);
}

TEST(Catenary, HangsFromTheStraightAndTheSlackStart) {
  for (const auto& [name, length] :
       {std::pair{"catenary_straight.json", 100.0}, {"catenary_slack.json", 102.0}}) {
    const Hanging exact = hang(cable, length, 100, 0);
    const StringShape half = cable.shape(exact.H, 0, length / 2);
    const CaseRun r = run(name);
    EXPECT_NEAR(r.last("middle.y [m]"), -half.y, 1e-6 * half.y);
    EXPECT_NEAR(r.last("middle.x [m]"), 50, 1e-6);
    // The axial energy is as the square of the horizontal force.
    EXPECT_NEAR(r.last("energy.axial [J]"), 2 * half.axial_energy, 2e-6 * 2 * half.axial_energy);
  }
}

// Pressed together as it is drawn, by up to millions of times Euler's load, with many equilibria about it. Of
// those that are stable, stiff wires have an arch too: from no load on they sag.
TEST(Catenary, HangsFromAStraightLineThatIsTooShortForIt) {
  struct Wire {
    double radius, length;
    int elements;
  };
  for (const Wire& wire : {Wire{0.0005, 11, 17},
                           {0.0005, 15, 17},
                           {0.002, 12, 12},
                           {0.002, 15, 5},
                           {0.005, 12, 5},
                           {0.005, 15, 37},
                           {0.01, 11, 25},
                           {0.01, 10.3, 10},
                           {0.03, 10.01, 5},
                           {0.03, 15, 37}}) {
    std::ostringstream text;
    text << R"({ "nurbeam": 1, "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] },
        "section": { "radius": )"
         << wire.radius << R"( }, "material": { "density": 7850, "youngs_modulus": 2e11 },
        "unstressed_length": )"
         << wire.length << R"(, "elements": { "count": )" << wire.elements << R"( } }],
      "supports": [{ "beam": "wire", "at": "start", "type": "pinned" },
                   { "beam": "wire", "at": "end", "type": "pinned" }],
      "analysis": { "type": "static" }, "output": { "report": false } })";
    const CaseRun r = test::run_text(text.str());
    ASSERT_EQ(r.code, 0) << wire.radius << " " << wire.length << r.messages;
    const double area = pi * wire.radius * wire.radius;
    const StringLaw rope{.EA = 2e11 * area, .w = 7850 * 9.81 * area};
    const double sag = rope.shape(hang(rope, wire.length, 10, 0).H, 0, wire.length / 2).y;
    const double stiffness = wire.radius < 0.01 ? 0.02 : wire.length > 10.02 ? 0.1 : 0.3;  // a part of it
    EXPECT_NEAR(r.last("wire.sag [m]"), sag, stiffness * sag) << wire.radius << " " << wire.length;
  }
}

TEST(Catenary, HangsFromAStraightWireOnAnyMesh) {
  const double area = pi * 1e-4;
  const StringLaw rope{.EA = 1e11 * area, .w = 7800 * 9.81 * area};
  const double sag = rope.shape(hang(rope, 1000, 1000, 0).H, 0, 500).y;
  for (const int elements : {30, 500, 2000}) {
    std::ostringstream text;
    text << R"({ "nurbeam": 1, "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [1000, 0, 0]] },
        "section": { "radius": 0.01 }, "material": { "density": 7800, "youngs_modulus": 1e11 },
        "elements": { "count": )"
         << elements << R"( } }],
      "supports": [{ "beam": "wire", "at": "start", "type": "pinned" },
                   { "beam": "wire", "at": "end", "type": "pinned" }],
      "analysis": { "type": "static" }, "output": { "report": false } })";
    const CaseRun r = test::run_text(text.str());
    ASSERT_EQ(r.code, 0) << elements << r.messages;
    EXPECT_FALSE(r.says("warning")) << r.messages;
    EXPECT_NEAR(r.last("wire.sag [m]"), sag, (elements < 100 ? 1e-3 : 1e-4) * sag) << elements;
  }
}

// The row of a fork has entries of round-off where the beam is nearly straight.
TEST(Fork, OfABeamThatIsUnloadedHoldsItsTorque) {
  for (const int elements : {5, 10, 30})
    for (const double place : {0.3, 0.5})
      for (const double force : {20.0, 200.0}) {
        std::ostringstream text;
        text << R"({ "nurbeam": 1, "gravity": [0, 0, 0], "beams": [{ "name": "b", "torsion": true,
            "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.01 },
            "material": { "density": 7800, "youngs_modulus": 2.1e11, "poissons_ratio": 0.3 },
            "elements": { "count": )"
             << elements << R"( } }],
          "supports": [{ "beam": "b", "at": "start", "type": "fork", "name": "S" },
                       { "beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0] }],
          "loads": [{ "beam": "b", "at": { "fraction": )"
             << place << R"( }, "force": [0, 0, )" << -force << R"(], "time": [[0, 1], [1, 0]] },
                    { "beam": "b", "at": "end", "moment": [2, 0, 0], "time": [[0, 1], [1, 1]] }],
          "analysis": { "type": "static", "load_steps": [0.5, 1] }, "output": { "report": false } })";
        const CaseRun r = test::run_text(text.str());
        ASSERT_EQ(r.code, 0) << r.messages;
        EXPECT_NEAR(r.last("S.mx [N m]"), -2, 1e-6) << elements << " " << place << " " << force;
      }
}

// Stiff enough to stand, it hangs all the same.
TEST(Catenary, HangsWhereAnArchWouldStandToo) {
  for (const char* support : {"clamped", "pinned"})
    for (const double length : {1.109, 1.2, 1.5})
      for (const double weight : {1.0, 2.0, 5.0, 10.0}) {  // of it all, in EI/L^2
        const std::string ends = std::string(R"(", "type": ")") + support + "\" }";
        std::ostringstream text;
        text << R"({ "nurbeam": 1, "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
            "section": { "radius": )"
             << std::sqrt(7800 * 9.81 * 4 / (2e11 * weight))
             << R"( }, "material": { "density": 7800, "youngs_modulus": 2e11 }, "unstressed_length": )"
             << length << R"(, "elements": { "count": 12 } }], "supports": [{ "beam": "wire", "at": "start)"
             << ends << R"(, { "beam": "wire", "at": "end)" << ends << R"(], "analysis": { "type": "static" },
            "output": { "report": false, "probes": [{ "name": "m", "beam": "wire", "at": { "fraction": 0.5 } }] } })";
        const CaseRun r = test::run_text(text.str());
        ASSERT_EQ(r.code, 0) << r.messages;
        EXPECT_LT(r.last("m.z [m]"), -0.15) << support << length << " " << weight;
      }
}

TEST(Catenary, HangsBetweenUnevenSupports) {
  const Hanging stiff = hang({.EA = 1e15, .w = 10}, 105, 100, -20);
  const double a = stiff.H / 10;
  EXPECT_NEAR(105 * 105 - 20 * 20, std::pow(2 * a * std::sinh(100 / (2 * a)), 2), 1e-5);

  const Hanging exact = hang(cable, 105, 100, -20);
  const StringShape half = cable.shape(exact.H, exact.V, 52.5);
  const CaseRun r = run("catenary_uneven.json");
  EXPECT_NEAR(r.last("middle.x [m]"), half.x, 1e-6 * half.x);
  EXPECT_NEAR(r.last("middle.y [m]"), half.y, -1e-6 * half.y);
}

// ---- Resting places ----

/// Where a frictionless bead rests on a string between (0, 0) and (span, rise): both parts pull it alike, so
/// each carries half its weight.
struct RestingPlace {
  double s, x, y;
};

RestingPlace resting_place(const StringLaw& law, double bead_weight, double length, double span,
                           double rise) {
  const double V = bead_weight / 2;
  const auto left_length = [&](double H) {
    return root([&](double s) { return law.shape(H, V, s).y - law.shape(H, V, length - s).y + rise; }, 0,
                length);
  };
  const double H = root(
      [&](double h) {
        const double s = left_length(h);
        return law.shape(h, V, s).x + law.shape(h, V, length - s).x - span;
      },
      1e-3, 1e5);
  const double s = left_length(H);
  const StringShape left = law.shape(H, V, s);
  return {s, left.x, -left.y};
}

TEST(RestingPlace, OfABeadIsWhereBothPartsOfTheCablePullAlike) {
  const StringLaw law{.EA = 1e6, .w = 9.81};
  for (const auto& [name, length, rise] :
       {std::tuple{"bead_level.json", 102.0, 0.0}, {"bead_uneven.json", 105.0, -20.0}}) {
    const RestingPlace exact = resting_place(law, 40 * 9.81, length, 100, rise);
    const CaseRun r = run(name);
    EXPECT_NEAR(r.last("bead.s [m]"), exact.s, 1e-6 * length) << name;
    EXPECT_NEAR(r.last("bead.x [m]"), exact.x, 1e-6 * length) << name;
    EXPECT_NEAR(r.last("bead.y [m]"), exact.y, 1e-6 * length) << name;
  }
}

TEST(RestingPlace, DoesNotDependOnWhereTheBeadWasDrawn) {
  for (const double at : {1.0, 60.0, 101.0}) {
    const CaseRun r = run("bead_level.json", {set("sliding_joints[0].at.length", at)});
    EXPECT_NEAR(r.last("bead.s [m]"), 51, 1e-6 * 102) << at;
  }
}

// On an incline, m g sin = k (s - l); under a spring that is pressed, beside the summit by sqrt(l^2 - 1);
// beside one that is pulled along the guide.
TEST(RestingPlace, OnAGuideIsThatOfItsSpring) {
  const auto place = [](const char* end, const char* from) {
    const test::TemporaryDirectory directory;
    const CaseRun r = test::run_file(
        directory.write("case.json", std::string(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{"name": "rail", "rigid": true, "axis": {"polyline": [[0, 0, 0], )json") +
                                         end + R"json(]}}],
      "bodies": [{"name": "m", "mass": 3}],
      "sliding_joints": [{"body": "m", "beam": "rail", "at": {"length": 5}}],
      "connectors": [{"name": "k", "from": {"point": )json" +
                                         from + R"json(}, "to": {"body": "m"}, "stiffness": 30, "length": 4}],
      "analysis": {"type": "static"}, "output": {"report": false}})json"));
    EXPECT_EQ(r.code, 0) << r.messages;
    return r.code == 0 ? r.last("m.s [m]") : NAN;
  };
  EXPECT_NEAR(place("[16, 0, -12]", "[0, 0, 0]"), 4 + 3 * 9.81 * 0.6 / 30, 1e-6);
  EXPECT_NEAR(std::abs(place("[20, 0, 0]", "[5, 0, 1]") - 5), std::sqrt(15), 1e-6);
  EXPECT_NEAR(place("[20, 0, 0]", "[20, 0, 0]"), 16, 1e-6);
}

// ---- Loads by the length in plan ----

// A cable that is drawn as a parabola with a sag f hangs so under an even load p in plan: H = p L^2/(8 f).
TEST(ProjectedLoad, HoldsACableInAParabola) {
  constexpr double p = 10, L = 100, f = 10;
  const std::string cable = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "c", "axis": { "nurbs": { "degree": 2, "knots": [0, 0, 0, 1, 1, 1],
        "control_points": [[0, 0, 0], [50, 0, -20], [100, 0, 0]] } }, "stress_free": "straight",
      "section": { "area": 1e-2, "second_moment": 1e-14 },
      "material": { "density": 1000, "youngs_modulus": 1e12 }, "elements": { "count": 20 } }],
    "supports": [{ "beam": "c", "at": "start", "type": "pinned", "name": "A" },
                 { "beam": "c", "at": "end", "type": "pinned", "name": "B" }],
    "loads": [{ "beam": "c", "force_per_projected_length": [0, 0, -10] }], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "quarter", "beam": "c", "at": { "near": [25, 0, -7.5] } }] } })";
  const CaseRun run = test::run_text(cable);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("A.fz [N]"), p * L / 2, 1e-4);
  EXPECT_NEAR(run.last("B.fz [N]"), p * L / 2, 1e-4);
  EXPECT_NEAR(run.last("B.fx [N]"), p * L * L / (8 * f), 0.1);
  EXPECT_NEAR(run.last("quarter.uz [m]"), 0, 1e-3 * f);
  // By the length along the axis, as its weight: more at the ends, and not in a parabola.
  const CaseRun along = test::run_text(cable, {R"(loads=[{"beam": "c", "force_per_length": [0, 0, -10]}])"});
  EXPECT_GT(along.last("A.fz [N]"), 1.02 * p * L / 2);
  EXPECT_GT(std::abs(along.last("quarter.uz [m]")), 1e-3);
}

// A rafter over 3 m in plan, with a slope of 4 to 3: p L^2/8 in its middle, by the length in plan.
TEST(ProjectedLoad, BendsARafterByItsLengthInPlan) {
  const std::string rafter = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "r", "axis": { "polyline": [[0, 0, 0], [3, 0, 4]] },
      "section": { "rectangle": [0.1, 0.2] }, "material": "steel", "elements": { "count": 2 } }],
    "supports": [{ "beam": "r", "at": "start", "type": "pinned", "name": "A" },
                 { "beam": "r", "at": "end", "type": "guided", "direction": [3, 0, 4] }],
    "loads": [{ "beam": "r", "force_per_projected_length": [0, 0, -1000] }], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "m", "beam": "r", "at": { "fraction": 0.5 } }] } })";
  for (const char* torsion : {"false", "true"}) {
    const CaseRun run = test::run_text(rafter, {std::string("beams[0].torsion=") + torsion});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(std::abs(run.last("m.moment [N m]")), 1000 * 3 * 3 / 8.0, 2) << torsion;
  }
}

}  // namespace
}  // namespace nurbeam
