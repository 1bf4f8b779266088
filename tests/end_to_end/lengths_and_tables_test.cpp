// What a beam's length, temperature, supports, loads and bodies are given besides the drawing: numbers and
// tables.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// A steel bar of 2 m and EA = 2e6 N between two walls, without weight.
constexpr double EA = 2e6;
const std::string bar = R"({
  "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] },
              "section": { "area": 1e-5, "second_moment": 1e-8 },
              "material": { "density": 7850, "youngs_modulus": 2e11, "thermal_expansion": 1.2e-5 },
              "elements": { "count": 4 } }],
  "supports": [{ "beam": "b", "at": "start", "type": "pinned", "name": "left" },
               { "beam": "b", "at": "end", "type": "pinned", "name": "right" }],
  "analysis": { "type": "static" },
  "output": { "report": false, "probes": [{ "name": "p", "beam": "b", "at": { "fraction": 0.5 } }] }
})";

CaseRun run_with_table(const std::string& text, const std::vector<std::string>& overrides,
                       const std::string& csv) {
  const TemporaryDirectory directory;
  directory.write("table.csv", csv);
  return run_file(directory.write("case.json", text), overrides);
}

// N = EA e lambda of a strain e of the unstressed length and its stretch lambda.
double tension(double stretch, double expansion = 0) {
  return EA * ((stretch * stretch - 1) / 2 - expansion) * stretch;
}

TEST(UnstressedLength, OfABarBetweenWallsIsItsTension) {
  const CaseRun run = run_text(bar, {"beams[0].unstressed_length=1.99"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double N = tension(2 / 1.99);
  EXPECT_NEAR(run.last("p.axial_force [N]"), N, 1e-9 * N);
  EXPECT_NEAR(run.last("left.fx [N]"), -N, 1e-9 * N);
  EXPECT_NEAR(run.last("right.fx [N]"), N, 1e-9 * N);
}

// What the summary calls unstressed is the length that the bar has at rest where only one end is held.
TEST(UnstressedLength, OfATensionIsThatOfABarThatCarriesIt) {
  const auto unstressed = [](const std::string& override) {
    const TemporaryDirectory directory;
    std::ostringstream out, err;
    const auto results = directory.path() / "results";
    EXPECT_EQ(run_command_line({"run", directory.write("case.json", bar).string(), "--quiet", "--out",
                                results.string(), "--set", override},
                               out, err),
              0);
    std::ifstream stream(results / "run.json");
    return nlohmann::json::parse(stream)["model"]["beams"][0]["unstressed length [m]"].get<double>();
  };
  const std::string tight = "beams[0].tension=5000";
  const CaseRun free = run_text(
      bar, {tight, R"(supports=[{"beam": "b", "at": "start", "type": "clamped"}])", "output.probes=[]"});
  ASSERT_EQ(free.code, 0) << free.messages;
  EXPECT_NEAR(unstressed(tight), free.last("b.length [m]"), 1e-12);
  EXPECT_NEAR(unstressed(tight), 2 / (1 + 5000 / EA), 4 * std::pow(5000 / EA, 2));
  EXPECT_DOUBLE_EQ(unstressed("beams[0].unstressed_length=1.99"), 1.99);
  EXPECT_DOUBLE_EQ(unstressed("beams[0].tension=0"), 2);
}

TEST(Temperature, OfABarBetweenWallsIsItsThrust) {
  const CaseRun run = run_text(bar, {"beams[0].temperature=50"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.axial_force [N]"), -EA * 1.2e-5 * 50, 1e-6);
  const CaseRun both = run_text(bar, {"beams[0].temperature=\"-30 K\"", "beams[0].unstressed_length=1.995"});
  ASSERT_EQ(both.code, 0) << both.messages;
  EXPECT_NEAR(both.last("p.axial_force [N]"), tension(2 / 1.995, -30 * 1.2e-5), 1e-6);
}

TEST(Temperature, LengthensAFreeEnd) {
  std::string one = bar;
  const auto second = one.find(",\n               { \"beam\": \"b\", \"at\": \"end\"");
  one.erase(second, one.find("}]", second) + 1 - second);
  const CaseRun free = run_text(one, {"beams[0].temperature=100", "supports[0].type=clamped"});
  ASSERT_EQ(free.code, 0) << free.messages;
  EXPECT_NEAR(free.last("p.ux [m]"), std::sqrt(1 + 2 * 1.2e-3) - 1, 1e-12);
  EXPECT_NEAR(free.last("p.axial_force [N]"), 0, 1e-6);
}

TEST(Temperature, NeedsAnExpansion) {
  const CaseRun run = run_text(bar, {"beams[0].temperature=50", "beams[0].material.thermal_expansion=null"});
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("beams[0].temperature: needs \"thermal_expansion\"")) << run.messages;
}

// A cable of 40.4 m over 40 m: drawn as the chord with its length as a number, or as a sagging parabola of
// that length, it hangs alike.
TEST(UnstressedLength, ACableDrawnAsItsChordHangsAsTheOneDrawnAtItsLength) {
  const auto cable = [](const std::string& axis) {
    return R"({ "nurbeam": 1, "gravity": [0, -9.81, 0],
      "beams": [{ "name": "c", "axis": )" +
           axis + R"(, "section": { "area": 1e-4, "second_moment": 1e-10 }, "stress_free": "straight",
                  "material": { "density": 8000, "youngs_modulus": 1e11 }, "elements": { "count": 20 } }],
      "supports": [{ "beam": "c", "at": "start", "type": "pinned", "name": "left" },
                   { "beam": "c", "at": "end", "type": "pinned" }],
      "analysis": { "type": "static" },
      "output": { "report": false, "probes": [{ "name": "p", "beam": "c", "at": { "fraction": 0.5 } },
                                              { "name": "q", "beam": "c", "at": { "fraction": 0.25 } }] } })";
  };
  // A parabola through (0, 0), (40, 0) whose length is measured by the program.
  const CaseRun drawn = run_text(cable(
      R"({ "nurbs": { "degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[0, 0, 0], [20, -5, 0], [40, 0, 0]] } })"));
  ASSERT_EQ(drawn.code, 0) << drawn.messages;
  // Of y = -5 (1 - (x/20)^2)/2: slope a = 1/2 at the ends, L = 40 (sqrt(1 + a^2) + asinh(a)/a)/2.
  const double a = 0.25, length = 20 * (std::sqrt(1 + a * a) + std::asinh(a) / a);
  std::ostringstream set;
  set.precision(17);
  set << "beams[0].unstressed_length=" << length;
  const CaseRun chord = run_text(cable(R"({ "polyline": [[0, 0, 0], [40, 0, 0]] })"), {set.str()});
  ASSERT_EQ(chord.code, 0) << chord.messages;
  for (const char* column : {"p.y [m]", "q.x [m]", "q.y [m]"})
    EXPECT_NEAR(chord.last(column), drawn.last(column), 2e-5) << column;
  EXPECT_NEAR(chord.last("left.fx [N]"), drawn.last("left.fx [N]"),
              1e-4 * std::abs(drawn.last("left.fx [N]")));
}

