// Ropes that move, beside masses and springs.

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/verification/mass_chain.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"

namespace nurbeam {

namespace {

using namespace verification;

const Eigen::Vector3d weight_of_a_kilogram(0, 0, -9.81);
const std::string of_masses = "masses and springs, extrapolated";

std::string motion(double end, double step) {
  return R"("analysis": { "type": "dynamic", "end_time": )" + text_of(end) + R"(, "step": )" + text_of(step) +
         " }";
}

/// A mass on a beam, which a connector without stiffness holds.
std::string weight_on(const std::string& beam, const std::string& at, double mass) {
  return R"({ "name": "mass )" + text_of(mass) + " on " + beam + R"(", "from": { "beam": ")" + beam +
         R"(", "at": )" + at + R"( }, "to": { "point": [0, 0, 100] }, "stiffness": 0, "end_masses": [)" +
         text_of(mass) + ", 0] }";
}

/// Heights of a place at times, from those of chains of `parts` and twice as many, whose error falls with the
/// square.
template <class Heights>
std::vector<double> extrapolated(int parts, const Heights& heights) {
  const std::vector<double> coarse = heights(parts), fine = heights(2 * parts);
  std::vector<double> limit;
  for (std::size_t i = 0; i < fine.size(); ++i) limit.push_back(fine[i] + (fine[i] - coarse[i]) / 3);
  return limit;
}

std::vector<double> heights_of(MassChain& chain, int mass, const std::vector<double>& times) {
  std::vector<double> heights;
  for (const double t : times) {
    if (t > 0) chain.advance(t);
    heights.push_back(chain.place(mass).z());
  }
  return heights;
}

/// The table of largest errors over a run, and a row for its finest mesh.
template <class Run>
void add_table(VerifyResult& result, const std::string& what, const std::vector<int>& meshes,
               const std::vector<double>& heights, double tolerance, const Run& run) {
  ConvergenceTable table{what, "elements", {}};
  for (const int elements : meshes)
    table.rows.emplace_back(elements, largest_z_error(run(elements), heights));
  result.add("largest error of " + what + ", " + std::to_string(meshes.back()) + " elements", 0, of_masses,
             table.rows.back().second, tolerance);
  result.add(std::move(table), 2, 0.2, "at least second order");
}

/// The net falls from the level, with masses at its crossings.
VerifyResult falling_net() {
  constexpr double masses[] = {20, 25, 30, 40}, end = 0.4;
  std::string connectors;
  for (int i = 0; i < 4; ++i)
    connectors +=
        (i > 0 ? ", " : "") + weight_on("y" + std::to_string(i % 2),
                                        R"({ "length": )" + text_of(net_crossings[i / 2]) + " }", masses[i]);
  const std::vector<double> times = even_times(end, 8);
  const std::vector<double> heights = extrapolated(24, [&](int parts) {
    MassChain chain(weight_of_a_kilogram);
    int nodes[4];
    for (int i = 0; i < 4; ++i)
      nodes[i] = chain.add_mass(masses[i], {net_crossings[i % 2], net_crossings[i / 2], 0});
    const MassChainLaw law{net_tension, net_stiffness, net_mass};
    for (int along = 0; along < 2; ++along)
      for (int cable = 0; cable < 2; ++cable) {
        Eigen::Vector3d start = Eigen::Vector3d::Zero();
        start[1 - along] = net_crossings[cable];
        Eigen::Vector3d finish = start;
        finish[along] = net_span;
        const int first = chain.add_mass(0, start), last = chain.add_mass(0, finish);
        chain.hold(first);
        chain.hold(last);
        const int a = along == 0 ? nodes[2 * cable] : nodes[cable],
                  b = along == 0 ? nodes[2 * cable + 1] : nodes[cable + 2];
        for (const auto& [from, to] : {std::pair(first, a), std::pair(a, b), std::pair(b, last)})
          chain.add_string(from, to, net_span / 3, parts, law);
      }
    return heights_of(chain, nodes[3], times);
  });
  VerifyResult result;
  add_table(result, "a crossing's height [m]", {3, 6}, heights, 1e-5, [&](int elements) {
    return run_text(net_case(elements, R"("connectors": [)" + connectors + "], " + motion(end, 5e-4)));
  });
  return result;
}

/// A webbing without sag takes a weight at two fifths of it.
VerifyResult slackline_that_is_stepped_on() {
  constexpr double mass = 0.5, walker = 75, fraction = 0.4, end = 1.2;
  const std::vector<double> times = even_times(end, 12);
  const std::vector<double> heights = extrapolated(40, [&](int parts) {
    MassChain chain(weight_of_a_kilogram);
    const int first = chain.add_mass(0, {0, 0, 0}), last = chain.add_mass(0, {slackline_span, 0, 0}),
              under = chain.add_mass(walker, {fraction * slackline_span, 0, 0});
    chain.hold(first);
    chain.hold(last);
    const MassChainLaw law{0, slackline_stiffness, mass, true};
    chain.add_string(first, under, fraction * slackline_length, 2 * parts, law);
    chain.add_string(under, last, (1 - fraction) * slackline_length, 3 * parts, law);
    return heights_of(chain, under, times);
  });
  VerifyResult result;
  add_table(result, "the walker's height [m]", {5, 10}, heights, 1e-5, [&](int elements) {
    return run_text(slackline_case(elements, "hooke", mass, fraction,
                                   R"("connectors": [)" +
                                       weight_on("line", R"({ "fraction": 0.4 })", walker) + "], " +
                                       motion(end, 5e-4)));
  });
  return result;
}

