// Vibrations about equilibria and buckling factors, as an analysis of modes computes them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "fem/motion/rest/modes.h"
#include "fem/system/material_points.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using std::numbers::pi;

ModesReport modes_of(const BeamModel& model, const ModesOptions& options) {
  ModesReport report =
      find_modes(std::make_shared<const BeamModel>(noted(model, options)), options, [] { return false; });
  if (report.rest.failure) throw std::runtime_error("the modes were not found");
  return report;
}

std::vector<double> frequencies(const BeamModel& model, int count, bool about_equilibrium = true) {
  std::vector<double> omega;
  for (const Mode& mode : modes_of(model, {.count = count, .about_equilibrium = about_equilibrium}).modes)
    omega.push_back(mode.omega);
  return omega;
}

double root(const std::function<double(double)>& f, double lo, double hi) {
  const bool rises = f(hi) > 0;
  for (int i = 0; i < 200; ++i) {
    const double middle = (lo + hi) / 2;
    ((f(middle) > 0) == rises ? hi : lo) = middle;
  }
  return (lo + hi) / 2;
}

/// Slender: EA L^2/EI = 1e8; all of 1 m, with EI and rho A of 1.
const BeamProperties slender{1e8, 1, 1};

ModelBuilder straight(int elements, const BeamProperties& properties = slender, int dimension = 2,
                      const Vector3d& gravity = Vector3d::Zero()) {
  ModelBuilder builder(dimension, gravity);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, dimension), properties, {elements});
  return builder;
}

// ---- Straight beams ----

void add_beta(VerifyResult& result, const std::string& name, const BeamModel& model,
              const std::vector<double>& exact, std::size_t rigid = 0,
              const std::string& source = "Euler-Bernoulli") {
  const std::vector<double> omega = frequencies(model, static_cast<int>(exact.size() + rigid));
  for (std::size_t i = 0; i < rigid; ++i)
    result.add(name + " rigid motion " + std::to_string(i + 1) + " [rad/s]", 0, "it moves freely",
               omega.at(i), 0);
  for (std::size_t i = 0; i < exact.size(); ++i)
    result.add(name + " beta_" + std::to_string(i + 1) + " L, 32 elements", exact[i], source,
               std::sqrt(omega.at(rigid + i)), 6e-6 * exact[i]);
}

VerifyResult straight_beams() {
  VerifyResult result;
  const auto beam = [] { return straight(32); };
  add_beta(result, "cantilever", beam().clamp(0, 0).build(), {1.87510407, 4.69409113, 7.85475744});
  add_beta(result, "clamped-clamped", beam().clamp(0, 0).clamp(0, 1).build(),
           {4.73004074, 7.85320462, 10.9956079});
  add_beta(result, "pinned-pinned", beam().pin(0, 0).pin(0, 1).build(), {pi, 2 * pi, 3 * pi});
  add_beta(result, "free", beam().build(), {4.73004074, 7.85320462, 10.9956079}, 3);

  BeamModel tip = beam().clamp(0, 0).build();
  add_slider(tip, 1, 1);
  add_beta(result, "cantilever with its own mass at its tip", tip,
           {root(
               [](double b) {
                 return -(1 + std::cos(b) * std::cosh(b) +
                          b * (std::cos(b) * std::sinh(b) - std::sin(b) * std::cosh(b)));
               },
               0.5, 2)},
           0, "1 + cos cosh + beta (cos sinh - sin cosh) = 0");
  BeamModel middle = beam().pin(0, 0).pin(0, 1).build();
  add_slider(middle, 1, 0.5);
  add_beta(result, "pinned with its own mass held in its middle", middle,
           {2 * root([](double b) { return b * (std::tan(b) - std::tanh(b)) - 2; }, 0.5, 0.4999 * pi)}, 0,
           "beta/2 (tan - tanh)(beta/2) = 2");

  const ModesReport cantilever = modes_of(beam().clamp(0, 0).build(), {.count = 3});
  const double parts[] = {0.613077, 0.188300, 0.064732};  // (2 sigma/beta)^2
  for (int i = 0; i < 3; ++i)
    result.add("cantilever, effective mass " + std::to_string(i + 1) + " over its mass", parts[i],
               "Euler-Bernoulli", std::pow(cantilever.modes[i].participation.y(), 2) / cantilever.mass, 2e-6);

  ConvergenceTable table{"the third frequency of a cantilever, relative", "elements", {}};
  for (const int elements : {6, 12, 24})
    table.rows.emplace_back(elements, std::abs(frequencies(straight(elements).clamp(0, 0).build(), 3)[2] /
                                                   std::pow(7.85475743823761, 2) -
                                               1));
  result.add(std::move(table), 4, 0.2, "cubic elements");
  return result;
}

