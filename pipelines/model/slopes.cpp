// Long because it is one decision: its candidates, what speaks against them, their tensions, and the marks.
#include "pipelines/model/slopes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "fem/material/bending_layer.h"
#include "fem/mesh/mesh_plan.h"
#include "fem/model/build.h"
#include "fem/motion/rest/resting_place.h"
#include "fem/system/material_points.h"
#include "nurbs/number_text.h"
#include "pipelines/model/largest_tension.h"

namespace nurbeam {

namespace {

constexpr int digits = 3;

// Why a slope stays continuous at a place, whatever the tension.
struct Obstacle {
  int beam;
  double s;
  std::string why;
};

bool is_at_end(const BeamModel& model, int b, double s) {
  const ReferenceCurve& curve = model.beams[b].curve;
  return !curve.closed() && (s == curve.start() || s == curve.end());
}

bool is_same(const BeamModel& model, int b, double s, double t) {
  return std::abs(s - t) <= same_place * model.beams[b].curve.length();
}

// What may have a kink, and what must not.
class Candidates {
 public:
  Candidates(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const BeamModel& model,
             Findings& findings)
      : resolved_(resolved), beams_(beams), model_(model), findings_(findings) {}

  void look_at_loads() {
    for (const CaseLoad& load : resolved_.loads) {
      if (load.kind != CaseLoad::Kind::force && load.kind != CaseLoad::Kind::moment) continue;
      const int b = resolved_.beam_index(load.beam);
      const double s = place(b, load.at, load.path);
      if (load.kind == CaseLoad::Kind::moment) {
        obstacles.push_back({b, s, "a moment bends the beam there"});
      } else if (load.moving_speed || load.offset) {
        if (load.slope == SlopeRule::discontinuous)
          findings_.error(load.path + ".slope",
                          std::string("is \"discontinuous\", but the force ") +
                              (load.moving_speed ? "moves along the beam, and a node with a kink stays"
                                                 : "acts beside the axis, and bends the beam") +
                              "; use \"continuous\", or leave it out");
        if (load.offset) obstacles.push_back({b, s, "a force beside the axis bends the beam there"});
      } else {
        add({.path = load.path, .beam = b, .s = s, .asked = load.slope, .is_load = true});
      }
    }
  }

  void look_at_supports() {
    for (const CaseSupport& support : resolved_.supports) {
      const int b = resolved_.beam_index(support.beam);
      const double s = place(b, support.at, support.path);
      const bool is_clamp = support.type == CaseSupport::Type::clamped;
      if (support.axis) obstacles.push_back({b, s, "the support's axis turns the section there"});
      if (support.rotation || (is_clamp && support.direction)) {
        obstacles.push_back({b, s, support.rotation ? "the support turns there" : "the clamp slides there"});
        if (support.slope == SlopeRule::discontinuous)
          findings_.error(support.path + ".slope", std::string("is \"discontinuous\", but the support ") +
                                                       (support.rotation ? "turns" : "slides") +
                                                       "; use \"continuous\", or leave it out");
        continue;
      }
      if (is_clamp || !is_at_end(model_, b, s))
        add({.path = support.path, .beam = b, .s = s, .asked = support.slope, .is_clamp = is_clamp});
    }
  }

  void look_at_connectors() {
    for (const CaseConnector& connector : resolved_.connectors)
      for (const CaseConnectorEnd& end : connector.ends)
        if (!end.beam.empty()) {
          const int b = resolved_.beam_index(end.beam);
          add({.path = end.path, .beam = b, .s = place(b, end.at, end.path), .asked = end.slope});
        }
    for (const CaseConnector& connector : resolved_.rotational_connectors)
      for (const CaseConnectorEnd& end : connector.ends)
        if (!end.beam.empty()) {
          const int b = resolved_.beam_index(end.beam);
          const double s = place(b, end.at, end.path);
          obstacles.push_back({b, s, "a rotational connector turns the section there"});
          if (end.slope == SlopeRule::discontinuous)
            findings_.error(end.path + ".slope",
                            "is \"discontinuous\", but a rotational connector takes hold of one slope; use "
                            "\"continuous\", or leave it out");
        }
  }

