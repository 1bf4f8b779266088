#include "pipelines/model/loads.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// The factor of a load over time; in load steps time is the load factor. What goes with it is the place of a
// force that moves, which is there in full.
TimeTable time_of(const TimeTable& time, const CaseAnalysis& analysis) {
  if (!time.empty() || analysis.load_factors.empty()) return time;
  const double last = std::max(1.0, analysis.load_factors.back());
  return {{0, 0}, {last, last}};
}
TimeTable time_of(const CaseLoad& load, const CaseAnalysis& analysis) {
  return load.moving_speed ? load.time : time_of(load.time, analysis);
}

// That of a force or a moment at a place.
LoadAtPlace load_at_place(const CaseLoad& load, int b, const DrawnBeam& beam, const Eigen::Vector3d& value,
                          const CaseAnalysis& analysis, Findings& findings) {
  const double s = beam.material_coordinate(place_on(beam, load.at, load.path, findings));
  const double speed = load.moving_speed.value_or(0);
  const bool at_start = s == beam.curve.start(), at_end = s == beam.curve.end();
  if (!beam.curve.closed() && ((at_start && speed < 0) || (at_end && speed > 0)))
    findings.warn(load.path + ".moves.speed", "is " + text_of(speed) +
                                                  " m/s: the force leaves the beam at once and does "
                                                  "nothing; it moves from the " +
                                                  (at_start ? "start" : "end") + " into the beam with a " +
                                                  (at_start ? "positive" : "negative") + " speed");
  return {b,
          s,
          speed,
          value,
          load.follower,
          time_of(load, analysis),
          load.offset.value_or(Eigen::Vector2d::Zero())};
}

// A beam without torsion takes no moment along itself.
void check_moment(const CaseLoad& load, const LoadAtPlace& moment, const DrawnBeam& beam,
                  Findings& findings) {
  const double along = moment.value.dot(beam.curve.tangent(moment.s));
  if (std::abs(along) > 1e-9 * moment.value.norm())
    findings.error(load.path + ".moment",
                   "the moment has a component of " + text_of(along) +
                       " N m along the beam, which has no torsion; leave only the part across it");
}

// The length of a beam that a force sees, over its drawn length: at a place of it.
double seen_at(const ReferenceCurve& curve, double s, const Eigen::Vector3d& along) {
  const Eigen::Vector3d t = curve.tangent(s);
  return (t - t.dot(along) * along).norm();
}

// A load by the length that it sees of the drawing. Its uneven part stands at the two places of Gauss's rule
// in each home interval.
LineLoad projected_load(const CaseLoad& load, int b, const Beam& beam, const Eigen::Vector3d& value,
                        const CaseAnalysis& analysis) {
  const double place = (1 - 1 / std::sqrt(3.0)) / 2;
  constexpr double nothing = 1e-12;  // of the length
  const int intervals = static_cast<int>(beam.home.size()) - 1;
  LineLoad line{b, value, time_of(load, analysis)};
  if (value.norm() == 0) return line;
  double seen = 0;
  for (int h = 0; h < intervals; ++h)
    for (const double x : {place, 1 - place}) {
      const double from = beam.home_place(h), length = beam.home_place(h + 1) - from, s = from + x * length;
      line.uneven.push_back({s, length / 2 * seen_at(beam.curve, s, value.normalized())});
      seen += line.uneven.back().length;
    }
  line.even = seen / beam.curve.length();
  for (int h = 0; h < intervals; ++h)
    for (const int i : {2 * h, 2 * h + 1})
      line.uneven[i].length -= line.even * (beam.home_place(h + 1) - beam.home_place(h)) / 2;
  std::erase_if(line.uneven, [&](const LineLoad::Share& share) {
    return std::abs(share.length) < nothing * beam.curve.length();
  });
  return line;
}

}  // namespace

void add_loads(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
               BeamModel& model, std::vector<std::vector<int>>& forces_of_loads, Findings& findings) {
  for (const CaseLoad& load : resolved.loads) {
    const int b = resolved.beam_index(load.beam);
    const DrawnBeam& beam = beams[b];
    forces_of_loads[load.number].push_back(static_cast<int>(model.forces.size()));
    switch (load.kind) {
      case CaseLoad::Kind::force:
        model.forces.push_back(PointLoad{
            load_at_place(load, b, beam, frame.direction_to_local(load.value), resolved.analysis, findings)});
        break;
      case CaseLoad::Kind::moment: {
        const LoadAtPlace moment =
            load_at_place(load, b, beam, frame.moment_to_local(load.value), resolved.analysis, findings);
        if (!resolved.beams[b].torsion) check_moment(load, moment, beam, findings);
        model.forces.push_back(Moment{moment});
        break;
      }
      case CaseLoad::Kind::force_per_length:
        model.forces.push_back(
            LineLoad{b, frame.direction_to_local(load.value), time_of(load, resolved.analysis)});
        break;
      case CaseLoad::Kind::force_per_projected_length:
        model.forces.push_back(
            projected_load(load, b, model.beams[b], frame.direction_to_local(load.value), resolved.analysis));
        break;
      case CaseLoad::Kind::torque_per_length:
        model.forces.push_back(LineTorque{b, load.torque, time_of(load, resolved.analysis)});
        break;
    }
  }
}

void add_body_loads(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model,
                    std::vector<std::vector<int>>& forces_of_loads, Findings& findings) {
  for (const CaseBodyLoad& load : resolved.body_loads) {
    const int body = resolved.body_index(load.on.body);
    const Body& of = model.bodies[body];
    const int turns = of.rigid ? body : of.point_of ? of.point_of->body : -1;
    if (turns < 0 && (load.is_moment || load.follower)) {
      findings.error(load.path + (load.is_moment ? ".moment" : ".follower"),
                     "is of what turns, but body \"" + of.name +
                         "\" is a point mass, which does not; give it an \"inertia\"");
      continue;
    }
    forces_of_loads[load.number].push_back(static_cast<int>(model.forces.size()));
    model.forces.push_back(BodyLoad{
        .body = body,
        .turns = turns,
        .is_moment = load.is_moment,
        .value = load.is_moment ? frame.moment_to_local(load.value) : frame.direction_to_local(load.value),
        .follower = load.follower,
        .time = time_of(load.time, resolved.analysis)});
  }
}

}  // namespace nurbeam
