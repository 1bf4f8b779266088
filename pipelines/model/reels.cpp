#include "pipelines/model/reels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/divide_beam.h"
#include "pipelines/model/place_motions.h"
#include "pipelines/model/rings.h"

namespace nurbeam {

namespace {

// Part of the greatest speed of a motion by which its speed may jump at the start without a word.
constexpr double unnoticed_jump = 0.01;

std::string end_name(const CaseReel& reel) { return reel.at_start ? "start" : "end"; }

// What a beam that is wound up must be.
void check_beam(const CaseReel& reel, const CaseBeam& from, const Beam& beam, Findings& findings) {
  const auto refuse = [&](const std::string& reason) {
    findings.error(reel.path + ".beam", "is " + in_quotes(reel.beam) + ", " + reason);
  };
  if (beam.is_ring()) return refuse("a ring, which has no end; name an open beam");
  if (beam.has_torsion())
    refuse("a beam with torsion, whose sections a reel would hold; give the beam \"torsion\": false");
  if (beam.curve.metric() == Metric::label || beam.form == Form::virtual_work ||
      beam.weights == WeightRule::constant)
    refuse("of a kind of element for comparisons alone; leave \"metric\", \"form\" and \"weights\" out");
  if (!beam.bends.empty()) refuse("a pipe whose bends give way; leave \"bends\" out");
  if (from.tension != 0 || from.unstressed_length)
    refuse(
        "given a \"tension\" or an \"unstressed_length\", which the rope on the reel does not have; let the "
        "reel's \"force\" pull, or draw the beam as long as it is unstressed");
}

// The mouth takes the place of the beam's end: nothing else may hold that.
void check_end(const CaseReel& reel, double s, const std::vector<double>& held, const BeamModel& model,
               int beam, Findings& findings) {
  const double same = same_place * model.beams[beam].curve.length();
  if (std::ranges::any_of(held, [&](double place) { return std::abs(place - s) <= same; }))
    findings.error(reel.path + ".end",
                   "is the " + end_name(reel) + " of beam " + in_quotes(reel.beam) +
                       ", where a support, a joint, a connector or a mass is already; the "
                       "reel holds that end: remove what else does");
  for (const Rider& other : model.riders)
    if (other.beam == beam && std::abs(other.s - s) <= meeting_distance * model.beams[beam].home_spacing(s))
      findings.error(reel.path + ".end", "is where " + in_quotes(model.body_of(other).name) +
                                             " stands on beam " + in_quotes(reel.beam) +
                                             "; put that an element's length away");
}

// A load along the whole beam would be on what is stored too.
void check_loads(const CaseReel& reel, const ResolvedCase& resolved, Findings& findings) {
  for (const CaseLoad& load : resolved.loads)
    if (load.beam == reel.beam && load.kind != CaseLoad::Kind::force && load.kind != CaseLoad::Kind::moment)
      findings.error(load.path, "is along beam " + in_quotes(reel.beam) + ", part of which is on the reel " +
                                    in_quotes(reel.name) + "; give loads at places, or leave it out");
}

// An element stands between the mouth and what it comes to: how far it can take in, as a place of the beam
// [m]. A mouth that starts nearer takes in no more than what it pays out.
double farthest(const Rider& mouth, const std::vector<double>& held, const BeamModel& model) {
  const Beam& beam = model.beam_of(mouth);
  const double way = mouth.reel->sense(), other_end = way > 0 ? beam.curve.end() : beam.curve.start();
  double nearest = other_end;
  const auto look = [&](double place) {
    if (way * (place - mouth.s) > 0 && way * (nearest - place) > 0) nearest = place;
  };
  for (const double place : held) look(place);
  for (const Rider& other : model.riders)
    if (other.beam == mouth.beam && other.motion && other.motion->rows() &&
        other.motion->rows()->steepest() == 0)
      look(other.s);  // a body that is fastened there
  for (const Force& force : model.forces) {
    if (const auto* load = std::get_if<PointLoad>(&force); load && load->beam == mouth.beam) look(load->s);
    if (const auto* moment = std::get_if<Moment>(&force); moment && moment->beam == mouth.beam)
      look(moment->s);
  }
  const double before = nearest - way * beam.home_spacing(nearest);
  return way * (before - mouth.s) > 0 ? before : mouth.s;
}

// Stretch and strain energy per length of rope that was wound under a tension.
void wind(double tension, const BeamProperties& properties, Reel& reel) {
  if (tension == 0) return;
  reel.stretch = 1 + stretch_under(properties.law, properties.axial_stiffness, tension);
  for (int i = 0; i < 50; ++i) {  // the force of a law is that by the stretch, S |r_s|
    const double strain = (reel.stretch * reel.stretch - 1) / 2;
    const AxialPoint<double> point = axial_point(properties.law, properties.axial_stiffness, strain, 0.0);
    const double error = point.force * reel.stretch - tension;
    const double slope = point.stiffness * reel.stretch * reel.stretch + point.force;
    reel.stretch -= error / slope;
    reel.strain_energy = point.energy;
    if (std::abs(error) <= 1e-14 * tension) break;
  }
}

TimeTable times(double factor, TimeTable rows) {
  for (auto& [time, value] : rows) value *= factor;
  return rows;
}

}  // namespace

void lengthen_for_reels(const ResolvedCase& resolved, const CaseBeam& from, Beam& beam, Findings& findings) {
  for (const CaseReel& reel : resolved.reels) {
    if (reel.beam != from.name) continue;
    check_beam(reel, from, beam, findings);
    if (findings.has_errors()) return;
    if (reel.stored > 0) beam.curve = beam.curve.lengthened(reel.stored, reel.at_start);
  }
}

std::vector<HomeNode> with_stored_nodes(std::vector<HomeNode> home, const ReferenceCurve& lengthened) {
  if (home.size() < 2) return home;
  const auto parts = [](double length, double spacing) {
    return static_cast<int>(
        std::min<double>(most_elements, std::max(1.0, std::ceil(length / spacing - 1e-9))));
  };
  if (const double stored = home.front().s - lengthened.start(); stored > 0) {
    const int count = parts(stored, home[1].s - home[0].s);
    std::vector<HomeNode> before;
    for (int i = 0; i < count; ++i) before.push_back({.s = lengthened.start() + stored * i / count});
    home.insert(home.begin(), before.begin(), before.end());
  }
  if (const double drawn = home.back().s, stored = lengthened.end() - drawn; stored > 0) {
    const int count = parts(stored, drawn - home[home.size() - 2].s);
    for (int i = 1; i <= count; ++i)
      home.push_back({.s = i == count ? lengthened.end() : drawn + stored * i / count});
  }
  return home;
}

void add_reels(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
               const std::vector<std::vector<double>>& held, const ModelFrame& frame, BeamModel& model,
               Findings& findings) {
  const CaseAnalysis& analysis = resolved.analysis;
  if (!resolved.reels.empty() && analysis.is_explicit())
    findings.error("analysis.integrator.type",
                   "is \"rk4\", which is not for reels; use \"generalized-alpha\" or \"radau\"");
  Rings rings(resolved, frame, model);
  for (const CaseReel& reel : resolved.reels) {
    const int b = resolved.beam_index(reel.beam);
    Beam& beam = model.beams[b];
    if (beam.rigid) {
      findings.error(reel.path + ".beam", "is " + in_quotes(reel.beam) +
                                              ", a rigid guide, which is not wound up; name an elastic beam");
      continue;
    }
    const double s = reel.at_start ? 0 : beams[b].measured.length();
    check_end(reel, s, held[b], model, b, findings);
    check_loads(reel, resolved, findings);
    const double towards_end = reel.at_start ? 1 : -1;
    Rider mouth{
        .body = static_cast<int>(model.bodies.size()),
        .beam = b,
        .s = s,
        .speed = beam.velocity ? -beam.velocity->along : 0,
        .motion = {},
        .leave_at_end = reel.leave_at_empty,
        .rest = reel.force.empty() ? StaticPlace::held : StaticPlace::free_or_held,
        .friction = ring_friction(reel.friction, analysis, beam),
        .turning_inertia = reel.inertia,
        .drive_force = times(towards_end, reel.force),
        .reel = Reel{.at_start = reel.at_start, .feed = reel.feed, .pickup = reel.pickup.value_or(1)}};
    wind(reel.stored_tension, beam.properties, *mouth.reel);
    const double full = farthest(mouth, held[b], model),
                 empty = reel.at_start ? beam.curve.start() : beam.curve.end();
    mouth.motion = place_motion_of(reel.motion,
                                   {.path = reel.path,
                                    .beam = reel.beam,
                                    .curve = &beam.curve,
                                    .s = s,
                                    .from_start = true,
                                    .sense = -towards_end,
                                    .low = std::min(empty, full),
                                    .high = std::max(empty, full)},
                                   analysis, findings);
    mouth.direction = sleeve_direction(reel.direction, reel.path, beams[b].curve, s, frame, findings);
    const Eigen::Vector3d drawn = beam.curve.position(s);
    rings.add(reel.name, drawn, rings.place_of({reel.on, {}, reel.moves}, drawn));
    model.riders.push_back(mouth);
    if (mouth.motion) continue;
    const int rider = static_cast<int>(model.riders.size()) - 1;
    model.stops.push_back({.rider = rider, .place = full, .from_below = reel.at_start});
    if (!reel.leave_at_empty)
      model.stops.push_back({.rider = rider, .place = empty, .from_below = !reel.at_start});
  }
}

void warn_of_blows(const ResolvedCase& resolved, const BeamModel& model, Findings& findings) {
  if (resolved.analysis.type != CaseAnalysis::Type::dynamic) return;
  const auto look = [&](const std::string& path, const std::string& name) {
    const auto rider =
        std::ranges::find_if(model.riders, [&](const Rider& any) { return model.body_of(any).name == name; });
    if (rider == model.riders.end() || !rider->motion || !rider->motion->rows()) return;
    const Beam& beam = model.beam_of(*rider);
    const double speed = rider->motion->at(0).speed,
                 jump = std::abs(speed - (beam.flow != 0 ? -beam.flow : rider->speed));
    if (jump <= unnoticed_jump * rider->motion->rows()->steepest()) return;
    const BeamProperties& properties = beam.properties;
    const double blow = jump * std::sqrt(properties.axial_stiffness * properties.mass_per_length);
    findings.warn(path + ".motion",
                  "starts at " + text_of(std::abs(speed), 4) + " m/s at once, and beam " +
                      in_quotes(beam.name) + " at " + text_of(std::abs(rider->speed), 4) +
                      " m/s: an impact of " + text_of(blow, 4) +
                      " N, the change of speed times the mass per length and the speed of sound; give it a "
                      "\"ramp\" or rows that begin at rest, or the beam that speed \"along\" in its "
                      "\"initial\" \"velocity\"");
  };
  for (const CaseEyelet& eyelet : resolved.eyelets) look(eyelet.path, eyelet.name);
  for (const CaseReel& reel : resolved.reels) look(reel.path, reel.name);
}

}  // namespace nurbeam