  void look_at_joints(const JoinedBeams& joined) {
    for (std::size_t i = 0; i < joined.joints.size(); ++i) {
      const BeamJoint& joint = joined.joints[i];
      const CaseBeamJoint& from = resolved_.joints[joined.sources[i]];
      for (const auto& [b, s] : {std::pair(joint.beam_a, joint.s_a), std::pair(joint.beam_b, joint.s_b)})
        if (joint.rigid || joint.axis)
          obstacles.push_back({b, s, "a joint holds the direction of the beam there"});
        else
          add({.path = from.path, .beam = b, .s = s, .asked = from.slope});
      if (joint.rigid && from.slope == SlopeRule::discontinuous)
        findings_.error(from.path + ".slope",
                        "is \"discontinuous\", but the joint is \"rigid\" and holds the beams' angle; use "
                        "\"hinged\", or leave it out");
    }
  }

  void look_at_sliding_joints() {
    for (std::size_t j = 0; j < resolved_.sliding_joints.size(); ++j) {
      const CaseSlidingJoint& joint = resolved_.sliding_joints[j];
      const Rider& rider = model_.riders[j];
      add({.path = joint.path,
           .beam = rider.beam,
           .s = rider.s,
           .asked = joint.slope,
           .rider = static_cast<int>(j),
           .runs = resolved_.analysis.type == CaseAnalysis::Type::dynamic});
    }
  }

  std::vector<SlopeDecision> places;
  std::vector<Obstacle> obstacles;

 private:
  double place(int b, const Place& at, const std::string& path) {
    return beams_[b].material_coordinate(place_on(beams_[b], at, path, findings_));
  }
  void add(SlopeDecision candidate) {
    const bool inside = !is_at_end(model_, candidate.beam, candidate.s);
    if (model_.beams[candidate.beam].rigid || !(inside || candidate.is_clamp || candidate.rider)) return;
    places.push_back(std::move(candidate));
  }

  const ResolvedCase& resolved_;
  const std::vector<DrawnBeam>& beams_;
  const BeamModel& model_;
  Findings& findings_;
};

// The tension of the beams on both sides of a place, the less of both: of the middle of their elements.
double tension_at(const BeamSystem& system, const State& state, const CarriedBySpans& carried, int b,
                  double s) {
  const ReferenceCurve& curve = system.model().beams[b].curve;
  double least = std::numeric_limits<double>::infinity();
  for (const double away : {-1e-7, 1e-7}) {
    const double beside = curve.wrapped(s + away * curve.length());
    if (!curve.closed() && (beside < curve.start() || beside > curve.end())) continue;
    const int span = find_span(system.model(), system.mesh(), state.q, b, beside);
    const MeshSpan& of = system.mesh().spans[span];
    const double middle = (of.start(state.q) + of.end(state.q)) / 2;
    least = std::min(least, section_at(system, state, span, carried[span], middle).axial_force);
  }
  return least;
}

constexpr const char *carried_as_point = "the body is carried as a point",
                     *too_few_elements = "the beam has too few elements for a node there";

double shorter_element(const BeamModel& model, const SlopeDecision& place) {
  const Beam& beam = model.beams[place.beam];
  const int h = place.rider ? -1 : beam.home_at(place.s);
  if (h < 0) return beam.home_spacing(place.s);
  const bool has_before = beam.is_ring() || h > 0, has_behind = beam.is_ring() || h < beam.home_intervals();
  const double before = has_before ? beam.home_place(h) - beam.home_place(h - 1) : INFINITY,
               behind = has_behind ? beam.home_place(h + 1) - beam.home_place(h) : INFINITY;
  return std::min(before, behind);
}

// Whether a kink is the better model of a place under a tension.
bool makes_kink(const BeamModel& model, const SlopeDecision& place, double tension) {
  constexpr double part_of_run = 0.5;
  const BeamProperties& beam = model.beams[place.beam].properties;
  if (!place.runs) return is_string(beam, *place.element, tension);
  return tension > 0 && bending_reach(beam, tension) < part_of_run * *place.element;
}

std::string by_reach(const SlopeDecision& place) {
  return "bending reaches " + text_of(*place.reach, digits) + " m under " + text_of(*place.tension, digits) +
         " N, and the shorter element beside it is " + text_of(*place.element, digits) + " m long";
}

class Decision {
 public:
  Decision(const ResolvedCase& resolved, const std::function<bool()>& interrupted, BeamModel& model,
           Candidates& candidates)
      : resolved_(resolved),
        interrupted_(interrupted),
        model_(model),
        places_(candidates.places),
        obstacles_(candidates.obstacles) {}

