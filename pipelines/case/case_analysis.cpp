#include "pipelines/case/case_analysis.h"

#include <algorithm>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// Of a step.
Range time_step() { return shapes::plausible(1e-12, 1e9); }

// The tolerance when nothing is said. On a guide a step is long beside its bends, and cheap.
double usual_tolerance(bool nothing_deforms) { return nothing_deforms ? 1e-6 : 1e-4; }

// Steps are fixed where the tolerance is 0; else the integrator chooses them by it.
IntegratorSettings read_integrator(const Json& json, double tolerance, Findings& findings) {
  enum class Method { generalized_alpha, radau, ida, rk4 };
  const auto method = chosen<Method>(json, "type",
                                     {{"generalized-alpha", Method::generalized_alpha},
                                      {"radau", Method::radau},
                                      {"ida", Method::ida},
                                      {"rk4", Method::rk4}});
  if (method != Method::generalized_alpha && has(json, "rho_infinity"))
    findings.add(Severity::warning, "analysis.integrator.rho_infinity",
                 "has an effect with \"generalized-alpha\" only");
  if (method == Method::ida)
    findings.error("analysis.integrator.type",
                   "is \"ida\", which nurbeam no longer has; use \"radau\": of error control too, and for "
                   "friction, stops and stiff beams");
  switch (method) {
    case Method::ida:
    case Method::radau:
      return Radau{.tolerance = tolerance};
    case Method::rk4:
      return ExplicitRungeKutta{};
    case Method::generalized_alpha:
      break;
  }
  return GeneralizedAlpha{.rho_infinity = number(json, "rho_infinity", GeneralizedAlpha{}.rho_infinity),
                          .tolerance = tolerance,
                          .settles = !has(json, "settle") || flag(json, "settle")};
}

std::vector<double> read_load_factors(const Json& json, Findings& findings) {
  if (!has(json, "load_steps")) return {};
  std::vector<double> factors;
  if (json["load_steps"].is_array()) {
    factors = numbers(json, "load_steps");
  } else {
    const int count = json["load_steps"].get<int>();
    for (int k = 1; k <= count; ++k) factors.push_back(k / static_cast<double>(count));
  }
  for (std::size_t i = 0; i + 1 < factors.size(); ++i)
    if (!(factors[i] < factors[i + 1]))
      findings.error(child("analysis.load_steps", i + 1), "is " + text_of(factors[i + 1], all_digits) +
                                                              " after " + text_of(factors[i], all_digits) +
                                                              "; factors must increase");
  return factors;
}

CaseAccuracy read_accuracy(const Json& json) {
  CaseAccuracy accuracy;
  if (!has(json, "accuracy")) return accuracy;
  const Json& value = json["accuracy"];
  accuracy.is_on = !value.is_boolean() || value.get<bool>();
  if (value.is_boolean()) return accuracy;
  accuracy.target = optional_number(value, "target");
  accuracy.limit = number(value, "limit", accuracy.limit);
  for (const Json& item : part(value, "of"))
    if (!item.is_null()) accuracy.of.push_back(item.get<std::string>());
  return accuracy;
}

}  // namespace

Shape analysis_shape() {
  using namespace shapes;
  const Shape integrator = object(
      {{"type", choice({"generalized-alpha", "radau", "ida", "rk4"}),
        "radau: Radau IIA of order five, for adaptive or long steps; rk4: explicit, fixed `step`, no sliding "
        "bodies; ida, of version 0.1, is refused; generalized-alpha when omitted"},
       {"rho_infinity", quantity(Dimension::number, {.lower = 0, .upper = 1}),
        "spectral radius of generalized-alpha at infinite frequency; 0.8 when omitted"},
       {"settle", boolean(),
        "whether generalized-alpha projects velocities onto constraints that turn; true when omitted. Derivatives of "
        "motions are those of false"}});
  const Shape length_control =
      object({{"min", quantity(Dimension::number, {.lower = 0, .upper = 1, .open = true}),
               "a shorter element is merged; 0.1 when omitted (the paper's: 0.5)"},
              {"max", quantity(Dimension::number, {.lower = 1, .open = true}),
               "a longer element is split; 1.15 when omitted (the paper's: 1.5)"}});
  const Shape modes = object(
      {{"count", integer({.lower = 1, .upper = 1000}), "how many, from the lowest on; 10 when omitted"},
       {"about", choice({"equilibrium", "drawn"}),
        "the state: in equilibrium under all loads, for buckling under gravity; or in the reference configuration, without loads; "
        "equilibrium when omitted"},
       {"bodies", choice({"held", "free"}),
        "sliding bodies are locked at their `at`, or slide without friction, about their equilibrium; held when "
        "omitted"},
       {"speeds", array(quantity(Dimension::angular_speed, {.lower = 0, .upper = 1e6}), 2),
        "natural frequencies over these speeds of rotation, increasing, and the critical speeds between them: "
        "of the `rotor` of rigid bodies, those after the first at their own ratio to it; without rotors of "
        "the `frame`"}});
  const Shape accuracy = object(
      {{"target", quantity(Dimension::part, accuracy_target_range()),
        "refines elements and steps until the errors of what is asked are below this part of their scales"},
       {"of", array(any_text(), 1),
        "columns, extremes (\"max(trolley.speed)\"), events whose errors count; when omitted positions, displacements, speeds, reactions, connectors' forces, frequencies and the maximum axial force and moment of each beam"},
       {"limit", quantity(Dimension::number, {.lower = 1, .upper = 1e6}),
        "most work, over that of the plain run; 64 when omitted"}});
  return object(
      {{"type", choice({"dynamic", "static", "modes", "buckling"}),
        "motion, equilibrium, natural frequencies, or the factors of the loads under which it "
        "buckles; dynamic when omitted"},
       {"modes", modes, "of modes and buckling"},
       {"initial", choice({"as-drawn", "equilibrium"}),
        "state at time 0; equilibrium: statics first, sliding bodies locked at their `at`; as-drawn "
        "when omitted"},
       {"end_time", quantity(Dimension::time, plausible(1e-9, 1e9)),
        "end of the motion; a dynamic analysis needs it"},
       {"step", quantity(Dimension::time, time_step()), "fixed step"},
       {"tolerance",
        quantity(Dimension::number,
                 {.lower = 1e-14, .upper = 1, .reason = "less is round-off, more no accuracy"}),
        "local error of adaptive steps; 1e-4 when omitted, or 1e-6 where all beams are rigid curves"},
       {"load_steps",
        either(integer({.lower = 1, .upper = 10000}), array(quantity(Dimension::number, not_negative()), 1)),
        "of a static analysis: the state under each of these factors of the loads (weight is always there "
        "in full), increasing, or under so many equal steps up to 1; tables over time are read at the "
        "factor, and a force that moves is there in full where it is at that time; when omitted one state under the "
        "full loads, at the time 0, or 1 where a table or a moving force is read"},
       {"integrator", integrator, "time integrator"},
       {"length_control", length_control,
        "when elements beside a sliding body change, in standard element lengths"},
       {"accuracy", either(boolean(), accuracy),
        "errors of mesh and step, from runs with other elements and steps, as --accuracy asks for them; false when "
        "omitted"}},
      {{{"step", "tolerance"}, false}});
}