TEST(SupportMotion, StretchesABarInLoadSteps) {
  const CaseRun run = run_text(
      bar, {"supports[1].motion=[[0, 0, 0, 0], [1, 0.01, 0, 0]]", "analysis.load_steps=[0, 0.5, 1]"});
  ASSERT_EQ(run.code, 0) << run.messages;
  ASSERT_EQ(run.rows.size(), 3u);
  EXPECT_NEAR(run.value(1, "time [s]"), 0.5, 0);
  EXPECT_NEAR(run.value(0, "right.fx [N]"), 0, 1e-6);
  EXPECT_NEAR(run.value(1, "right.fx [N]"), tension(1.0025), 1e-6);
  EXPECT_NEAR(run.value(2, "right.fx [N]"), tension(1.005), 1e-6);
}

// A wall that shakes a bar puts energy into it; what it puts in is what the bar has.
TEST(SupportMotion, WorkIsTheEnergyOfTheBar) {
  double last = 0;
  for (const double step : {2e-5, 1e-5}) {
    std::ostringstream set;
    set << "analysis={\"end_time\": 0.004, \"step\": " << step << "}";
    const CaseRun run = run_text(
        bar, {set.str(), "supports[1].motion=[[0, 0, 0, 0], [0.001, 0.002, 0, 0], [0.002, -0.001, 0, 0]]"});
    ASSERT_EQ(run.code, 0) << run.messages;
    double drift = 0, most = 0;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      drift = std::max(drift, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
      most = std::max(most, run.value(i, "energy.kinetic [J]") + run.value(i, "energy.axial [J]"));
    }
    EXPECT_LT(drift, 0.02 * most);
    if (last > 0) EXPECT_LT(drift, last / 3);  // of second order
    last = drift;
    EXPECT_NEAR(run.last("p.y [m]"), 0, 1e-12);
  }
}