  void decide() {
    for (SlopeDecision& place : places_) {
      place.element = shorter_element(model_, place);
      obstruct(place);
    }
    find_tensions();
    for (SlopeDecision& place : places_) decide(place);
  }

 private:
  // Keeps a slope continuous that cannot jump.
  void obstruct(SlopeDecision& place) const {
    for (const Obstacle& obstacle : obstacles_)
      if (obstacle.beam == place.beam && !place.rider && is_same(model_, place.beam, obstacle.s, place.s))
        place.why = obstacle.why;
    for (const SlopeDecision& other : places_)
      if (&other != &place && !other.rider && !place.rider && other.beam == place.beam &&
          is_same(model_, place.beam, other.s, place.s) && place.asked == SlopeRule::automatic &&
          other.asked != SlopeRule::automatic)
        place.asked = other.asked;
    if (place.rider) obstruct_body(place);
    if (place.asked == SlopeRule::continuous) place.why = "as the case says";
    if (place.is_load && place.why.empty()) place.why = load_beside_node(place);
  }

  void obstruct_body(SlopeDecision& place) const {
    const Rider& rider = model_.riders[*place.rider];
    if (rider.as_point) place.why = carried_as_point;
    if (rider.follows_section) place.why = "the body follows the section";
    if (is_at_end(model_, place.beam, place.s)) place.why = "the body is at the beam's end";
    if (place.why.empty() && too_light_for_node(model_, rider))
      place.why = "the body is light beside its element";
  }

  // A load just beside a node would make an element that is short for nothing.
  std::string load_beside_node(const SlopeDecision& place) const {
    constexpr double near = 1e-4;
    const Beam& beam = model_.beams[place.beam];
    if (beam.home_at(place.s) >= 0) return {};
    const int h = beam.home_interval(place.s);
    for (const int node : {h, h + 1})
      if (const HomeNode& home = beam.home_node(node);
          std::abs(beam.home_place(node) - place.s) < near * *place.element &&
          (home.permanent || home.joined || home.hold != Hold::nothing || home.kept))
        return "a node that stays is too near";
    return {};
  }

  bool is_open(const SlopeDecision& place) const { return place.asked != SlopeRule::discontinuous; }

  // Tensions that are given suffice where they make a string; else the equilibrium gives them, or the drawing
  // where a motion starts from it.
  void find_tensions() {
    bool is_searched = false;
    for (SlopeDecision& place : places_) {
      if (!is_open(place)) continue;
      const double given = model_.beams[place.beam].properties.drawn_tension();
      if (given != 0) place.tension = given;
      is_searched = is_searched || (!makes_kink(model_, place, given) &&
                                    makes_kink(model_, place, largest_tension(model_, place.beam)));
    }
    if (!is_searched) return;
    const auto model = std::make_shared<const BeamModel>(model_);
    MeshedState at = MeshedState::drawn(model);
    at.state.t = time();
    const bool as_drawn = starts_as_drawn();
    if (!as_drawn && find_held_equilibrium(at, interrupted_).failure) {
      has_equilibrium_ = false;
      return;
    }
    const CarriedBySpans carried(*at.system, at.state);
    for (SlopeDecision& place : places_) {
      if (!is_open(place)) continue;
      const double tension = tension_at(*at.system, at.state, carried, place.beam, place.s);
      if (!as_drawn || makes_kink(model_, place, tension)) place.tension = tension;
    }
  }

  // Where no equilibrium belongs to the analysis.
  bool starts_as_drawn() const {
    const CaseAnalysis& analysis = resolved_.analysis;
    if (analysis.has_modes()) return !analysis.modes.about_equilibrium;
    return analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium;
  }
  double time() const {
    const std::vector<double> factors = resolved_.analysis.factors();
    return factors.empty() ? 0 : factors.back();
  }

  void decide(SlopeDecision& place) const {
    const BeamProperties& beam = model_.beams[place.beam].properties;
    if (place.tension && *place.tension > 0) place.reach = bending_reach(beam, *place.tension);
    place.discontinuous = place.asked == SlopeRule::discontinuous ||
                          (place.why.empty() && place.reach && makes_kink(model_, place, *place.tension));
    place.sharp = place.reach && !place.discontinuous && is_string(beam, *place.element, *place.tension);
    if (!place.why.empty()) return;
    if (place.asked == SlopeRule::discontinuous)
      place.why = "as the case says";
    else if (!place.tension)
      place.why = !has_equilibrium_   ? "no equilibrium was found, whose tension would make it a kink"
                  : starts_as_drawn() ? "the analysis starts as drawn, and is not taut enough there"
                                      : "no load makes the beam taut enough for a kink";
    else if (!place.reach)
      place.why = "the beam is not under tension";
    else
      place.why = by_reach(place) + (place.discontinuous && !is_string(beam, *place.element, *place.tension)
                                         ? ": a kink sinks too far there by half its angle times this reach"
                                         : "");
  }