/// A round bar in space: every bending frequency twice, torsion and stretch once.
VerifyResult in_space() {
  VerifyResult result;
  BeamProperties bar(1e6, 0, 1);
  bar.sections = SectionStiffness{1, 1, 0, 1e4, 1};
  const auto model = [&](const BeamProperties& properties, int elements) {
    ModelBuilder builder(3);
    builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 3).oriented({}), properties,
                     {elements});
    return builder;
  };
  const std::vector<double> bending = frequencies(model(bar, 24).clamp(0, 0).build(), 6);
  const double beta[] = {1.87510407, 4.69409113, 7.85475744};
  for (int i = 0; i < 6; ++i)
    result.add("round cantilever with torsion omega_" + std::to_string(i + 1) + " [rad/s], 24 elements",
               beta[i / 2] * beta[i / 2], "Euler-Bernoulli, each twice", bending[i],
               1e-5 * beta[i / 2] * beta[i / 2]);
  const std::vector<double> free = frequencies(model(bar, 8).build(), 7);
  for (int i = 0; i < 6; ++i)
    result.add("free bar with torsion, rigid motion " + std::to_string(i + 1) + " [rad/s]", 0,
               "it moves freely", free[i], 0);
  BeamProperties shaft = bar;
  shaft.sections = SectionStiffness{1e4, 1e4, 0, 1, 1};
  const std::vector<double> torsion = frequencies(model(shaft, 16).clamp(0, 0).build(), 3);
  for (int n = 1; n <= 3; ++n)
    result.add("torsional omega_" + std::to_string(n) + " [rad/s], fixed-free, 16 elements",
               (2 * n - 1) * pi / 2, "(2n - 1) pi/2 c/L", torsion[n - 1], n == 3 ? 1e-3 : 1e-4);
  return result;
}

// ---- Curved beams ----

VerifyResult rings() {
  VerifyResult result;
  const std::vector<RationalCubic> circle = arc_cubics({0, 0, 0}, 1, 0, 2 * pi, 4);
  const auto omega = [&](int dimension, const BeamProperties& properties, int count) {
    ModelBuilder builder(dimension);
    const ReferenceCurve curve(circle, dimension, Metric::arc_length, true);
    builder.add_beam(properties.sections ? curve.oriented({}) : curve, properties, {32});
    return frequencies(builder.build(), count);
  };
  const auto in_plane = [](double n) { return n * (n * n - 1) / std::sqrt(n * n + 1); };
  const std::vector<double> planar = omega(2, slender, 7);
  for (int i = 0; i < 3; ++i)
    result.add("ring, rigid motion " + std::to_string(i + 1) + " in its plane [rad/s]", 0, "it moves freely",
               planar[i], 0);
  for (int i = 3; i < 7; ++i) {
    const int waves = (i + 1) / 2;
    result.add("ring omega_" + std::to_string(i + 1) + " in its plane [rad/s], 32 elements", in_plane(waves),
               "n (n^2 - 1)/sqrt(n^2 + 1), each twice", planar[i], 5e-4);
  }
  // Out of its plane it twists: n (n^2 - 1)/sqrt(n^2 + EI/GJ); the section's own inertia is small.
  BeamProperties bar(1e8, 0, 1);
  bar.sections = SectionStiffness{1, 1, 0, 1 / 1.3, 1e-6};
  const std::vector<double> spatial = omega(3, bar, 10);
  for (int i = 0; i < 6; ++i)
    result.add("ring with torsion, rigid motion " + std::to_string(i + 1) + " [rad/s]", 0, "it moves freely",
               spatial[i], 0);
  const double out = 2 * 3 / std::sqrt(4 + 1.3);
  for (int i = 6; i < 10; ++i)
    result.add("ring with torsion omega_" + std::to_string(i + 1) + " [rad/s], 32 elements",
               i < 8 ? out : in_plane(2), "n (n^2 - 1)/sqrt(n^2 + 1 or EI/GJ), each twice", spatial[i], 5e-4);
  return result;
}