TEST(SupportMotion, BeginsWhereItIsDrawn) {
  const CaseRun run =
      run_text(bar, {"analysis={\"end_time\": 0.001}", "supports[1].motion=[[0, 0.01, 0, 0]]"});
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("supports[1].motion: is 0.01 m from the drawn place")) << run.messages;
}

const std::string cantilever = R"({
  "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] },
              "section": { "area": 1e-4, "second_moment": 1e-9 },
              "material": { "density": 1000, "youngs_modulus": 1e9 }, "elements": { "count": 8 } }],
  "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
  "loads": [{ "beam": "b", "at": "end", "force": [0, -5, 0] }],
  "analysis": { "type": "static" },
  "output": { "report": false, "probes": [{ "name": "tip", "beam": "b", "at": "end" }] }
})";

void expect_same(const CaseRun& a, const CaseRun& b) {
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (const char* column :
         {"time [s]", "tip.x [m]", "tip.y [m]", "tip.moment [N m]", "energy.bending [J]"})
      EXPECT_EQ(a.value(i, column), b.value(i, column)) << column;
}

TEST(LoadSteps, EachIsTheStateUnderItsShareOfTheLoads) {
  const CaseRun steps = run_text(cantilever, {"analysis.load_steps=4"});
  ASSERT_EQ(steps.code, 0) << steps.messages;
  ASSERT_EQ(steps.rows.size(), 4u);
  for (int k = 1; k <= 4; ++k) {
    EXPECT_NEAR(steps.value(k - 1, "time [s]"), k / 4.0, 1e-15);
    const CaseRun alone =
        run_text(cantilever, {"loads[0].force=[0, " + std::to_string(-5 * k / 4.0) + ", 0]"});
    for (const char* column : {"tip.x [m]", "tip.y [m]"})
      EXPECT_NEAR(steps.value(k - 1, column), alone.last(column), 1e-9) << column;
  }
}

// A force of 1 N that runs over a beam of 2 m on two supports: what is left of one is on the other.
TEST(LoadSteps, AForceThatMovesGivesInfluenceLines) {
  for (const char* time : {"null", "[[0, 1]]"}) {
    const CaseRun run = run_text(
        bar,
        {R"(supports[1]={"beam": "b", "at": "end", "type": "guided", "direction": [1, 0, 0], "name": "right"})",
         R"(loads=[{"beam": "b", "at": "start", "force": [0, -1, 0], "moves": {"speed": 2}}])",
         std::string("loads[0].time=") + time, "analysis.load_steps=4"});
    ASSERT_EQ(run.code, 0) << run.messages;
    for (int k = 1; k <= 4; ++k) {
      EXPECT_NEAR(run.value(k - 1, "left.fy [N]"), 1 - k / 4.0, 1e-6) << time;
      EXPECT_NEAR(run.value(k - 1, "right.fy [N]"), k / 4.0, 1e-6) << time;
    }
  }
}

// What is asked of connectors is so under the full loads, by whatever steps they come.
TEST(LoadSteps, LeaveConnectorsTheirLengths) {
  for (const char* length : {R"("force": 50)", R"("length": "as-drawn")"}) {
    const std::string text = std::string(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.01 },
                  "material": "steel", "elements": { "count": 8 } }],
      "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
      "connectors": [{ "name": "guy", "from": { "beam": "b", "at": "end" }, "to": { "point": [2, 0, 1] },
                       "stiffness": 5000, )") +
                             length + R"( }],
      "loads": [{ "beam": "b", "at": "end", "force": [0, 0, -60] }], "analysis": { "type": "static" },
      "output": { "report": false, "probes": [{ "name": "e", "beam": "b", "at": "end" }] } })";
    const CaseRun plain = run_text(text);
    ASSERT_EQ(plain.code, 0) << plain.messages;
    for (const char* steps : {"2", "[0, 1]", "[0.3, 1]", "[1, 2]"}) {
      const CaseRun run = run_text(text, {std::string("analysis.load_steps=") + steps});
      ASSERT_EQ(run.code, 0) << run.messages;
      const std::size_t full = steps[1] == '1' ? 0 : run.rows.size() - 1;
      EXPECT_NEAR(run.value(full, "e.z [m]"), plain.last("e.z [m]"), 1e-9) << length << steps;
      EXPECT_NEAR(run.value(full, "guy.force [N]"), plain.last("guy.force [N]"), 1e-6) << length << steps;
    }
    const CaseRun half = run_text(text, {"analysis.load_steps=[0.5]"}),
                  both = run_text(text, {"analysis.load_steps=[0.5, 1]"});
    ASSERT_EQ(half.code, 0) << half.messages;
    EXPECT_NEAR(half.last("e.z [m]"), both.value(0, "e.z [m]"), 1e-9) << length;
  }
}