  const ResolvedCase& resolved_;
  const std::function<bool()>& interrupted_;
  BeamModel& model_;
  std::vector<SlopeDecision>& places_;
  const std::vector<Obstacle>& obstacles_;
  bool has_equilibrium_ = true;  // as far as it was looked for
};

// Puts a node where a load makes a kink. A beam that has not enough elements for that keeps its own.
void divide_at_loads(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                     const std::vector<std::vector<double>>& held, const ModelFrame& frame, BeamModel& model,
                     std::vector<SlopeDecision>& places, Findings& findings) {
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) {
    std::vector<double> all = held[b];
    const auto is_new = [&](const SlopeDecision& place) {
      return place.beam == b && place.discontinuous && place.is_load && model.beams[b].home_at(place.s) < 0;
    };
    for (const SlopeDecision& place : places)
      if (is_new(place) &&
          std::none_of(all.begin(), all.end(), [&](double s) { return is_same(model, b, s, place.s); }))
        all.push_back(place.s);
    if (all.size() == held[b].size()) continue;
    const CaseBeam& from = resolved.beams[b];
    const std::size_t intervals = fixed_places(beams[b].measured, all).size() - 1;
    if (from.elements.count && static_cast<std::size_t>(*from.elements.count) < intervals) {
      for (SlopeDecision& place : places)
        if (is_new(place)) {
          place.discontinuous = false;
          place.sharp = true;
          place.why = too_few_elements;
        }
      continue;
    }
    model.beams[b].home =
        divide_beam(from, beams[b], all, resolved.sliding_bodies(from.name), frame, findings);
  }
}

// The home nodes of a beam at a place: none, one, or both at the seam of a ring.
std::vector<HomeNode*> nodes_at(Beam& beam, double s) {
  const int h = beam.home_at(s);
  if (h < 0) return {};
  if (beam.is_ring() && h == 0) return {&beam.home.front(), &beam.home.back()};
  return {&beam.home[h]};
}

void smooth_clamp(const SlopeDecision& place, BeamModel& model) {
  for (HomeNode* node : nodes_at(model.beams[place.beam], place.s)) {
    if (node->sharp_clamp) node->hold = Hold::clamp;
    node->sharp_clamp = false;
  }
  for (Constraint& constraint : model.constraints)
    if (auto* support = std::get_if<Support>(&constraint);
        support && support->beam == place.beam && is_same(model, place.beam, support->s, place.s))
      support->sharp = false;
}

void smooth(const SlopeDecision& place, BeamModel& model) {
  if (place.rider) model.riders[*place.rider].continuous_slope = true;
  if (place.rider) return;
  if (place.is_clamp) return smooth_clamp(place, model);
  for (HomeNode* node : nodes_at(model.beams[place.beam], place.s))
    if (node->kind == NodeKind::kink) node->kind = NodeKind::smooth;
}

void mark(const SlopeDecision& place, BeamModel& model) {
  if (place.rider) {
    model.riders[*place.rider].continuous_slope = !place.discontinuous;
    model.riders[*place.rider].sharp = place.sharp;
    return;
  }
  const bool at_end = is_at_end(model, place.beam, place.s);
  for (HomeNode* node : nodes_at(model.beams[place.beam], place.s)) {
    if (node->kind == NodeKind::hinge || node->kind == NodeKind::rigid) return;  // a corner of the drawing
    node->sharp = place.sharp && !at_end;
    if (place.discontinuous && place.is_clamp) {
      node->hold = Hold::position;
      node->sharp_clamp = true;
    }
    if (!place.discontinuous || at_end) continue;
    node->kind = NodeKind::kink;
    node->permanent = true;
  }
  if (!place.is_clamp) return;
  for (Constraint& constraint : model.constraints)
    if (auto* support = std::get_if<Support>(&constraint);
        support && support->beam == place.beam && is_same(model, place.beam, support->s, place.s))
      support->sharp = place.discontinuous;
}

// One node has one answer.
void check_agreement(const BeamModel& model, const std::vector<SlopeDecision>& places, Findings& findings) {
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SlopeDecision &a = places[j], &b = places[i];
      if (a.rider || b.rider || a.beam != b.beam || !is_same(model, a.beam, a.s, b.s)) continue;
      if (a.asked == b.asked || a.asked == SlopeRule::automatic || b.asked == SlopeRule::automatic) continue;
      findings.error(b.path + ".slope",
                     "differs from that of " + a.path + ", which is at the same place of beam \"" +
                         model.beams[a.beam].name + "\"; give both one value, or leave one out");
    }
}

