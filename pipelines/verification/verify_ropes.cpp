// Ropes at rest, with the kinks that loads, crossings and eyelets give them.

#include <Eigen/LU>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/verification/hanging_string.h"
#include "pipelines/verification/rope_cases.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"

namespace nurbeam {

namespace {

using namespace verification;
constexpr double gravity_z = 9.81;

const std::string static_analysis = R"("analysis": { "type": "static" })";

std::string force_at(const std::string& beam, const std::string& at, double x, double y, double z) {
  return R"({ "beam": ")" + beam + R"(", "at": )" + at + R"(, "force": [)" + text_of(x) + ", " + text_of(y) +
         ", " + text_of(z) + "] }";
}

/// Heights of the crossings of the net under loads there, by the force on each: strings in equilibrium, whose
/// places Newton's method finds.
class NetOfStrings {
 public:
  using Places = Eigen::Matrix<double, 12, 1>;  ///< of (x0, y0), (x1, y0), (x0, y1), (x1, y1)

  explicit NetOfStrings(const Eigen::Vector4d& loads) : loads_(loads) {}

  Places solve() const {
    Places places;
    for (int i = 0; i < 4; ++i) places.segment<3>(3 * i) << net_crossings[i % 2], net_crossings[i / 2], 0;
    for (int i = 0; i < 30; ++i) {
      const Places open = forces(places);
      if (open.norm() < 1e-8 * loads_.norm()) break;
      Eigen::Matrix<double, 12, 12> slope;
      constexpr double h = 1e-5;
      for (int k = 0; k < 12; ++k) {
        const Places by = h * Places::Unit(k);
        slope.col(k) = (forces(places + by) - forces(places - by)) / (2 * h);
      }
      places -= slope.partialPivLu().solve(open);
    }
    return places;
  }

 private:
  Places forces(const Places& places) const {
    Places sum = Places::Zero();
    for (int i = 0; i < 4; ++i) sum[3 * i + 2] = loads_[i];
    for (int along = 0; along < 2; ++along)
      for (int cable = 0; cable < 2; ++cable) {
        Eigen::Vector3d last = Eigen::Vector3d::Zero();
        last[1 - along] = net_crossings[cable];
        double s = 0;
        int before = -1;
        for (int k = 0; k < 3; ++k) {
          const int node = k == 2 ? -1 : along == 0 ? k + 2 * cable : cable + 2 * k;
          const double next_s = k == 2 ? net_span : net_crossings[k];
          Eigen::Vector3d next = Eigen::Vector3d::Zero();
          next[along] = net_span;
          next[1 - along] = net_crossings[cable];
          if (node >= 0) next = places.segment<3>(3 * node);
          const double l = next_s - s, w = net_mass * gravity_z;
          const Eigen::Vector3d pull = pull_of_string(next - last, l, net_tension, net_stiffness, w);
          if (before >= 0) sum.segment<3>(3 * before) += pull;
          if (node >= 0) sum.segment<3>(3 * node) -= pull + Eigen::Vector3d(0, 0, w * l);
          last = next, s = next_s, before = node;
        }
      }
    return sum;
  }