TEST(LoadSteps, ThatAreLeftOutAreTheFullLoad) {
  const std::string ramp = "loads[0].time=[[0, 0], [1, 1], [2, 3]]";
  const CaseRun full = run_text(cantilever, {"analysis.load_steps=1"}), ramped = run_text(cantilever, {ramp}),
                plain = run_text(cantilever);
  ASSERT_EQ(ramped.code, 0) << ramped.messages;
  expect_same(ramped, full);
  EXPECT_EQ(plain.last("tip.y [m]"), full.last("tip.y [m]"));
  EXPECT_EQ(plain.last("time [s]"), 0);
  const CaseRun moved = run_text(bar, {"supports[1].motion=[[0, 0, 0, 0], [1, 0.01, 0, 0]]"});
  ASSERT_EQ(moved.code, 0) << moved.messages;
  EXPECT_NEAR(moved.last("right.fx [N]"), tension(1.005), 1e-6);
  const CaseRun warmed = run_text(bar, {"beams[0].temperature=[[0, 0], [1, 50]]"});
  ASSERT_EQ(warmed.code, 0) << warmed.messages;
  EXPECT_NEAR(warmed.last("p.axial_force [N]"), -EA * 1.2e-5 * 50, 1e-6);
}

TEST(LoadSteps, DivideABeamForItsFullLoad) {
  const std::string fine = R"(beams[0].elements={"tolerance": 1e-7})";
  const CaseRun full = run_text(cantilever, {fine, "analysis.load_steps=1"});
  ASSERT_EQ(full.code, 0) << full.messages;
  expect_same(run_text(cantilever, {fine, "loads[0].time=[[0, 0], [1, 1]]"}), full);
  EXPECT_EQ(run_text(cantilever, {fine}).last("tip.y [m]"), full.last("tip.y [m]"));
}

TEST(LoadSteps, MustIncreaseAndBelongToStatics) {
  const CaseRun falling = run_text(cantilever, {"analysis.load_steps=[0.5, 0.2]"});
  EXPECT_EQ(falling.code, 2);
  EXPECT_TRUE(falling.says("analysis.load_steps[1]: is 0.2 after 0.5; factors must increase"))
      << falling.messages;
  const CaseRun moving = run_text(cantilever, {"analysis={\"end_time\": 1, \"load_steps\": 2}"});
  EXPECT_EQ(moving.code, 2);
  EXPECT_TRUE(moving.says("analysis.load_steps: is for a static analysis")) << moving.messages;
}

TEST(LoadSteps, ATableInAFileIsTheSameAsItsRows) {
  const std::string rows = R"(loads[0].time=[[0, 0], [0.5, 0.1], [1, 1]])";
  const CaseRun inline_rows = run_text(cantilever, {rows, "analysis.load_steps=4"});
  ASSERT_EQ(inline_rows.code, 0) << inline_rows.messages;
  const std::string csv = "# measured\nforce, clock\n0, 0\n0.1, 0.5\n\n1, 1\n";
  const CaseRun file = run_with_table(
      cantilever,
      {R"(loads[0].time={"file": "table.csv", "columns": ["clock", "force"]})", "analysis.load_steps=4"},
      csv);
  ASSERT_EQ(file.code, 0) << file.messages;
  expect_same(file, inline_rows);
  const CaseRun first = run_with_table(
      cantilever, {R"(loads[0].time={"file": "table.csv"})", "analysis.load_steps=4"}, "0;0\n0.5;0.1\n1;1\n");
  expect_same(first, inline_rows);
}