// Whether a beam is a rope: something gives it kinks, or its tension makes strings of its elements.
bool is_rope(const Beam& beam, int b, const std::vector<SlopeDecision>& places) {
  if (beam.rigid) return false;
  const double l = beam.curve.length() / beam.home_intervals();
  return is_string(beam.properties, l, beam.properties.drawn_tension()) ||
         std::any_of(places.begin(), places.end(), [b](const SlopeDecision& place) {
           return place.beam == b && (place.discontinuous || place.sharp);
         });
}

void warn_of_smooth_strings(const BeamModel& model, const std::vector<SlopeDecision>& places,
                            Findings& findings) {
  for (const SlopeDecision& place : places) {
    const bool asked_smooth = place.asked == SlopeRule::continuous;
    const bool rings = asked_smooth && place.runs && place.reach && makes_kink(model, place, *place.tension);
    if (!place.sharp && !rings) continue;
    const std::string facts =
        "under " + text_of(*place.tension, digits) + " N bending reaches " + text_of(*place.reach, digits) +
        " m, and the shorter element beside it is " + text_of(*place.element, digits) + " m long: " +
        (place.sharp ? "the beam sags too little there, and its moments are those of a layer in closed form; "
                     : "forces ring as the body runs from element to element; ");
    if (asked_smooth)
      findings.warn(place.path + ".slope", "is \"continuous\", but " + facts +
                                               "use \"automatic\", or elements shorter than bending reaches");
    else if (place.why == too_few_elements)
      findings.warn(place.path, "makes no kink, as the beam has too few elements for a node there, but " +
                                    facts + "give it more elements");
    else if (place.why == carried_as_point)
      findings.warn(place.path, "makes no kink, as the body is carried as a point, but " + facts +
                                    "leave \"carried_as\" out, or use elements shorter than bending reaches");
  }
}

}  // namespace

std::vector<SlopeDecision> decide_slopes(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                                         const std::vector<std::vector<double>>& held,
                                         const JoinedBeams& joined, const ModelFrame& frame,
                                         const std::function<bool()>& interrupted,
                                         const std::vector<SlopeDecision>* like, BeamModel& model,
                                         Findings& findings) {
  Candidates candidates(resolved, beams, model, findings);
  candidates.look_at_loads();
  candidates.look_at_supports();
  candidates.look_at_connectors();
  candidates.look_at_joints(joined);
  candidates.look_at_sliding_joints();
  std::vector<SlopeDecision>& places = candidates.places;
  check_agreement(model, places, findings);
  if (findings.has_errors()) return places;
  if (like && like->size() == places.size()) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      SlopeDecision decided = (*like)[i];
      decided.s = places[i].s;
      places[i] = decided;
    }
  } else {
    Decision(resolved, interrupted, model, candidates).decide();
  }
  divide_at_loads(resolved, beams, held, frame, model, places, findings);
  if (findings.has_errors()) return places;
  mark_held_nodes(model);
  for (const SlopeDecision& place : places) mark(place, model);
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    model.beams[b].rope = is_rope(model.beams[b], static_cast<int>(b), places);
  warn_of_smooth_strings(model, places, findings);
  return places;
}

bool smooth_fine_kinks(BeamModel& model, std::vector<SlopeDecision>& slopes) {
  bool any = false;
  for (SlopeDecision& place : slopes) {
    const bool is_open = place.discontinuous && place.asked != SlopeRule::discontinuous && place.reach;
    if (!is_open) continue;
    place.element = shorter_element(model, place);
    if (makes_kink(model, place, *place.tension)) continue;
    place.discontinuous = false;
    place.why = by_reach(place);
    any = true;
    smooth(place, model);
  }
  return any;
}

}  // namespace nurbeam
