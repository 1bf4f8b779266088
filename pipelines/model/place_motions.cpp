#include "pipelines/model/place_motions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/model/drawn_beam.h"

namespace nurbeam {

namespace {

constexpr double fastest_motion = 1e9;  // [m/s]

// Speeds that jump are blows on the beam.
void note_jumps(const CasePlaceMotion& from, const MovedPlace& place, const RowCurve& motion,
                Findings& findings) {
  if (from.join != RowJoin::linear) return;
  double largest = 0, at = 0;
  for (const auto& [time, s] : motion.rows()) {
    const auto [before, after] = *motion.slopes_at(time);
    if (time <= 0 || std::abs(after - before) <= largest) continue;
    largest = std::abs(after - before);
    at = time;
  }
  if (largest > 0)
    findings.add(Severity::note, place.path + ".motion.interpolation",
                 "\"linear\" makes the speed jump at the rows, by up to " + text_of(largest, 4) + " m/s at " +
                     text_of(at, 6) +
                     " s: each jump is a blow, and between the rows nothing accelerates what moves");
}

// A prescribed motion begins where the place is, stays on the beam and goes from row to row in some time.
void check_motion(const CasePlaceMotion& from, const MovedPlace& place, const RowCurve& motion,
                  Findings& findings) {
  const double L = place.curve->length(), start = motion.at(0).value;
  const double origin = place.from_start ? place.s : 0;
  const auto [least, most] =
      std::minmax({place.sense * (place.low - origin), place.sense * (place.high - origin)});
  if (std::abs(start - place.s) > same_place * L)
    findings.error(place.path + ".motion.table",
                   place.from_start ? "is " + text_of(place.sense * (start - origin)) +
                                          " m at time 0; it counts from the start, and must be 0 there"
                                    : "is at s = " + text_of(start) + " m at time 0, but \"at\" is s = " +
                                          text_of(place.s) + " m; it must start where \"at\" is");
  for (std::size_t i = 0; i < from.table.size(); ++i) {
    const double row = from.table[i].second, s = origin + place.sense * row;
    const std::string path = place.path + ".motion.table[" + std::to_string(i) + "]";
    if (i > 0) {
      const auto& [time, before] = from.table[i - 1];
      const double speed = (row - before) / (from.table[i].first - time);
      if (!(std::abs(speed) <= fastest_motion))
        findings.error(path, "is reached at " + text_of(speed, 3) +
                                 " m/s from the row before; must be at most " + text_of(fastest_motion) +
                                 " m/s: give it more time");
    }
    if (place.curve->closed()) continue;  // as often around as it says
    if (!(s >= place.low - same_place * L && s <= place.high + same_place * L))
      findings.error(path, text_of(row) + " m is not on beam \"" + place.beam + "\", which is " + text_of(L) +
                               " m long; must be between " + text_of(least) + " and " + text_of(most) + " m");
  }
}

// The motion at a constant speed, to where it must end or for twice as long as the analysis: with it the
// place would stand still at its end. The speed is reached evenly within the ramp; as many rows behind it
// keep the curve through them straight from there on.
TimeTable steady_motion(const CasePlaceMotion& motion, const MovedPlace& place, double end_time) {
  const double speed = place.sense * *motion.speed, s = place.s, ramp = motion.ramp;
  const double end = place.curve->closed() ? s + speed * (2 * end_time + ramp)
                     : speed > 0           ? place.high
                                           : place.low;
  if (speed == 0 || end == s) return {{0, s}, {1, s}};
  const double way = (end - s) / speed;  // as a time at this speed
  if (ramp == 0) return {{0, s}, {way, end}};
  constexpr int parts = 32;
  TimeTable rows;
  for (int i = 0; i <= 2 * parts; ++i) {
    const double t = ramp * i / parts, covered = i < parts ? t * t / (2 * ramp) : t - ramp / 2;
    if (covered >= way) break;
    rows.emplace_back(t, s + speed * covered);
  }
  rows.emplace_back(ramp / 2 > way ? std::sqrt(2 * ramp * way) : way + ramp / 2, end);
  return rows;
}

}  // namespace

std::optional<PlaceMotion> place_motion_of(const CasePlaceMotion& motion, const MovedPlace& place,
                                           const CaseAnalysis& analysis, Findings& findings) {
  if (motion.speed) return PlaceMotion(steady_motion(motion, place, analysis.end_time));
  if (motion.table.empty()) return {};
  TimeTable rows = motion.table;
  if (place.from_start)
    for (auto& [time, s] : rows) s = place.s + place.sense * s;
  PlaceMotion moved(std::move(rows), motion.join,
                    place.curve->closed() ? RowCurve::unbounded : std::pair(place.low, place.high));
  if (analysis.type == CaseAnalysis::Type::dynamic) note_jumps(motion, place, *moved.rows(), findings);
  check_motion(motion, place, *moved.rows(), findings);
  return moved;
}

}  // namespace nurbeam
