// Beams in space whose sections twist: against Kirchhoff rods solved as initial value problems (DOP853 to
// 1e-12, shooting, no finite elements), closed forms and critical loads.

#include <cmath>

#include "fem/element/section_frame.h"
#include "fem/system/assembly.h"
#include "fem/system/observables.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/rod_models.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Rule = Orientation::Rule;

struct Tip {
  Vector3d r, d1;  ///< position and first axis of the section [m], [-]
};

/// Errors of the tip and its section on meshes refined by 2; the finest one's tolerance is `allowed`.
VerifyResult tip_against(const std::function<ModelBuilder(int elements)>& model, const Tip& exact,
                         const std::vector<int>& meshes, double allowed, double order,
                         const std::string& source) {
  VerifyResult result;
  ConvergenceTable table{"the tip [m]", "elements", {}};
  for (const int elements : meshes) {
    const Rest rest(model(elements));
    table.rows.emplace_back(elements, (rest.tip() - exact.r).norm());
    if (elements != meshes.back()) continue;
    const std::string on = ", " + std::to_string(elements) + " elements";
    for (int i = 0; i < 3; ++i)
      result.add(std::string("tip ") + "xyz"[i] + " [m]" + on, exact.r[i], source, rest.tip()[i], allowed);
    if (!exact.d1.isZero(0))
      result.add("turn of the tip's section [rad]" + on, 0, source, (rest.axis() - exact.d1).norm(), allowed);
  }
  result.add(std::move(table), order, 0.1, "cubic elements");
  return result;
}

const char* const rod_source = "Kirchhoff rod, shooting";

/// The 45-degree bend of Bathe & Bolourchi (1979), without shear.
VerifyResult bend(double GJ, const Vector3d& tip, const Vector3d& d1) {
  const Vector3d center(100, 0, 0), end = center + 100 * Vector3d(-std::cos(pi / 4), std::sin(pi / 4), 0);
  const ReferenceCurve curve =
      ReferenceCurve(arc_cubics(center, Vector3d::Zero(), end, -Vector3d::UnitZ()), 3).oriented({});
  const auto model = [&](int elements) {
    ModelBuilder builder = clamped(curve, {1e7, 1e7 / 12, 1e7 / 12, 0, GJ}, elements);
    return builder.force(0, curve.length(), {0, 0, 600});
  };
  return tip_against(model, {tip, d1}, {8, 16, 32}, 6e-6, 4, rod_source);
}

ReferenceCurve rational_curve() {
  return ReferenceCurve(
      {cubic({Vector3d(0, 0, 0), Vector3d(1, 0, 0.2), Vector3d(1.2, 1, 0.4), Vector3d(0.6, 1.5, 1.4)},
             {1, 0.8, 1.3, 1})},
      3);
}
/// Its sections turn by 2.5 rad/m against parallel transport.
ReferenceCurve twisted_curve() {
  const ReferenceCurve curve = rational_curve();
  return curve.oriented({Rule::start, Vector3d::UnitZ(), {{0, 0}, {curve.length(), 2.5 * curve.length()}}});
}
const Rod twisted_rod{1e4, 3, 1, 0.2, 0.7};

VerifyResult twisted_under_force() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = twisted_curve();
    return clamped(curve, twisted_rod, elements).force(0, curve.length(), {0.4, -0.6, 0.5});
  };
  return tip_against(model,
                     {{1.326666613811, -0.396681428473, 1.822346556629},
                      {-0.115459902466, -0.746947324561, -0.654781417922}},
                     {16, 32}, 5.6e-5, 3.8, rod_source);
}

VerifyResult twisted_under_moment() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = twisted_curve();
    return clamped(curve, twisted_rod, elements)
        .force(0, curve.length(), {0.4, -0.6, 0.5})
        .moment(0, curve.length(), {0.2, 0.3, -0.25});
  };
  VerifyResult result = tip_against(model,
                                    {{1.535133495032, -0.581217054969, 1.676096937505},
                                     {-0.868734733306, -0.419526229834, -0.263244573790}},
                                    {16, 32}, 7.6e-5, 3.8, rod_source);
  return result;
}

VerifyResult upright_under_weight() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = rational_curve().oriented({Rule::up, Vector3d::UnitZ()});
    ModelBuilder builder = clamped(curve, {1e4, 3, 1, 0, 0.7}, elements);
    builder.force(0, curve.length(), {0.4, -0.6, 0.5}).add(LineLoad{0, {0, 0, -0.3}, {}});
    return builder;
  };
  return tip_against(
      model,
      {{1.490455617305, -0.304853644010, 1.575171803665}, {0.701054851321, -0.394174798419, -0.594262840611}},
      {8, 16, 32}, 8e-6, 3.8, rod_source);
}

VerifyResult quarter_helix() {
  const auto model = [](int elements) {
    const ReferenceCurve curve =
        ReferenceCurve(
            hermite([](double x) { return Vector3d(std::cos(x), std::sin(x), x / pi); },
                    [](double x) { return Vector3d(-std::sin(x), std::cos(x), 1 / pi); }, pi / 2, elements),
            3)
            .oriented({Rule::up, Vector3d::UnitZ()});
    return clamped(curve, {1e5, 2, 1, 0, 0.8}, elements)
        .force(0, curve.length(), {0.5, 0.4, -0.6})
        .moment(0, curve.length(), {0.1, -0.2, 0.3});
  };
  return tip_against(
      model,
      {{0.337353395344, 1.244589969902, -0.448814079382}, {-0.804866436272, -0.039339332993, 0.592150687446}},
      {8, 16, 32}, 2e-7, 3.8, rod_source);
}