VerifyResult bead() {
  VerifyResult result;
  const double R = 2, g = 9.81;
  ModelBuilder builder(2, {0, -g, 0});
  builder.add_beam(ReferenceCurve(arc_cubics({0, 0, 0}, R, -5 * pi / 6, -pi / 6, 2), 2),
                   BeamProperties{1e6, 1e4, 1}, {12});
  const double L = builder.beam(0).curve.length();
  builder.clamp(0, 0).clamp(0, L);
  builder.slide(builder.add_body("bead", 1), 0, 0.42 * L);
  const ModesReport report = modes_of(builder.build(), {.count = 1, .bodies_held = false});
  result.add("a bead at the bottom of a wire [rad/s]", std::sqrt(g / R), "sqrt(g/R)", report.modes[0].omega,
             1e-4);
  return result;
}

// ---- Under load ----

/// A chain that hangs, and a sagging cable: their stiffness is that of their weight.
VerifyResult cables() {
  VerifyResult result;
  const double g = 9.81;
  ModelBuilder chain(2, {0, -g, 0});
  chain.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {0, -1, 0})}, 2), BeamProperties{1e7, 1e-7, 1}, {48});
  const std::vector<double> hanging = frequencies(chain.pin(0, 0).build(), 3);
  const double zeros[] = {2.404825557695773, 5.520078110286311, 8.653727912911012};
  for (int i = 0; i < 3; ++i)
    result.add("hanging chain omega_" + std::to_string(i + 1) + " [rad/s], 48 elements",
               zeros[i] / 2 * std::sqrt(g), "zeros of J_0", hanging[i], 7e-4 * zeros[i] * std::sqrt(g));

  ConvergenceTable table{
      "the first frequency of a cable against Irvine's theory of small sag, relative", "sag over span", {}};
  for (const double sag : {0.04, 0.02, 0.01}) {
    const double EA = 5 / std::pow(8 * sag, 3) * g;  // lambda^2 near 20, stretched
    ModelBuilder cable(2, {0, -g, 0});
    const double radius = (1 + 4 * sag * sag) / (8 * sag), angle = std::asin(0.5 / radius);
    cable.add_beam(
        ReferenceCurve(arc_cubics({0.5, radius - sag, 0}, radius, -pi / 2 - angle, -pi / 2 + angle, 2), 2)
            .straightened(),
        BeamProperties{EA, 1e-8 * EA, 1}, {32});
    const double L = cable.beam(0).curve.length();
    const ModesReport report = modes_of(cable.pin(0, 0).pin(0, L).build(), {.count = 2});
    const double d = -material_point(*report.at.system, report.at.state, 0, L / 2).r.y();
    const double H = g / (8 * d), square = std::pow(g / H, 2) * EA / (H * (1 + 8 * d * d));
    const double symmetric = 2 * root([&](double x) { return -(std::tan(x) - x + 4 / square * x * x * x); },
                                      0.51 * pi, 0.999 * pi);
    const double unit = std::sqrt(H);
    table.rows.emplace_back(sag, std::abs(report.modes[0].omega / (symmetric * unit) - 1));
    if (sag != 0.01) continue;
    result.add("cable with a sag of a hundredth, omega_1 [rad/s]", symmetric * unit, "Irvine",
               report.modes[0].omega, 1e-3 * symmetric * unit);
    result.add("cable with a sag of a hundredth, omega_2 [rad/s]", 2 * pi * unit, "Irvine",
               report.modes[1].omega, 2e-3 * 2 * pi * unit);
  }
  result.add(std::move(table), 1.8, 0.2, "the theory neglects the sag's square");
  return result;
}

