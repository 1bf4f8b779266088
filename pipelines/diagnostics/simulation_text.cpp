#include "pipelines/diagnostics/simulation_text.h"

#include <algorithm>
#include <numbers>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

const char* reason_of(StepStatus status) {
  switch (status) {
    case StepStatus::not_converged:
      return "Newton's iteration does not converge";
    case StepStatus::singular_matrix:
      return "the iteration matrix is singular";
    case StepStatus::inadmissible:
      return "an element would turn inside out";
    case StepStatus::inaccurate:
      return "their error, or energy from nowhere, stays above what the \"tolerance\" allows";
    case StepStatus::converged:
      break;
  }
  return "converged";
}

std::string reason_of(StaticStatus status) {
  switch (status) {
    case StaticStatus::singular_matrix:
      return "the tangent is singular (is the model held everywhere?)";
    case StaticStatus::unstable:
      return "only unstable ones, which the model leaves when it is touched";
    case StaticStatus::lost_in_round_off:
      return "the loads are lost in the round-off of forces along a beam: a slender one (a section of a hundredth of "
             "the \"area\" and the same \"second_moment\" bends alike), or one of very many short elements (take "
             "fewer)";
    case StaticStatus::not_converged:
    case StaticStatus::converged:
      break;
  }
  return "the solver does not converge";
}

// Where each body is and how fast it slides, each after a semicolon.
std::string places_text(const std::vector<BodyPlace>& bodies, const BeamModel& model) {
  std::string text;
  for (const BodyPlace& body : bodies) {
    const Rider& joint = model.riders[body.rider];
    text += "; \"" + model.body_of(joint).name + "\" is at s = " + text_of(body.s, 8) + " m of beam \"" +
            model.beam_of(joint).name + "\" with ds/dt = " + text_of(body.rate, 8) + " m/s";
  }
  return text;
}

// What may help where a body hangs in a slack beam.
std::string slope_hint(const BeamModel& model) {
  const bool bends = std::any_of(model.riders.begin(), model.riders.end(),
                                 [](const Rider& joint) { return joint.continuous_slope; });
  return bends
             ? "; for a cable that hardly resists bending, give its sliding joint \"slope\": \"discontinuous\""
             : "";
}

// Only the rings of eyelets and reels have no mass.
bool is_ring(const BeamModel& model, int rider) { return model.body_of(model.riders[rider]).mass == 0; }

// On a beam that deforms bodies that come near each other are as good as met.
std::string meeting_text(const Failure& failure, const BeamModel& model) {
  const Rider& joint = model.riders[failure.rider];
  const bool has_ring = is_ring(model, failure.rider) || is_ring(model, failure.other);
  const auto named = [&](int rider) {
    const std::string kind = !has_ring               ? ""
                             : is_ring(model, rider) ? (model.riders[rider].reel ? "reel " : "eyelet ")
                                                     : "sliding body ";
    return kind + "\"" + model.body_of(model.riders[rider]).name + "\"";
  };
  const std::string both = (has_ring ? "" : "sliding bodies ") + named(failure.rider) + " and " +
                           named(failure.other),
                    where = " on beam \"" + model.beam_of(joint).name +
                            "\" at t = " + text_of(failure.time, 8) + " s";
  if (model.beam_of(joint).rigid) return both + " meet" + where + "; give a stop that keeps them apart";
  const std::string near = both + " are " + text_of(failure.distance, 3) + " m apart" + where +
                           ", and nearer than " + text_of(failure.nearest) +
                           " m, a twentieth of an element, their motion is not followed; ";
  if (has_ring)
    return near +
           "nothing passes an eyelet or a reel: end the run before, place it elsewhere, or take more elements";
  return near + "give a stop between them with a \"gap\" of at least " + text_of(2 * failure.nearest) +
         " m, or more elements";
}

// Where an explicit method was unstable, how long its steps may be.
std::string shorter_step(const Failure& failure, const char* otherwise) {
  if (failure.stable_step == 0) return otherwise;
  return "; the \"step\" is too long for \"rk4\", which is unstable above about " +
         text_of(failure.stable_step, 2) +
         " s with these elements: take a shorter one, a \"tolerance\" instead, or " +
         "\"generalized-alpha\", which is stable with any";
}