TEST(TableFiles, ThatCannotBeReadNamePlaceAndLine) {
  const auto says = [](const std::string& override, const std::string& csv, const std::string& words) {
    const CaseRun run = run_with_table(cantilever, {override}, csv);
    EXPECT_EQ(run.code, 2);
    EXPECT_TRUE(run.says(words)) << run.messages;
  };
  says(R"(loads[0].time={"file": "other.csv"})", "0,0\n", "loads[0].time.file: there is no file");
  says(R"(loads[0].time={"file": "table.csv"})", "0,0\n1,x\n",
       "line 2: column 2 is \"x\"; expected a number");
  says(R"(loads[0].time={"file": "table.csv"})", "0\n", "line 1: column 2 is missing");
  says(R"(loads[0].time={"file": "table.csv"})", "t,f\n", "has no rows of numbers");
  says(R"(loads[0].time={"file": "table.csv", "columns": ["t", "g"]})", "t,f\n0,0\n", "has no column \"g\"");
  says(R"(loads[0].time={"file": "table.csv", "columns": ["t"]})", "t,f\n0,0\n", "names of 2 columns");
  says(R"(loads[0].time={"fil": "table.csv"})", "t,f\n0,0\n", "unknown key \"fil\"");
  says(R"(loads[0].time={"file": "table.csv"})", "1,0\n0,0\n", "times must increase");
  says(R"(loads[0].time={"file": "table.csv"})", "t [mm],f\n0,0\n",
       "the column \"t [mm]\" cannot be read: \"1 mm\"");
  says(R"(loads[0].time={"file": "table.csv"})", "t (mm),f\n0,0\n",
       "the column \"t (mm)\" cannot be read: \"1 mm\"");
  says(R"(loads[0].time={"file": "table.csv"})", "t [foo],f\n0,0\n", "has an unknown unit \"foo\"");
  says(R"(loads[0].time={"file": "table.csv"})", "t,f\n0,0,7\n",
       "line 2: has 3 numbers, but the first line names 2");
}

TEST(TableFiles, HaveTheirColumnsInTheUnitsOfTheirHeadings) {
  const CaseRun seconds =
      run_text(cantilever, {R"(loads[0].time=[[0, 0], [1, 1]])", "analysis.load_steps=4"});
  for (const char* table : {"t [ms],f,\n0,0,\n1000,1,\n", "t (ms),f(t)\n0,0\n1000,1\n",
                            "time/ms;F/kN\n0;0\n1000;0.001\n", "Time(ms),F / (kN)\n0,0\n1000,0.001\n",
                            "time (ms) moment [N m]\n0 0\n1000 1\n", "t (raw),F/F0 (min)\n0,0\n1,1\n"}) {
    const CaseRun read = run_with_table(
        cantilever, {R"(loads[0].time={"file": "table.csv"})", "analysis.load_steps=4"}, table);
    ASSERT_EQ(read.code, 0) << read.messages;
    expect_same(read, seconds);
  }
  const CaseRun chosen = run_with_table(
      cantilever, {R"(loads[0].time={"file": "table.csv", "columns": ["t", "F"]})", "analysis.load_steps=4"},
      "F/kN,t (ms)\n0,0\n0.001,1000\n");
  ASSERT_EQ(chosen.code, 0) << chosen.messages;
  expect_same(chosen, seconds);
}

// A free bar of 61.65 kg; what a force gives it in all [N s], whatever the steps.
void expect_impulse(const std::string& load, double impulse, double near) {
  const double mass = 7850 * M_PI * 0.0025;
  for (const char* analysis : {R"({"end_time": 0.1, "step": "10 ms"})",
                               R"({"end_time": 0.1, "step": "1 ms"})", R"({"end_time": 0.1})"}) {
    const CaseRun run = run_text(R"({
      "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.05 },
                  "material": { "density": 7850, "youngs_modulus": 2e11 }, "elements": { "count": 4 } }],
      "loads": [)" + load + R"(], "analysis": )" +
                                 analysis + R"(,
      "output": { "report": false, "every": 0.05, "probes": [{ "name": "m", "beam": "b", "at": { "fraction": 0.5 } }] } })");
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(mass * run.last("m.vx [m/s]"), impulse, near) << load << analysis;
    EXPECT_NEAR(run.last("time [s]"), 0.1, 1e-12);
  }
}