  Eigen::Vector4d loads_;
};

VerifyResult net_at_rest() {
  const NetOfStrings::Places exact = NetOfStrings({-1000, -1000, -1000, -2000}).solve();
  std::string loads;
  for (int i = 0; i < 4; ++i)
    loads += (i > 0 ? ", " : "") + force_at("y" + std::to_string(i % 2),
                                            R"({ "length": )" + text_of(net_crossings[i / 2]) + " }", 0, 0,
                                            i == 3 ? -2000 : -1000);
  VerifyResult result;
  for (const int elements : {3, 12})
    result.add("height of the crossing with 2 kN [m], " + std::to_string(elements) + " elements a cable",
               exact[11], "strings between crossings in equilibrium",
               run_text(net_case(elements, R"("loads": [)" + loads + "], " + static_analysis)).probe(0).z(),
               1e-6);
  return result;
}

/// The depth of a load P in the middle of a string without weight: both halves are straight.
double depth_of_load(bool is_hooke, double P) {
  return root(
      [&](double z) {
        const double half = std::hypot(slackline_span / 2, z), stretch = 2 * half / slackline_length;
        const double T =
            slackline_stiffness * (is_hooke ? stretch - 1 : (stretch * stretch - 1) / 2 * stretch);
        return 2 * T * z / half - P;
      },
      0, slackline_span);
}

VerifyResult slackline_at_rest() {
  constexpr double P = 800, mass = 0.2;
  VerifyResult result;
  const std::string load = R"("loads": [)" + force_at("line", R"({ "fraction": 0.5 })", 0, 0, -P) + "], ";
  for (const bool is_hooke : {false, true}) {
    const std::string law = is_hooke ? "hooke" : "green";
    const RunRecord run = run_text(slackline_case(20, law, 1e-6, 0.5, load + static_analysis));
    result.add("depth under a load [m], 20 elements, law " + law, depth_of_load(is_hooke, P),
               "two straight parts", -run.probe(0).z(), 1e-5);
  }
  HangingString string{slackline_length, slackline_span, 0, slackline_stiffness, mass * gravity_z};
  string.pulls = {{.s = slackline_length / 2, .force_z = -P}};
  const double exact = string.solve().pulls[0].z;
  for (const int elements : {2, 8})
    result.add("height of the loaded place [m], with 0.2 kg/m, " + std::to_string(elements) + " elements",
               exact, "a string, by shooting",
               run_text(slackline_case(elements, "green", mass, 0.5, load + static_analysis)).probe(0).z(),
               1e-6);
  return result;
}

VerifyResult bungee_at_rest() {
  constexpr double P = 75 * gravity_z, w = gravity_z, L = bungee_length, EA = bungee_stiffness;
  const std::string load = R"("loads": [)" + force_at("rope", R"("end")", 0, 0, -P) + "], ";
  const auto length = [&](int elements, const char* law) {
    return -run_text(bungee_case(elements, law, 1, 1, load + static_analysis)).probe(0).z();
  };
  VerifyResult result;
  result.add("length under a load [m], 4 elements, law hooke", L + (P * L + w * L * L / 2) / EA,
             "L + (P L + w L^2/2)/EA", length(4, "hooke"), 1e-4);
  double exact = 0;  // Simpson's rule
  constexpr int panels = 200;
  for (int i = 0; i <= panels; ++i)
    exact += L / panels / 3 *
             (i == 0 || i == panels ? 1
              : i % 2 == 1          ? 4
                                    : 2) *
             string_stretch(0, EA, P + w * L * i / panels);
  for (const int elements : {1, 4})
    result.add("length under a load [m], law green, " + std::to_string(elements) + " elements", exact,
               "the integral of the stretch", length(elements, "green"), 1e-6);
  return result;
}

/// A rope of 12 m between points 10 m apart with a hanger at two fifths of it.
VerifyResult hanging_rope_with_hanger() {
  constexpr double length = 12, span = 10, EA = 1e5, mass = 1, P = 100;
  HangingString string{length, span, 0, EA, mass * gravity_z};
  string.pulls = {{.s = 0.4 * length, .force_z = -P}};
  const HangingString::AtPull exact = string.solve().pulls[0];
  VerifyResult result;
  ConvergenceTable table{"the hanger's place [m]", "elements", {}};
  for (const int elements : {10, 20, 40}) {
    const RunRecord run = run_text(hanging_case(
        elements, length, span, EA, mass,
        R"("loads": [)" + force_at("rope", R"({ "fraction": 0.4 })", 0, 0, -P) + "], " + static_analysis));
    table.rows.emplace_back(elements, (run.probe(0) - Eigen::Vector3d(exact.x, 0, exact.z)).norm());
  }
  result.add("error of the hanger's place [m], 40 elements", 0, "a string, by shooting",
             table.rows.back().second, 1e-7);
  result.add(std::move(table), 2, 0.1, "second order where kinks are");
  return result;
}

/// Half of a rope through two eyelets, which weights pull taut at its tails and a hook in its middle: its
/// tension is that of the tails.
VerifyResult arresting_rope_at_rest() {
  constexpr double half = 17, tail = 60, EA = 2e7, T = 2e4, P = 1.5e4;
  const double sine = P / T, cosine = std::sqrt(1 - sine * sine), stretch = string_stretch(0, EA, T);
  VerifyResult result;
  for (const int elements : {20, 40}) {
    const RunRecord run = run_text(arresting_case(
        elements, EA, half, tail,
        force_at("rope", R"("start")", P, 0, 0) + ", " + force_at("rope", R"("end")", 0, T, 0)));
    const std::string mesh = ", " + std::to_string(elements) + " elements";
    result.add("way of the hook [m]" + mesh, half * sine / cosine, "two straight parts", run.probe(0).x(),
               1e-6);
    result.add("place of the tail's end [m]" + mesh, half + stretch * (half + tail) - half / cosine,
               "two straight parts", run.frames[0].probes[1].position.y(), 1e-6);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> rope_problems() {
  return {{"rope-net", "material, Green, under tension", net_at_rest},
          {"rope-slackline", "material, Green and Hooke, straight", slackline_at_rest},
          {"rope-bungee", "material, Green and Hooke, straight", bungee_at_rest},
          {"rope-hanger", "material, Green, straight", hanging_rope_with_hanger},
          {"rope-arresting", "material, Green, straight", arresting_rope_at_rest}};
}

}  // namespace nurbeam