const char* step_hint(StepStatus status) {
  if (status == StepStatus::inaccurate)
    return "; a larger \"tolerance\", more elements, or a \"step\" in its place may help";
  return "; a shorter \"step\" from the start, or a \"tolerance\", may help";
}

// That a model without supports moves as a whole.
std::string unsupported_text(const BeamModel& model) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const Beam& beam : model.beams) names.push_back("beam \"" + beam.name + "\"");
  for (const Body& body : model.bodies)
    if (body.rigid) names.push_back("body \"" + body.name + "\"");
  std::string first;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) first += (i == 0 ? "" : ", ") + names[i];
  return "the model has no support: nothing holds " + first + (names.size() > most ? ", ..." : "") +
         (model.riders.empty() ? "" : " with what slides on it") + "; add \"supports\"";
}

// The beam on which a body slides.
std::string slides_on_text(const std::string& body, const BeamModel& model) {
  for (const Rider& joint : model.riders)
    if (model.body_of(joint).name == body) return " on beam \"" + model.beam_of(joint).name + "\"";
  return "";
}

// What moves where the tangent is singular.
std::string free_part_text(const Failure& failure, const BeamModel& model) {
  const std::string singular = "the tangent is singular (is the model held everywhere?)";
  if (model.constraints.empty() && model.connectors.empty()) return unsupported_text(model);
  if (!failure.loose) return singular;
  const LoosePart& loose = *failure.loose;
  const auto component = [](double value) { return text_of(std::abs(value) < 1e-3 ? 0 : value, 3); };
  const Eigen::Vector3d& d = loose.direction;
  return singular + ": nothing holds " +
         (loose.is_body ? "body \"" + loose.name + "\"" + slides_on_text(loose.name, model)
                        : "beam \"" + loose.name + "\"") +
         ": in the motion that is free " +
         (loose.is_body ? "it moves" : "its place at s = " + text_of(loose.s, 6) + " m moves furthest") +
         " along [" + component(d[0]) + ", " + component(d[1]) + ", " + component(d[2]) + "]" +
         turns_about_text(model, loose) + "; add a support that holds it there, or clamp one that only pins";
}