// A step that lay across one took half of it for what acts all along the step.
TEST(LoadTables, JumpBetweenSteps) {
  const auto all_along = [](const std::string& rows) {
    return R"({ "beam": "b", "force_per_length": [100, 0, 0], "time": )" + rows + "}";
  };
  expect_impulse(all_along("[[0.0303, 1], [0.030300000001, 0]]"), 3.03, 1e-6);
  expect_impulse(all_along("[[0, 1], [1e-12, 0], [0.05, 0], [0.050000000001, 1]]"), 5, 1e-6);
}

// But for the last two, which are a jump: 1e-5 of a step of 10 ms, at most.
TEST(LoadTables, LoseNoTimeWhereTheirRowsAreDense) {
  std::string rows = "[[0, 1]";
  for (int i = 0; i < 200; ++i) rows += ", [" + std::to_string(30000000 + 50 * i) + "e-9, 1]";
  expect_impulse(R"({ "beam": "b", "force_per_length": [100, 0, 0], "time": )" + rows + "]}", 10, 1e-5);
}

TEST(MovingForce, IsGoneOnceItHasLeftTheBeam) {
  expect_impulse(
      R"({ "beam": "b", "at": { "length": 0.2 }, "force": [100, 0, 0], "moves": { "speed": 15 } })",
      100 * 0.8 / 15, 0.05);
}

// A body on a stiff slope of 30 degrees: held for 0.2 s, then s = g sin(30) t^2/2.
TEST(Release, ABodyIsHeldUntilItsTime) {
  const std::string slope = R"({
    "nurbeam": 1,
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 2], [3.4641016151377544, 0, 0]] },
                "section": { "radius": 0.1 }, "material": { "density": 7850, "youngs_modulus": 2e11 },
                "elements": { "count": 8 } }],
    "bodies": [{ "name": "m", "mass": 0.1 }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped" }, { "beam": "b", "at": "end", "type": "clamped" }],
    "sliding_joints": [{ "body": "m", "beam": "b", "at": { "length": 1.13 }, "release": 0.2, "at_beam_end": "stop" }],
    "analysis": { "end_time": 0.6, "step": 1e-3, "initial": "equilibrium" },
    "output": { "report": false, "every": 0.1 } })";
  const CaseRun run = run_text(slope);
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double t = std::max(0.0, run.value(i, "time [s]") - 0.2);
    EXPECT_NEAR(run.value(i, "m.s [m]"), 1.13 + 9.81 / 2 * t * t / 2, 1e-4) << t;
  }
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-4);
  const CaseRun whole = run_text(slope, {"analysis.step=null", "analysis.tolerance=1e-6"});
  EXPECT_NEAR(whole.last("m.s [m]"), run.last("m.s [m]"), 1e-5);
}

// A free bar that flies and turns: its middle moves with the translation, its ends about it.
TEST(InitialVelocity, TranslatesAndTurnsAFreeBar) {
  const std::string free = R"({
    "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.05 },
                "material": { "density": 7850, "youngs_modulus": 2e11 }, "elements": { "count": 4 },
                "initial": { "velocity": { "translation": [1, 0, 0.5], "rotation": [0, 2, 0], "about": [0.5, 0, 0] } } }],
    "analysis": { "end_time": 0.5, "step": 1e-3 },
    "output": { "report": false, "every": 0.1, "probes": [{ "name": "m", "beam": "b", "at": { "fraction": 0.5 } },
                                                           { "name": "e", "beam": "b", "at": "end" }] } })";
  const CaseRun run = run_text(free);
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double t = run.value(i, "time [s]");
    EXPECT_NEAR(run.value(i, "m.x [m]"), 0.5 + t, 1e-6);
    EXPECT_NEAR(run.value(i, "m.z [m]"), 0.5 * t, 1e-6);
    EXPECT_NEAR(run.value(i, "e.x [m]") - run.value(i, "m.x [m]"), 0.5 * std::cos(2 * t), 1e-5);
    EXPECT_NEAR(run.value(i, "e.z [m]") - run.value(i, "m.z [m]"), -0.5 * std::sin(2 * t), 1e-5);
  }
  EXPECT_NEAR(run.value(0, "energy.kinetic [J]"), 7850 * M_PI * 0.0025 * (1.25 / 2 + 4.0 / 24), 1e-6);
}

}  // namespace
}  // namespace nurbeam::test
