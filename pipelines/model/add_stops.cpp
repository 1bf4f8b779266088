#include "pipelines/model/add_stops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "fem/mesh/mesh_plan.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

class Stops {
 public:
  Stops(const CaseStop& from, int beam, BeamModel& model, Findings& findings)
      : from_(from), beam_(model.beams[beam]), curve_(beam_.curve), model_(model), findings_(findings) {}

  // One that stands at s, for each body that comes to it.
  void stand_at(double s, const std::vector<int>& joints) {
    for (const int j : joints) {
      const double start = model_.riders[j].s, same = same_place * curve_.length();
      const bool below = start <= s;
      if (!curve_.closed()) check_side(j, start, s, same);
      if (at_end(j, s))
        refuse("stands at the end of beam " + in_quotes(from_.beam) +
               ", where \"at_beam_end\": \"stop\" stops body " + in_quotes(name(j)) +
               " already; keep one of them");
      if (from_.buffer && !curve_.closed() && (s == curve_.start() || s == curve_.end()))
        refuse("is an end of beam " + in_quotes(from_.beam) +
               ", where a buffer has no way to be pressed in; put it as far before the end as it may be, or "
               "leave \"stiffness\" out for a hard stop");
      // On a ring it is met from both ways, before and behind the body.
      if (curve_.closed()) {
        if (from_.side != CaseStop::Side::after) add(j, below ? s : s + curve_.length(), true);
        if (from_.side != CaseStop::Side::before) add(j, below ? s - curve_.length() : s, false);
      } else if (from_.side == CaseStop::Side::before || (from_.side == CaseStop::Side::both && below)) {
        add(j, s, true);
      } else {
        add(j, s, false);
      }
    }
  }

  void between(int a, int b) {
    const double distance = model_.riders[b].s - model_.riders[a].s, L = curve_.length();
    const double apart = std::abs(curve_.unrolled(distance, 0));
    const double least = least_gap();
    if (from_.gap < least)
      findings_.error(from_.path + ".gap", "is " + text_of(from_.gap) + " m, but elements of beam " +
                                               in_quotes(from_.beam) +
                                               " are between the bodies, which cannot come nearer than " +
                                               text_of(least) + " m: give at least that, or more elements");
    if (apart < from_.gap - same_place * L)
      findings_.error(from_.path + ".gap", "is " + text_of(from_.gap) + " m, but bodies " +
                                               in_quotes(name(a)) + " and " + in_quotes(name(b)) + " start " +
                                               text_of(apart) + " m apart; must be at most that");
    if (distance < 0) std::swap(a, b);
    pair(a, b, from_.gap);
    // The other way round, the first is ahead of the second by a turn.
    if (curve_.closed()) pair(b, a, from_.gap - L);
  }

 private:
  void refuse(const std::string& message) { findings_.error(from_.path + ".at", message); }
  const std::string& name(int joint) const { return model_.body_of(model_.riders[joint]).name; }

  // Bodies on a beam that deforms keep this far apart, and some more [m].
  double least_gap() const {
    return beam_.rigid ? 0 : 2 * meeting_distance * curve_.length() / beam_.home_intervals();
  }

  bool at_end(int joint, double s) const {
    return !curve_.closed() && !model_.riders[joint].leave_at_end &&
           (s == curve_.start() || s == curve_.end());
  }

  void check_side(int joint, double start, double s, double same) {
    const bool beyond = (from_.side == CaseStop::Side::before && start > s + same) ||
                        (from_.side == CaseStop::Side::after && start < s - same);
    if (beyond)
      refuse("is s = " + text_of(s) + " m, but body " + in_quotes(name(joint)) +
             " starts beyond, at s = " + text_of(start) + " m, and \"side\" stops bodies that come from " +
             (from_.side == CaseStop::Side::before ? "before" : "after"));
  }

  void check_drive(int joint) {
    if (model_.riders[joint].motion && !from_.buffer)
      findings_.error(from_.path,
                      "is hard, but the place of body " + in_quotes(name(joint)) +
                          " is prescribed by its \"motion\"; give a \"stiffness\", or leave it out "
                          "of \"bodies\"");
  }

