#include "pipelines/model/ways_to_eyelets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fem/mesh/mesh_plan.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

constexpr const char* cure =
    "; nothing passes an eyelet, and the run would fail there: for a rope on a tower that bodies pass use a "
    "\"pinned\" or \"guided\" support inside the beam, else ";

class WaysToEyelets {
 public:
  WaysToEyelets(const ResolvedCase& resolved, const BeamModel& model, Findings& findings)
      : resolved_(resolved), model_(model), findings_(findings) {}

  void check(std::size_t joint) {
    const Rider& rider = model_.riders[joint];
    if (runs(rider.beam)) return;  // the place of the beam in the eyelet changes
    for (const bool up : {false, true}) {
      const auto next = next_rider(joint, up);
      if (!next || !is_eyelet(*next) || has_stop_between(joint, *next)) continue;
      if (rider.motion)
        refuse_motion(joint, *next, up);
      else
        warn_of_descent(joint, *next);
    }
  }

 private:
  // Sliding joints stand first among the riders, the eyelets behind them.
  bool is_eyelet(std::size_t rider) const {
    const std::size_t first = resolved_.sliding_joints.size();
    return rider >= first && rider < first + resolved_.eyelets.size();
  }
  const std::string& name_of(std::size_t rider) const { return model_.body_of(model_.riders[rider]).name; }

  // Whether something moves the beam along itself.
  bool runs(int beam) const {
    const bool driven = std::ranges::any_of(model_.riders, [&](const Rider& rider) {
      const bool moves_beam = model_.body_of(rider).mass == 0 && (rider.motion || !rider.drive_force.empty());
      return rider.beam == beam && (rider.reel || moves_beam);
    });
    const bool pulled = std::ranges::any_of(model_.constraints, [&](const Constraint& constraint) {
      const auto* support = std::get_if<Support>(&constraint);
      return support && support->beam == beam && support->motion;
    });
    return driven || pulled || model_.beams[beam].flow != 0;
  }

  std::optional<std::size_t> next_rider(std::size_t joint, bool up) const {
    const Rider& from = model_.riders[joint];
    std::optional<std::size_t> next;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model_.riders.size(); ++i) {
      const double ahead = (up ? 1 : -1) * (model_.riders[i].s - from.s);
      if (model_.riders[i].beam != from.beam || ahead <= 0 || ahead >= nearest) continue;
      nearest = ahead;
      next = i;
    }
    return next;
  }

  bool has_stop_between(std::size_t joint, std::size_t eyelet) const {
    const auto [low, high] = std::minmax(model_.riders[joint].s, model_.riders[eyelet].s);
    return std::ranges::any_of(model_.stops, [&, low = low, high = high](const Stop& stop) {
      return stop.other < 0 && stop.rider == static_cast<int>(joint) && stop.place >= low &&
             stop.place <= high;
    });
  }

  // Two riders are nowhere nearer than that [m].
  double least_distance(const Rider& rider) const {
    const Beam& beam = model_.beam_of(rider);
    return meeting_distance * beam.curve.length() / beam.home_intervals();
  }

  void refuse_motion(std::size_t joint, std::size_t eyelet, bool up) {
    const Rider& rider = model_.riders[joint];
    if (!rider.motion->rows()) return;  // a program says it later
    const double place = model_.riders[eyelet].s, reached = place - (up ? 1 : -1) * least_distance(rider);
    constexpr int moments = 1000;
    for (int i = 1; i <= moments; ++i) {
      const double t = resolved_.analysis.end_time * i / moments, s = rider.motion->at(t).s;
      if (up ? s < reached : s > reached) continue;
      findings_.error(resolved_.sliding_joints[joint].path + ".motion",
                      "takes body " + in_quotes(name_of(joint)) + " to eyelet " + in_quotes(name_of(eyelet)) +
                          ", at s = " + text_of(place, 6) + " m of beam " +
                          in_quotes(model_.beam_of(rider).name) + ", by t = " + text_of(t, 3) + " s" + cure +
                          "end the motion or the run before");
      return;
    }
  }

  // How long a bead takes from the joint to the eyelet down the drawn curve; nothing where it does not get
  // there.
  std::optional<double> time_of_descent(const Rider& rider, double to) const {
    constexpr int pieces = 400;
    const ReferenceCurve& curve = model_.beam_of(rider).curve;
    const Eigen::Vector3d from = curve.position(rider.s);
    const double step = std::abs(to - rider.s) / pieces;
    double time = 0, before = rider.speed * (to > rider.s ? 1 : -1);
    if (before < 0) return {};
    for (int i = 1; i <= pieces; ++i) {
      const Eigen::Vector3d at = curve.position(rider.s + (to - rider.s) * i / pieces);
      const double square = rider.speed * rider.speed + 2 * model_.gravity.dot(at - from);
      if (!(square > 0)) return {};
      const double now = std::sqrt(square);
      time += 2 * step / (before + now);
      before = now;
    }
    return time;
  }

  void warn_of_descent(std::size_t joint, std::size_t eyelet) {
    const Rider& rider = model_.riders[joint];
    const double place = model_.riders[eyelet].s;
    const auto time = time_of_descent(rider, place);
    const double arrival = rider.release.value_or(0) + time.value_or(0);
    if (!time || arrival > resolved_.analysis.end_time) return;
    findings_.warn(
        resolved_.sliding_joints[joint].path,
        "body " + in_quotes(name_of(joint)) + " may run into eyelet " + in_quotes(name_of(eyelet)) +
            ", at s = " + text_of(place, 6) + " m of beam " + in_quotes(model_.beam_of(rider).name) +
            ": down the beam as it is drawn, without friction, it is there at t = " + text_of(arrival, 3) +
            " s" + cure + "put a stop before it, or end the run before");
  }

  const ResolvedCase& resolved_;
  const BeamModel& model_;
  Findings& findings_;
};

}  // namespace

void check_ways_to_eyelets(const ResolvedCase& resolved, const BeamModel& model, Findings& findings) {
  if (resolved.eyelets.empty() || resolved.analysis.type != CaseAnalysis::Type::dynamic) return;
  WaysToEyelets ways(resolved, model, findings);
  for (std::size_t joint = 0; joint < resolved.sliding_joints.size(); ++joint) ways.check(joint);
}

}  // namespace nurbeam