CaseAnalysis read_analysis(const Json& json, bool nothing_deforms, Findings& findings) {
  CaseAnalysis analysis;
  analysis.type = chosen<CaseAnalysis::Type>(json, "type",
                                             {{"dynamic", CaseAnalysis::Type::dynamic},
                                              {"static", CaseAnalysis::Type::statics},
                                              {"modes", CaseAnalysis::Type::modes},
                                              {"buckling", CaseAnalysis::Type::buckling}});
  analysis.start_from_equilibrium = text(json, "initial") == "equilibrium";
  const Json& control = part(json, "length_control");
  analysis.length_control = {number(control, "min", analysis.length_control.min),
                             number(control, "max", analysis.length_control.max)};
  analysis.accuracy = read_accuracy(json);
  const bool dynamic = analysis.type == CaseAnalysis::Type::dynamic;
  if (dynamic) {
    analysis.end_time = number(json, "end_time", 0);
    analysis.step = optional_number(json, "step");
    const double tolerance = number(json, "tolerance", usual_tolerance(nothing_deforms));
    analysis.integrator = read_integrator(part(json, "integrator"), analysis.step ? 0 : tolerance, findings);
  }
  if (analysis.type == CaseAnalysis::Type::statics)
    analysis.load_factors = read_load_factors(json, findings);
  else if (has(json, "load_steps"))
    findings.error("analysis.load_steps",
                   "is for a static analysis; give loads a \"time\" table, or \"type\": \"static\"");
  const Json& modes = part(json, "modes");
  if (has(json, "modes") && !analysis.has_modes())
    findings.add(Severity::warning, "analysis.modes",
                 "has no effect but with the type \"modes\" or \"buckling\"");
  analysis.modes = {.count = optional_integer(modes, "count").value_or(CaseModes{}.count),
                    .about_equilibrium = text(modes, "about") != "drawn",
                    .bodies_held = text(modes, "bodies") != "free",
                    .speeds = numbers(modes, "speeds")};
  if (dynamic && analysis.is_explicit() && !analysis.step)
    findings.error("analysis.step", "is missing; the explicit method \"rk4\" needs a fixed step");
  return analysis;
}

bool has_tables(const CaseFile& read) {
  const auto any = [](const auto& list, const auto& has) {
    return std::any_of(list.begin(), list.end(), has);
  };
  return !read.laws.empty() || any(read.beams, [](const CaseBeam& beam) {
    return beam.temperature.size() > 1;
  }) || any(read.loads, [](const CaseLoad& load) {
    return !load.time.empty() || load.moving_speed;
  }) || any(read.supports, [](const CaseSupport& s) {
    return !s.motion.empty() || s.motion_law || s.rotation;
  }) || any(read.sliding_joints, [](const CaseSlidingJoint& joint) {
    return joint.motion.is_given() || joint.motion_law ||
           (joint.friction && joint.friction->force.size() > 1);
  }) || any(read.eyelets, [](const CaseEyelet& eyelet) {
    return eyelet.motion.is_given() || !eyelet.moves.empty() || eyelet.force.size() > 1;
  }) || any(read.reels, [](const CaseReel& reel) {
    return reel.motion.is_given() || !reel.moves.empty() || reel.force.size() > 1;
  });
}

}  // namespace nurbeam
