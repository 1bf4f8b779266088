#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

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

/// The root of an increasing function between lo and hi: regula falsi, Illinois variant.
double root(const std::function<double(double)>& f, double lo, double hi) {
  double f_lo = f(lo), f_hi = f(hi);
  for (int i = 0; i < 200 && hi - lo > 1e-15 * (std::abs(lo) + std::abs(hi)); ++i) {
    const double x = (lo * f_hi - hi * f_lo) / (f_hi - f_lo), f_x = f(x);
    if (f_x == 0 || x <= lo || x >= hi) return x;
    if (f_x < 0) {
      lo = x, f_lo = f_x, f_hi /= 2;
    } else {
      hi = x, f_hi = f_x, f_lo /= 2;
    }
  }
  return (lo + hi) / 2;
}

// ---- Cantilevers ----

TEST(RollUp, TheTipFollowsTheCircleAtOrderFour) {
  const double M = 2 * std::numbers::pi;
  std::vector<double> errors;
  for (const int count : {16, 32, 64}) {
    const CaseRun r = run("rollup.json", {set("beams[0].elements.count", count)});
    errors.push_back(
        std::hypot(r.last("tip.x [m]") - std::sin(M) / M, r.last("tip.y [m]") - (1 - std::cos(M)) / M));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 3.9);
}

TEST(RollUp, AConvergedMeshGivesTheTipToTenToTheMinusEight) {
  for (const double turns : {0.5, 1.0}) {
    const double M = 2 * std::numbers::pi * turns;
    std::ostringstream moment;
    moment.precision(17);
    moment << "loads[0].moment=[0,0," << M << "]";
    const CaseRun r = run("rollup.json", {moment.str(), set("beams[0].elements.count", 200)});
    EXPECT_NEAR(r.last("tip.x [m]"), std::sin(M) / M, 1e-8);
    EXPECT_NEAR(r.last("tip.y [m]"), (1 - std::cos(M)) / M, 1e-8);
    EXPECT_NEAR(r.last("beam.length [m]"), 1, 1e-8);
  }
}

struct Tip {
  double x, y;
};

/// Inextensible cantilever under a dead tip load across it, q = P L^2/EI; Mattiasson 1981.
Tip elastica_tip(double q) {
  const auto phi = [](double p) { return std::asin(1 / (p * std::numbers::sqrt2)); };
  const double p =
      root([&](double x) { return std::comp_ellint_1(x) - std::ellint_1(x, phi(x)) - std::sqrt(q); },
           1 / std::numbers::sqrt2, 1 - 1e-12);
  const double drop = 1 - 2 * (std::comp_ellint_2(p) - std::ellint_2(p, phi(p))) / std::sqrt(q);
  return {std::sqrt(2 * (2 * p * p - 1) / q), -drop};
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

TEST(SmallDeflection, TheTipIsExactOnOneElementUpToTheSquareOfTheLoad) {
  std::vector<double> errors;
  for (const double P : {0.004, 0.002, 0.001}) {
    const CaseRun r = run("elastica.json", {set_y("loads[0].force", -P), set("beams[0].section.area", 1e-3),
                                            set("beams[0].elements.count", 1)});
    errors.push_back(std::abs(r.last("tip.y [m]") / (-P / 3) - 1));
  }
  EXPECT_LT(errors[2], 1e-4);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
}

// A cubic element under a line load w is exact at its nodes; in its middle it misses w h^4 / (384 EI).
TEST(SmallDeflection, NodesSuperconvergeAndTheInsideOfAnElementHasOrderFour) {
  const double w = 1e-4;
  for (const int count : {1, 2, 4}) {
    const double h = 1.0 / count, x = h / 2;
    const CaseRun r =
        run("elastica.json", {"loads=[{\"beam\":\"beam\",\"force_per_length\":[0,-1e-4,0]}]",
                              set("beams[0].section.area", 1e-3), set("beams[0].elements.count", count),
                              "output.probes=[{\"name\":\"tip\",\"beam\":\"beam\",\"at\":\"end\"},{\"name\":"
                              "\"inside\",\"beam\":\"beam\",\"at\":{\"length\":" +
                                  std::to_string(x) + "}}]"});
    const double exact = -w * x * x * (6 - 4 * x + x * x) / 24;
    EXPECT_NEAR(r.last("tip.y [m]"), -w / 8, 1e-12);
    EXPECT_NEAR(r.last("inside.y [m]") - exact, w * std::pow(h, 4) / 384, 1e-12);
  }
}

// ---- Hanging cables ----

/// A string of weight w and the Green law T = EA lambda (lambda^2 - 1)/2, from a point where the vertical
/// force is V, up along its reference length; H is its horizontal force.
struct StringShape {
  double x = 0, y = 0, axial_energy = 0;
};

struct StringLaw {
  double EA, w;

  double stretch(double T) const {
    double lambda = 1;
    for (int i = 0; i < 20; ++i)
      lambda -= (EA * lambda * (lambda * lambda - 1) / 2 - T) / (EA * (3 * lambda * lambda - 1) / 2);
    return lambda;
  }

  StringShape shape(double H, double V, double length) const {
    constexpr int panels = 100;
    const double gauss = std::sqrt(0.6);
    StringShape sum;
    for (int i = 0; i < panels; ++i)
      for (const auto& [point, weight] : {std::pair{-gauss, 5.0 / 18}, {0.0, 8.0 / 18}, {gauss, 5.0 / 18}}) {
        const double ds = weight * length / panels, s = (i + (1 + point) / 2) * length / panels;
        const double T = std::hypot(H, V + w * s), lambda = stretch(T);
        const double strain = (lambda * lambda - 1) / 2;
        sum.x += H / T * lambda * ds;
        sum.y += (V + w * s) / T * lambda * ds;
        sum.axial_energy += EA * strain * strain / 2 * ds;
      }
    return sum;
  }
};

struct Hanging {
  double H, V;  ///< horizontal force and vertical force at the start, against the weight [N]
};

/// A string between (0, 0) and (span, rise).
Hanging hang(const StringLaw& law, double length, double span, double rise) {
  const double weight = law.w * length;
  const auto lowest_force = [&](double H) {
    return root([&](double V) { return law.shape(H, V, length).y - rise; }, -10 * weight, 10 * weight);
  };
  const double H = root([&](double x) { return law.shape(x, lowest_force(x), length).x - span; }, 1e-3, 1e5);
  return {H, lowest_force(H)};
}

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

}  // namespace
}  // namespace nurbeam