std::string failure_text(const Failure& failure, const BeamModel& model) {
  const std::string time = text_of(failure.time, 8) + " s", places = places_text(failure.places, model);
  switch (failure.kind) {
    case Failure::Kind::initial_velocities:
      return "the initial velocities cannot be made consistent with the supports";
    case Failure::Kind::mass_matrix:
      return "the mass matrix is singular at t = " + time;
    case Failure::Kind::step:
      return "the step from t = " + time + " failed, and shorter ones too: " + reason_of(failure.step) +
             places + shorter_step(failure, step_hint(failure.step));
    case Failure::Kind::endless_events:
      return "at t = " + time + " \"" + model.body_of(model.riders[failure.rider]).name +
             "\" hits stops, or sticks and slides, again and again at one moment" + places +
             "; another \"restitution\" or friction \"coefficient\", or a shorter \"step\", may help";
    case Failure::Kind::wrap:
      return "at t = " + time + " the beam turns by " + text_of(failure.wrap * 180 / std::numbers::pi, 4) +
             " degrees at \"" + model.body_of(model.riders[failure.rider]).name +
             "\", and the bound of Coulomb's law grows without limit towards 180; above 120 degrees give the "
             "friction \"law\": \"capstan\", or \"bearing\" for a pulley that turns";
    case Failure::Kind::impact:
      return "the impact of \"" + model.body_of(model.riders[failure.rider]).name +
             "\" at the end is singular";
    case Failure::Kind::projection:
      return "the motion cannot be carried over to another mesh at t = " + time + places +
             "; take more elements";
    case Failure::Kind::mesh:
      return "length control finds no mesh at t = " + time + places;
    case Failure::Kind::mesh_energy:
      return "at t = " + time + " the mesh would have to change beside \"" +
             model.body_of(model.riders[failure.rider]).name + "\", and its energy by " +
             text_of(failure.energy, 3) + " J, more than a thousandth of what moves" + places +
             (model.riders[failure.rider].continuous_slope
                  ? "; take more elements, or for a cable that hardly resists bending \"slope\": \"discontinuous\""
                  : "; take more elements, or \"slope\": \"continuous\": a beam that resists bending cannot give up a kink");
    case Failure::Kind::energy:
      return "by t = " + time + " an energy of " + text_of(failure.energy, 3) +
             " J has come from nowhere, more than all that moves" + places +
             shorter_step(failure, "; take a shorter \"step\" or a \"tolerance\"");
    case Failure::Kind::bodies_meet:
      return meeting_text(failure, model) + places;
    case Failure::Kind::equilibrium:
      return "no static equilibrium was found: " +
             (failure.loose ? free_part_text(failure, model) : reason_of(failure.equilibrium.status)) +
             "; load factor reached " + text_of(failure.equilibrium.load_factor, 8) +
             (failure.equilibrium.status == StaticStatus::singular_matrix ? "" : slope_hint(model));
    case Failure::Kind::unstable_state:
      return "the state is unstable: an eigenvalue is negative, and a small disturbance grows like exp(" +
             text_of(failure.growth, 6) + " t); there are no natural frequencies";
    case Failure::Kind::no_energy:
      return "the tangent is not symmetric: loads that follow the section and moments in space have no energy, "
             "and without one there are neither natural frequencies nor buckling factors";
    case Failure::Kind::not_held:
      return free_part_text(failure, model);
    case Failure::Kind::nothing_buckles:
      return "nothing buckles under the loads: not before they bend the model by its own size";
    case Failure::Kind::eigenvalues:
      return "the eigenvalues are not found; a smaller \"count\" may help";
    case Failure::Kind::leaves_beam: {
      const Rider& joint = model.riders[failure.rider];
      return "there is no equilibrium with \"" + model.body_of(joint).name + "\" on beam \"" +
             model.beam_of(joint).name + "\": it slides off its free end" + places +
             "; give a stop there (\"stops\", or \"at_beam_end\": \"stop\" of its sliding joint), or hold it at its "
             "place (\"equilibrium\": \"held\")";
    }
    case Failure::Kind::free_lengths:
      return "no lengths of the connectors were found with which they do in equilibrium what \"as-drawn\" or "
             "\"force\" says: one of them does not move its end, another one holds it, or with these forces the model "
             "is not stable";
    case Failure::Kind::wrong_sign: {
      const Connector& connector = model.connectors[failure.connector];
      const bool pulls = connector.type == ConnectorType::tension_only;
      return "connector \"" + connector.name + "\" would have to " + (pulls ? "push " : "pull ") +
             text_of(failure.force, 6) + " N for what its length says, but it is " +
             (pulls ? "tension-only" : "compression-only") + "; let its end stand lower, or leave it out";
    }
    case Failure::Kind::resting_place:
      break;
  }
  return "a sliding body finds no resting place" + slope_hint(model);
}

}  // namespace

std::string turns_about_text(const BeamModel& model, const LoosePart& loose) {
  const Support* only = nullptr;
  for (const Constraint& constraint : model.constraints) {
    const auto* support = std::get_if<Support>(&constraint);
    if (!support || only) return "";
    only = support;
  }
  if (!only)
    return model.constraints.empty() && model.connectors.empty() ? ", as the model has no support" : "";
  if (loose.is_body || model.beams[only->beam].name != loose.name) return "";
  return ", turning about its only support, at s = " + text_of(only->s, 6) + " m of beam \"" +
         model.beams[only->beam].name + "\"";
}

std::string name_of(EventKind kind) {
  switch (kind) {
    case EventKind::split:
      return "split";
    case EventKind::merge:
      return "merge";
    case EventKind::becomes_point:
      return "carried as a point";
    case EventKind::becomes_node:
      return "carried as a node";
    case EventKind::left_beam:
      return "left the beam";
    case EventKind::released:
      return "released";
    case EventKind::sticks:
      return "sticks";
    case EventKind::slides:
      return "slides";
    case EventKind::hits_stop:
      return "hits a stop";
    case EventKind::rests_at_stop:
      return "rests at a stop";
    case EventKind::leaves_stop:
      return "leaves a stop";
    case EventKind::stopped_at_end:
      break;
  }
  return "stopped at the end";
}

std::string outcome_text(const SimulationReport& report, const BeamModel& model) {
  if (report.status == SimulationStatus::interrupted)
    return report.steps > 0 || report.time > 0 ? "interrupted at t = " + text_of(report.time, 8) + " s"
                                               : "interrupted";
  return report.failure ? failure_text(*report.failure, model) : "done";
}

}  // namespace nurbeam