/// A column along x, at x = 0 and 1 pinned or clamped (`clamped`), whose far end moves along x: a long stiff
/// link without mass holds it otherwise, hinged to it or rigidly joined; under the force P along it.
BeamModel column(bool clamped_near, bool clamped_far, double P, int elements = 16) {
  ModelBuilder builder = straight(elements);
  const int link = builder.add_beam(ReferenceCurve({line_cubic({1, 0, 0}, {1, 20, 0})}, 2),
                                    BeamProperties{1e10, 1e8, 1e-9}, {2});
  clamped_near ? builder.clamp(0, 0) : builder.pin(0, 0);
  return builder.join(0, 1, link, 0, clamped_far).pin(link, 20).force(0, 1, {-P, 0, 0}).build();
}

double first_factor(const BeamModel& model) {
  return modes_of(model, {.kind = ModesOptions::Kind::buckling, .count = 1}).modes.at(0).factor;
}

VerifyResult euler() {
  VerifyResult result;
  const auto add = [&](const std::string& name, const BeamModel& model, double exact, double tolerance) {
    result.add("P L^2/EI of a column, " + name + ", 16 elements", exact, "Euler", first_factor(model),
               tolerance * exact);
  };
  add("clamped-free", straight(16).clamp(0, 0).force(0, 1, {-1, 0, 0}).build(), pi * pi / 4, 1e-6);
  add("pinned-pinned", column(false, false, 1), pi * pi, 1e-5);
  add("clamped-pinned", column(true, false, 1), 20.190728556, 1e-5);
  add("clamped-clamped", column(true, true, 1), 4 * pi * pi, 1e-3);
  ConvergenceTable table{"P L^2/EI of a clamped-free column", "elements", {}};
  for (const int elements : {1, 2, 4})
    table.rows.emplace_back(
        elements,
        std::abs(first_factor(straight(elements).clamp(0, 0).force(0, 1, {-1, 0, 0}).build()) - pi * pi / 4));
  result.add(std::move(table), 4, 0.3, "cubic elements");
  // Prestress makes frequencies fall to nothing there.
  const double half = frequencies(column(false, false, pi * pi / 2), 1)[0];
  result.add("pinned column under half its critical load, omega^2 over that without", 0.5, "1 - P/P_E",
             half * half / std::pow(pi, 4), 1e-5);
  return result;
}

VerifyResult strip() {
  VerifyResult result;
  ConvergenceTable table{"P L^2/sqrt(EI2 GJ) of a cantilever strip", "elements", {}};
  constexpr double exact = 4.012599344;  // J_{-1/4}(x/2) = 0
  for (const int elements : {4, 8, 16}) {
    BeamProperties strip(1e10, 0, 1);
    strip.sections = SectionStiffness{1e7, 1, 0, 0.5, 0.01};
    ModelBuilder builder(3);
    builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3).oriented({}), strip, {elements});
    const double factor =
        std::abs(first_factor(builder.clamp(0, 0).force(0, 2, {0, 0, 1}).build())) * 4 / std::sqrt(0.5);
    table.rows.emplace_back(elements, std::abs(factor - exact));
    if (elements == 16)
      result.add("P L^2/sqrt(EI2 GJ) of a cantilever strip, 16 elements", exact, "J_-1/4(x/2) = 0", factor,
                 1e-4);
  }
  result.add(std::move(table), 3.5, 0.3, "cubic elements");
  return result;
}

}  // namespace

std::vector<VerifyProblem> modes_problems() {
  const std::string drawn = "material, Green, as drawn", torsion = drawn + ", torsion";
  return {{"modes-straight", drawn, straight_beams},
          {"modes-space", torsion, in_space},
          {"modes-rings", torsion, rings},
          {"modes-bead", drawn, bead},
          {"modes-cables", "material, Green, straight", cables},
          {"modes-euler", drawn, euler},
          {"modes-strip", torsion, strip}};
}

}  // namespace nurbeam