/// A jump with a rope that weighs nothing beside the jumper: where its energy is all in the rope.
double deepest(bool is_hooke, double mass) {
  return root(
      [&](double x) {
        const double stretch = 1 + x / bungee_length, strain = (stretch * stretch - 1) / 2;
        const double energy = is_hooke ? (stretch - 1) * (stretch - 1) / 2 : strain * strain / 2;
        return bungee_stiffness * bungee_length * energy - mass * 9.81 * x;
      },
      1, 100);
}

VerifyResult bungee_jump() {
  constexpr double jumper = 75;
  VerifyResult result;
  const std::string weight = R"("connectors": [)" + weight_on("rope", R"("end")", jumper) + "], ";
  for (const bool is_hooke : {false, true}) {
    const std::string law = is_hooke ? "hooke" : "green";
    const RunRecord run = run_text(
        bungee_case(4, law, 1e-3, 0.01,
                    weight + R"("analysis": { "type": "dynamic", "end_time": 5, "tolerance": 1e-5 })"));
    double low = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) low = std::min(low, run.probe(i).z());
    result.add("greatest depth [m], law " + law, bungee_length + deepest(is_hooke, jumper),
               "all energy in the rope", -low, 0.02);
  }
  constexpr double mass = 1, end = 4;
  const std::vector<double> times = even_times(end, 8);
  const std::vector<double> heights = extrapolated(
      80,
      [&](int parts) {
        MassChain chain(weight_of_a_kilogram);
        const int top = chain.add_mass(0, {0, 0, 0}), bottom = chain.add_mass(jumper, {0, 0, -bungee_length});
        chain.hold(top);
        chain.add_string(top, bottom, bungee_length, parts, {0, bungee_stiffness, mass, true});
        return heights_of(chain, bottom, times);
      });
  add_table(result, "the jumper's height [m], 1 kg/m, law hooke", {2, 4, 8}, heights, 2e-5,
            [&](int elements) {
              return run_text(bungee_case(elements, "hooke", mass, 0.5, weight + motion(end, 1e-3)));
            });
  return result;
}

/// A rope of 2 m with a weight at its end that whirls about the plumb line through its start, level at first,
/// and sinks.
VerifyResult whirling_chain() {
  constexpr double length = 2, mass = 0.5, EA = 5e4, weight = 0.5, spin = 8, end = 0.5;
  const Eigen::Vector3d tip(length, 0, 0);
  const std::vector<double> times = even_times(end, 10);
  const auto places = [&](int parts) {
    MassChain chain(weight_of_a_kilogram);
    const int top = chain.add_mass(0, {0, 0, 0}),
              bottom = chain.add_mass(weight, tip, Eigen::Vector3d(0, 0, spin).cross(tip));
    chain.hold(top);
    chain.add_string(top, bottom, length, parts, {0, EA, mass});
    std::vector<Eigen::Vector3d> at;
    for (const double t : times) {
      if (t > 0) chain.advance(t);
      at.push_back(chain.place(bottom));
    }
    return at;
  };
  const std::vector<Eigen::Vector3d> coarse = places(100), fine = places(200);
  VerifyResult result;
  ConvergenceTable table{"the weight's place [m]", "elements", {}};
  for (const int elements : {4, 8, 16}) {
    const RunRecord run = run_text(whirling_case(
        elements, tip, EA, mass, spin,
        R"("connectors": [)" + weight_on("rope", R"("end")", weight) + "], " + motion(end, 2.5e-4)));
    double largest = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      largest = std::max(largest, (run.probe(i) - fine[i] - (fine[i] - coarse[i]) / 3).norm());
    table.rows.emplace_back(elements, largest);
  }
  result.add("largest error of the weight's place [m], 16 elements", 0, of_masses, table.rows.back().second,
             2e-4);
  result.add(std::move(table), 2, 0.2, "at least second order");
  return result;
}

/// The speed of the aircraft at a place of the rope's middle.
double speed_at(const RunRecord& run, double x) {
  for (std::size_t i = 1; i < run.frames.size(); ++i) {
    const PointRecord &last = run.frames[i - 1].bodies[1].point, &now = run.frames[i].bodies[1].point;
    const double from = last.position.x() + 1, to = now.position.x() + 1;
    if (to < x) continue;
    const double part = (x - from) / (to - from);
    return (1 - part) * last.velocity.x() + part * now.velocity.x();
  }
  return NAN;
}

/// What comes out behind the brake is slack. The chain runs over a round sheave of 0.3 m.
VerifyResult arresting_gear() {
  VerifyResult result;
  const std::string source = "a chain of 308 masses and springs";
  for (const double longest : {2.0, 1.0}) {
    const RunRecord run = run_text(arrested_aircraft(longest));
    const std::string mesh = ", elements of " + text_of(longest) + " m";
    result.add("speed at 20 m [m/s]" + mesh, 57.53, source, speed_at(run, 20), 0.575);
    result.add("speed at 30 m [m/s]" + mesh, 50.27, source, speed_at(run, 30), 0.503);
    double folded = 0;
    for (const Snapshot& frame : run.frames)
      for (const ElementRecord& element : frame.beams[0].elements) folded = std::max(folded, element.folded);
    result.add("strain that elements do not see, at most" + mesh, 0, "0.2 where a rope folds back", folded,
               0.2);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> rope_motion_problems() {
  return {{"rope-net-falls", "material, Green, under tension", falling_net},
          {"rope-slackline-steps", "material, Hooke, straight", slackline_that_is_stepped_on},
          {"rope-bungee-jump", "material, Green and Hooke, straight", bungee_jump},
          {"rope-arresting-gear", "material, Green, straight", arresting_gear},
          {"rope-chain-whirls", "material, Green, straight", whirling_chain}};
}

}  // namespace nurbeam