VerifyResult rod_to_helix() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3).oriented({});
    return clamped(curve, {1e4, 0.8, 0.8, 0, 0.5}, elements).moment(0, 2, {1.2, 1.6, 0.8});
  };
  return tip_against(
      model,
      {{0.420370514864, 0.999755712464, 0.369932802776}, {-0.320449264224, -0.931946593382, 0.169669726651}},
      {8, 16, 32}, 1.1e-5, 3.8, "an exact helix about the moment");
}

VerifyResult torque_about_the_tangent() {
  const auto model = [](int elements) {
    const ReferenceCurve curve = ReferenceCurve({cubic({Vector3d(0, 0, 0), Vector3d(0.5, 0.9, 0),
                                                        Vector3d(1.6, 0.9, 0.7), Vector3d(1.9, -0.2, 0.5)},
                                                       {1, 1.4, 0.7, 1.1})},
                                                3)
                                     .oriented({Rule::up, {0, 1, 1}});
    ModelBuilder builder = clamped(curve, {2e4, 1, 2.5, -0.3, 0.6}, elements);
    const double L = curve.length();
    builder.force(0, L, {0.3, 0.5, -0.4})
        .add(Moment{{.beam = 0, .s = L, .value = 0.5 * curve.tangent(L), .follower = true, .time = {}}});
    return builder;
  };
  return tip_against(
      model,
      {{1.727174491866, 0.766102244670, -1.078367453319}, {0.185921980327, -0.944121401632, -0.272153993560}},
      {8, 16, 32}, 4.6e-6, 3.8, rod_source);
}

// ---- The drawn shape ----

/// The drawn shape turned by R, sections and all.
State turned_drawing(const BeamSystem& system, const Eigen::Matrix3d& R) {
  State state = drawn_state(system);
  const ReferenceCurve& curve = system.model().beams[0].curve;
  for (const MeshNode& node : system.mesh().nodes[0]) {
    const DrawnSection drawn = curve.section(node.s, node.s == curve.length());
    Eigen::Matrix3d chart;
    chart << drawn.d1, drawn.d2, drawn.t;
    const Vector3d t = R * drawn.t, d1 = R * drawn.d1;
    const SectionTriad<double> at_zero = section_at_node<double>(chart, t, 0.0);
    state.q.segment<3>(node.r) = R * curve.position(node.s);
    state.q.segment<3>(node.slope_left) = t;
    state.q[node.angle_left] = std::atan2(d1.dot(at_zero.d2), d1.dot(at_zero.d1));
  }
  return state;
}

VerifyResult turned_drawings() {
  VerifyResult result;
  for (const double degrees : {0, 30, 90, 170, 180, 720}) {
    double force = 0, strain_energy = 0;
    for (const int elements : {1, 2, 4, 8}) {
      ModelBuilder builder(3);
      builder.add_beam(twisted_curve(), twisted_rod.properties(), {elements});
      const BeamSystem system(noted(builder.build()));
      const Vector3d about = Vector3d(0.6, 0.5, 0.62).normalized();  // no tangent comes to its opposite
      const State state =
          turned_drawing(system, Eigen::AngleAxisd(degrees * pi / 180, about).toRotationMatrix());
      VectorXd dynamics(system.coordinate_count()), none(0);
      system.residual(state, dynamics, none);
      const SystemEnergy energy = nurbeam::energy(system, state);
      force = std::max(force, dynamics.norm());
      strain_energy = std::max(strain_energy, energy.axial + energy.bending + energy.torsion);
    }
    const std::string turned = ", turned by " + std::to_string(static_cast<int>(degrees)) + " degrees";
    result.add("force [N], 1 to 8 elements" + turned, 0, "the drawn shape is free of stress", force, 1e-10);
    result.add("strain energy [J]" + turned, 0, "the drawn shape is free of stress", strain_energy, 1e-25);
  }
  return result;
}

}  // namespace

std::vector<VerifyProblem> torsion_problems() {
  const std::string measures = "material, Green, as drawn, torsion";
  return {
      {"torsion-bend", measures,
       [] {
         return bend(1e7 / 12, {15.685355756, 47.152150168, 53.471762721},
                     {-0.4165758761, -0.8163498388, 0.4000468473});
       }},
      {"torsion-bend-square", measures,
       [] {
         return bend(0.140577014955 * 5e6, {15.558334235, 46.893617693, 53.604283430}, Vector3d::Zero());
       }},
      {"torsion-twisted-force", measures, twisted_under_force},
      {"torsion-twisted-moment", measures, twisted_under_moment},
      {"torsion-upright-weight", measures, upright_under_weight},
      {"torsion-helix", measures, quarter_helix},
      {"torsion-rod-to-helix", measures, rod_to_helix},
      {"torsion-drawn", measures, turned_drawings},
      {"torsion-follower", measures, torque_about_the_tangent},
  };
}

}  // namespace nurbeam
