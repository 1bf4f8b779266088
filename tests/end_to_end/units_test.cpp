// The same model in other units of length, mass and time, in powers of two: it takes the same steps, and all
// its numbers are the same but for their units. An absolute threshold would show.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::of_units {
namespace {

using nlohmann::json;

struct Units {
  double length = 1, mass = 1, time = 1;

  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }
  /// Of a column of histories.csv, by the unit that it names.
  double of(const std::string& column) const {
    const std::size_t bracket = column.rfind('[');
    if (bracket == std::string::npos) return 1;
    const std::string unit = column.substr(bracket + 1, column.size() - bracket - 2);
    const std::map<std::string, double> known{{"m", length},
                                              {"s", time},
                                              {"m/s", length / time},
                                              {"m/s^2", acceleration()},
                                              {"N", force()},
                                              {"N m", force() * length},
                                              {"J", force() * length},
                                              {"Pa", force() / (length * length)},
                                              {"rad", 1},
                                              {"1", 1}};
    return known.at(unit);
  }
};

json rope(const Units& u, int elements) {
  return {{"name", "b"},
          {"axis", {{"polyline", {{0, 0, 0}, {8 * u.length, 0, -u.length}}}}},
          {"section", {{"radius", 0.008 * u.length}}},
          {"material",
           {{"density", 6000 * u.mass / std::pow(u.length, 3)},
            {"youngs_modulus", 1e9 * u.force() / (u.length * u.length)}}},
          {"elements", {{"count", elements}}}};
}

json held(const char* at, const char* type = "pinned") { return {{"beam", "b"}, {"at", at}, {"type", type}}; }

json model(const Units& u, const json& beam, double end_time) {
  return {{"nurbeam", 1},
          {"gravity", {0, 0, -9.81 * u.acceleration()}},
          {"beams", {beam}},
          {"supports", {held("start")}},
          {"analysis", {{"end_time", end_time * u.time}}},
          {"output", {{"every", end_time / 10 * u.time}, {"report", false}}}};
}

json swinging(const Units& u) { return model(u, rope(u, 6), 0.4); }

json by_radau(const Units& u) {
  json of = swinging(u);
  of["analysis"]["integrator"] = {{"type", "radau"}};
  return of;
}

json with_torsion(const Units& u) {
  json of = model(u, rope(u, 4), 0.2);
  of["beams"][0]["torsion"] = true;
  of["beams"][0]["axis"]["polyline"] = {{0, 0, 0}, {2 * u.length, 0, 0}};
  of["supports"] = {held("start", "clamped")};
  of["loads"] = {{{"beam", "b"}, {"at", "end"}, {"force", {0, 5 * u.force(), 0}}}};
  return of;
}

json with_trolley(const Units& u, const json& joint) {
  json of = model(u, rope(u, 8), 1.2);
  of["beams"][0]["tension"] = 4000 * u.force();
  of["supports"].push_back(held("end"));
  of["bodies"] = {{{"name", "m"}, {"mass", 40 * u.mass}}};
  of["sliding_joints"] = {{{"body", "m"}, {"beam", "b"}, {"at", {{"fraction", 0.3}}}}};
  of["sliding_joints"][0].update(joint);
  of["analysis"]["initial"] = "equilibrium";
  return of;
}

json with_friction(const Units& u) {
  return with_trolley(u, {{"friction", {{"coefficient", 0.05}}}, {"speed", 2 * u.length / u.time}});
}

json with_stop(const Units& u) {
  json of = with_trolley(u, json::object());
  of["stops"] = {{{"beam", "b"}, {"at", {{"fraction", 0.4}}}, {"restitution", 0.5}}};
  return of;
}

json at_rest(const Units& u) {
  json of = model(u, rope(u, 8), 1);
  of["supports"].push_back(held("end"));
  of["loads"] = {{{"beam", "b"}, {"at", {{"fraction", 0.3}}}, {"force", {0, 0, -300 * u.force()}}}};
  of["analysis"] = {{"type", "static"}};
  of["output"].erase("every");
  return of;
}

struct Made {
  test::CaseRun run;
  json summary;
};

Made made(const json& of) {
  const test::TemporaryDirectory directory;
  const auto results = directory.path() / "out";
  std::ostringstream out, err;
  const std::string file = directory.write("case.json", of.dump()).string();
  Made result;
  result.run.code = run_command_line({"run", file, "--quiet", "--out", results.string()}, out, err);
  EXPECT_EQ(result.run.code, 0) << err.str();
  test::read_histories(results / "histories.csv", result.run);
  std::ifstream stream(results / "run.json");
  result.summary = json::parse(stream);
  return result;
}

double largest(const test::CaseRun& run, std::size_t column) {
  double found = 0;
  for (const auto& row : run.rows)
    if (!std::isnan(row[column])) found = std::max(found, std::abs(row[column]));
  return found;
}

void expect_same(json (*model)(const Units&), const Units& u, double accuracy) {
  const Made one = made(model({})), other = made(model(u));
  for (const char* count : {"steps", "rejected_steps", "newton_iterations"})
    EXPECT_EQ(one.summary.at(count), other.summary.at(count)) << count;
  ASSERT_EQ(one.run.header, other.run.header);
  ASSERT_EQ(one.run.rows.size(), other.run.rows.size());
  for (std::size_t k = 0; k < one.run.header.size(); ++k) {
    // At a kink, the greatest of two nearly equal sides is the choice of round-off.
    if (one.run.header[k].find("shear_force.max") != std::string::npos) continue;
    const double unit = u.of(one.run.header[k]), allowed = accuracy * largest(one.run, k);
    for (std::size_t i = 0; i < one.run.rows.size(); ++i)
      if (!std::isnan(one.run.rows[i][k]))
        EXPECT_NEAR(other.run.rows[i][k] / unit, one.run.rows[i][k], allowed)
            << one.run.header[k] << " " << i;
  }
}

struct Kind {
  const char* name;
  json (*model)(const Units&);
};
constexpr Kind kinds[] = {{"swinging", swinging},      {"radau", by_radau}, {"torsion", with_torsion},
                          {"friction", with_friction}, {"stop", with_stop}, {"rest", at_rest}};

class Unit : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Each, Unit, testing::ValuesIn(kinds),
                         [](const auto& of) { return std::string(of.param.name); });

TEST_P(Unit, OfMassChangesNoBit) {
  for (const double mass : {64., 1. / 64}) expect_same(GetParam().model, {.mass = mass}, 0);
}
TEST_P(Unit, OfTimeChangesNoBit) {
  for (const double time : {16., 1. / 16}) expect_same(GetParam().model, {.time = time}, 0);
}
// Lengths of curves are found to round-off.
TEST_P(Unit, OfLengthChangesNoStep) {
  for (const double length : {32., 1. / 32})
    expect_same(GetParam().model, {.length = length, .mass = std::pow(length, 3)}, 1e-6);
}

}  // namespace
}  // namespace nurbeam::of_units