  void add(int joint, double place, bool from_below) {
    check_drive(joint);
    model_.stops.push_back({.rider = joint,
                            .place = place,
                            .from_below = from_below,
                            .restitution = from_.restitution,
                            .buffer = from_.buffer});
  }
  void pair(int a, int b, double gap) {
    for (const int joint : {a, b}) check_drive(joint);
    model_.stops.push_back(
        {.rider = a, .other = b, .place = gap, .restitution = from_.restitution, .buffer = from_.buffer});
  }

  const CaseStop& from_;
  const Beam& beam_;
  const ReferenceCurve& curve_;
  BeamModel& model_;
  Findings& findings_;
};

// Between hard stops on both sides a body has some room.
void check_room(const BeamModel& model, Findings& findings) {
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    for (const Stop& stop : model.stops) {
      if (stop.rider != j || stop.other >= 0 || stop.buffer) continue;
      (stop.from_below ? most : least) =
          stop.from_below ? std::min(most, stop.place) : std::max(least, stop.place);
    }
    const ReferenceCurve& curve = model.beam_of(model.riders[j]).curve;
    if (most - least <= same_place * curve.length())
      findings.error("stops", "hard stops at s = " + text_of(least) + " m and " + text_of(most) +
                                  " m leave body " + in_quotes(model.body_of(model.riders[j]).name) +
                                  " no room; move one of them, leave it out, or give the body's joint a "
                                  "\"motion\" of speed 0");
  }
}

// The joints on the beam of the bodies that the stop names, or of all.
std::vector<int> stopped_joints(const CaseStop& stop, int beam, const BeamModel& model, Findings& findings) {
  std::vector<int> joints;
  const auto find = [&](const std::string& body) {
    const auto found = std::find_if(model.riders.begin(), model.riders.end(), [&](const Rider& joint) {
      return joint.beam == beam && model.body_of(joint).name == body;
    });
    if (found != model.riders.end())
      joints.push_back(static_cast<int>(found - model.riders.begin()));
    else
      findings.error(stop.path + ".bodies",
                     "names " + in_quotes(body) + ", which does not slide on beam " + in_quotes(stop.beam));
  };
  for (const std::string& body : stop.bodies) find(body);
  for (int j = 0; stop.bodies.empty() && j < static_cast<int>(model.riders.size()); ++j)
    if (model.riders[j].beam == beam) joints.push_back(j);
  return joints;
}

// Of modes and buckling, where bodies rest or are held.
void check_modes(const CaseStop& stop, const CaseAnalysis& analysis, Findings& findings) {
  if (!analysis.has_modes()) return;
  const bool meets_bodies = analysis.modes.about_equilibrium && !analysis.modes.bodies_held;
  if (!meets_bodies)
    findings.warn(stop.path, "has no effect on modes and buckling about where bodies are held or drawn");
  else if (!stop.buffer)
    findings.add(Severity::note, stop.path,
                 "holds what rests against it: in modes and buckling such a body does not leave it");
}

}  // namespace

void add_stops(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, BeamModel& model,
               Findings& findings) {
  for (const CaseStop& stop : resolved.stops) {
    const int b = resolved.beam_index(stop.beam);
    const std::vector<int> joints = stopped_joints(stop, b, model, findings);
    if (stop.bodies.empty() && joints.empty())
      findings.error(stop.path + ".beam",
                     "names " + in_quotes(stop.beam) +
                         ", on which no body slides; name the beam of the bodies that it "
                         "is to stop, or leave the stop out");
    Stops stops(stop, b, model, findings);
    if (stop.at) {
      stops.stand_at(place_on(beams[b], *stop.at, stop.path, findings), joints);
    } else if (joints.size() == 2) {
      if (joints[0] == joints[1])
        findings.error(stop.path + ".bodies", "names one body twice; give two");
      else
        stops.between(joints[0], joints[1]);
    }
    const CaseAnalysis& analysis = resolved.analysis;
    check_modes(stop, analysis, findings);
  }
  check_room(model, findings);
}

}  // namespace nurbeam
