#include "pipelines/model/collectors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "fem/motion/rest/free_lengths.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/simulation_text.h"

namespace nurbeam {

namespace {

// The way along `travel` over time.
PlaceMotion way_of(const CaseCollector& collector) {
  if (!collector.motion.speed) return PlaceMotion(collector.motion.table);
  return PlaceMotion([v = *collector.motion.speed](double t) { return PlaceMotion::Moment{v * t, v, 0}; });
}

// The places of a curve by their distance along a direction, which the curve follows everywhere, or runs
// against.
class PlacesAlong {
 public:
  PlacesAlong(const ReferenceCurve& curve, const Eigen::Vector3d& direction, double start)
      : curve_(std::make_shared<const ReferenceCurve>(curve)),
        direction_(direction),
        start_(start),
        origin_(direction.dot(curve.position(start))) {}

  double distance(double s) const { return direction_.dot(curve_->position(s)) - origin_; }
  double slope(double s) const { return direction_.dot(curve_->tangent(s)); }

  // A place where the curve leads across the direction, or turns back.
  std::optional<double> turn() const {
    constexpr int samples = 16;  // in a segment
    constexpr double across = 0.05;
    const double sign = slope(start_) > 0 ? 1 : -1;
    for (int j = 0; j < curve_->segment_count(); ++j)
      for (int i = 0; i <= samples; ++i) {
        const double s = curve_->breaks()[j] + (curve_->breaks()[j + 1] - curve_->breaks()[j]) * i / samples;
        if (sign * slope(s) < across) return s;
      }
    return {};
  }

  // The place at a distance, with its rates; beyond an end of the curve straight on.
  PlaceMotion::Moment at(const PlaceMotion::Moment& way) const {
    const double s = place(way.s);
    const double inside = std::clamp(s, 0.0, curve_->length());
    const CurvePoint point = curve_->point_in(curve_->segment_at(inside), inside);
    const double along = direction_.dot(point.tangent), speed = way.speed / along;
    return {s, speed, (way.acceleration - direction_.dot(point.curvature) * speed * speed) / along};
  }

 private:
  // Newton's method within a bracket.
  double place(double way) const {
    constexpr int most = 60;
    const double L = curve_->length(), enough = 1e-14 * L, sign = slope(start_) > 0 ? 1 : -1;
    for (const double end : {0.0, L}) {
      const double beyond = way - distance(end);
      if ((end == 0 ? -1 : 1) * sign * beyond >= 0) return end + beyond / slope(end);
    }
    double low = 0, high = L, s = std::clamp(start_ + way * sign, low, high);
    for (int i = 0; i < most; ++i) {
      const double off = distance(s) - way;
      (sign * off > 0 ? high : low) = s;
      double next = s - off / slope(s);
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (std::abs(next - s) <= enough) return next;
      s = next;
    }
    return s;
  }

  std::shared_ptr<const ReferenceCurve> curve_;
  Eigen::Vector3d direction_;
  double start_, origin_;
};

// Whether the wire leads along `travel`, as far as the collector goes.
bool check_way(const CaseCollector& from, const PlacesAlong& places, const PlaceMotion& way, double length,
               const CaseAnalysis& analysis, Findings& findings) {
  if (const auto s = places.turn()) {
    findings.error(from.path + ".travel", "is no direction that beam " + in_quotes(from.beam) +
                                              " leads in everywhere: at s = " + text_of(*s) +
                                              " m it leads across it or back; take another direction, or "
                                              "divide the beam");
    return false;
  }
  if (analysis.type != CaseAnalysis::Type::dynamic) return true;
  constexpr int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    const double t = analysis.end_time * i / samples, s = places.at(way.at(t)).s;
    if (s >= 0 && s <= length) continue;
    findings.error(from.path + ".motion", "takes it beyond the end of beam " + in_quotes(from.beam) +
                                              " at t = " + text_of(t, 4) + " s, and analysis.end_time is " +
                                              text_of(analysis.end_time) +
                                              " s; end before that, or start nearer to the other end");
    return false;
  }
  return true;
}

// Heights of the masses at which springs and contact carry the first force, if the wire stands still.
std::vector<double> first_heights(const CaseCollector& from, double force) {
  const std::size_t n = from.masses.size(), loaded = static_cast<std::size_t>(from.force_on) - 1;
  std::vector<double> heights(n);
  heights[n - 1] = force / from.contact_stiffness;
  for (std::size_t i = n - 1; i-- > 0;)
    heights[i] = heights[i + 1] + (i >= loaded ? force / from.stiffness[i + 1] : 0);
  return heights;
}

// What lifts the masses: their weight, and the force on one of them.
CustomForce lift(const CaseCollector& from, int first_mass, const Eigen::Vector3d& up,
                 const std::optional<PlaceMotion>& way, const Eigen::Vector3d& gravity) {
  const auto n = static_cast<Eigen::Index>(from.masses.size());
  Eigen::Matrix3Xd weights(3, n);
  std::vector<Grip> masses;
  for (Eigen::Index i = 0; i < n; ++i) {
    weights.col(i) = from.masses[static_cast<std::size_t>(i)] * gravity;
    masses.push_back(Grip::on_body(first_mass + static_cast<int>(i)));
  }
  const auto law = [weights, up, way, rows = from.force, c = from.force_per_speed_squared,
                    loaded = from.force_on - 1](double t, const Eigen::Matrix3Xd& r,
                                                const Eigen::Matrix3Xd&) {
    CustomForce::Response response{-weights, Eigen::MatrixXd::Zero(r.size(), r.size()),
                                   Eigen::MatrixXd::Zero(r.size(), r.size())};
    const double speed = way ? way->at(t).speed : 0;
    response.force.col(loaded) += (value_and_slope(rows, t).first + c * speed * speed) * up;
    return response;
  };
  return {std::move(masses), law};
}

// The base, which travels; the masses, which rods hold above it; springs and dampers between them.
void add_masses(const CaseCollector& from, const Eigen::Vector3d& drawn, const Eigen::Vector3d& travel,
                const Eigen::Vector3d& up, const std::optional<PlaceMotion>& way, Collector& collector,
                BeamModel& model) {
  const double start_speed = way ? way->at(0).speed : 0;
  const int base = static_cast<int>(model.bodies.size());
  model.bodies.push_back(
      {.name = from.name + ".base", .mass = 0, .position = drawn, .velocity = start_speed * travel});
  std::optional<DisplacementTable> motion;
  if (way)
    motion.emplace([travel, path = *way](double t) {
      const PlaceMotion::Moment now = path.at(t);
      return DisplacementTable::Motion{now.s * travel, now.speed * travel, now.acceleration * travel};
    });
  model.constraints.push_back(HeldBody{base, drawn, motion});

  std::vector<Eigen::Vector3d> across{travel};
  if (model.dimension == 3) across.push_back(travel.cross(up));
  const double first_force =
      value_and_slope(from.force, 0).first + from.force_per_speed_squared * start_speed * start_speed;
  const std::vector<double> heights = first_heights(from, first_force);
  for (std::size_t i = 0; i < from.masses.size(); ++i) {
    const int body = static_cast<int>(model.bodies.size());
    const std::string number = std::to_string(i + 1);
    model.bodies.push_back({.name = from.name + ".mass_" + number,
                            .mass = from.masses[i],
                            .position = drawn + heights[i] * up,
                            .velocity = start_speed * travel});
    const Grip mass = Grip::on_body(body);
    collector.springs.push_back(static_cast<int>(model.connectors.size()));
    model.connectors.push_back({.name = from.name + ".spring_" + number,
                                .ends = {Grip::on_body(body - 1), mass},
                                .stiffness = from.stiffness[i],
                                .damping = from.damping.empty() ? 0 : from.damping[i],
                                .direction = up});
    for (const Eigen::Vector3d& direction : across)
      model.connectors.push_back({.name = from.name + (direction == travel ? ".guide_" : ".side_") + number,
                                  .ends = {Grip::on_body(base), mass},
                                  .type = ConnectorType::rod,
                                  .direction = direction});
  }
  model.forces.push_back(lift(from, base + 1, up, way, model.gravity));
}

// A step that is too long for the droppers that pass by.
void warn_of_step(const CaseCollector& from, const Rider& shoe, const PlaceMotion& way,
                  const CaseAnalysis& analysis, const BeamModel& model, Findings& findings) {
  constexpr double always_enough = 1e-3, samples = 20;
  if (analysis.type != CaseAnalysis::Type::dynamic || !analysis.step || *analysis.step <= always_enough)
    return;
  std::vector<double> places;
  for (const Connector& connector : model.connectors)
    for (const Grip& end : connector.ends)
      if (end.beam == shoe.beam) places.push_back(end.s);
  std::ranges::sort(places);
  double closest = model.beams[shoe.beam].curve.length();
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] > places[i - 1]) closest = std::min(closest, places[i] - places[i - 1]);
  double fastest = 0;
  for (int i = 0; i <= 100; ++i)
    fastest = std::max(fastest, std::abs(way.at(analysis.end_time * i / 100).speed));
  const double longest = std::max(always_enough, closest / (samples * fastest));
  if (*analysis.step > longest * (1 + 1e-9))
    findings.warn("analysis.step", "is " + text_of(*analysis.step) + " s: collector " + in_quotes(from.name) +
                                       " passes droppers every " + text_of(closest / fastest, 3) +
                                       " s, of which 20 steps or steps of 1 ms are a good resolution; take " +
                                       text_of(longest, 2) + " s");
}

}  // namespace

std::vector<Collector> add_collectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                                      const ModelFrame& frame, BeamModel& model, Findings& findings) {
  std::vector<Collector> collectors;
  const bool moves = resolved.analysis.type == CaseAnalysis::Type::dynamic;
  for (const CaseCollector& from : resolved.collectors) {
    const int b = resolved.beam_index(from.beam);
    const Eigen::Vector3d travel = frame.direction_to_local(from.travel.stableNormalized()),
                          up = frame.direction_to_local(from.up.stableNormalized());
    Collector& collector = collectors.emplace_back();
    collector.name = from.name;
    collector.travel = from.travel.stableNormalized();
    collector.up = from.up.stableNormalized();
    collector.filter = from.filter;
    collector.uplift = from.uplift;
    for (const std::vector<double>& band : from.bands) collector.bands.emplace_back(band[0], band[1]);
    if (from.evaluate.size() == 2) {
      collector.from = from.evaluate[0];
      collector.to = from.evaluate[1];
    }

    const ReferenceCurve& curve = beams[b].curve;
    const double s = beams[b].material_coordinate(place_on(beams[b], from.at, from.path, findings));
    const PlaceMotion way = way_of(from);
    const PlacesAlong places(curve, travel, s);
    if (!check_way(from, places, way, curve.length(), resolved.analysis, findings)) continue;

    // The place on the wire.
    const Eigen::Vector3d drawn = curve.position(s);
    const int shoe = static_cast<int>(model.bodies.size());
    model.bodies.push_back({.name = from.name + ".shoe", .mass = 0, .position = drawn});
    Rider rider{.body = shoe, .beam = b, .s = s, .motion = {}, .rest = StaticPlace::held, .as_point = true};
    if (moves) rider.motion = PlaceMotion([places, way](double t) { return places.at(way.at(t)); });
    rider.leave_at_end = false;
    model.riders.push_back(rider);
    warn_of_step(from, rider, way, resolved.analysis, model, findings);

    add_masses(from, drawn, travel, up, moves ? std::optional(way) : std::nullopt, collector, model);
    collector.head = static_cast<int>(model.bodies.size()) - 1;
    collector.contact = static_cast<int>(model.connectors.size());
    model.connectors.push_back({.name = from.name + ".contact",
                                .ends = {Grip::on_body(collector.head), Grip::on_body(shoe)},
                                .type = ConnectorType::compression_only,
                                .stiffness = from.contact_stiffness,
                                .damping = from.contact_damping,
                                .direction = up});
  }
  return collectors;
}

namespace {

// The model without its collectors, which came last into each of its lists.
BeamModel without_collectors(BeamModel model, const Collector& first) {
  const int shoe = first.head - static_cast<int>(first.springs.size()) - 1;
  const auto is_theirs = [shoe](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_same_v<Part, HeldBody>)
      return part.body >= shoe;
    else if constexpr (std::is_same_v<Part, CustomForce>)
      return part.points.front().body >= shoe;
    else
      return false;
  };
  model.bodies.erase(model.bodies.begin() + shoe, model.bodies.end());
  model.connectors.erase(model.connectors.begin() + first.springs.front(), model.connectors.end());
  std::erase_if(
      model.riders, [shoe](const Rider& rider) { return rider.body >= shoe; });
  std::erase_if(
      model.constraints, [&](const Constraint& c) { return std::visit(is_theirs, c); });
  std::erase_if(model.forces, [&](const Force& f) { return std::visit(is_theirs, f); });
  return model;
}

}  // namespace

void find_lengths_without(const std::vector<Collector>& collectors, const std::function<bool()>& interrupted,
                          BeamModel& model, Findings& findings) {
  if (collectors.empty() || !asks_for_lengths(model)) return;
  const auto line = std::make_shared<const BeamModel>(without_collectors(model, collectors.front()));
  MeshedState at = MeshedState::drawn(line);
  const RestReport rest = find_free_lengths(
      at, interrupted ? interrupted : [] { return false; });
  if (rest.interrupted || rest.failure) {
    SimulationReport report;
    if (rest.failure) report.fail(*rest.failure);
    findings.error("connectors", rest.interrupted ? "the search for their lengths was interrupted"
                                                  : "their lengths are to be found without the collectors: " +
                                                        outcome_text(report, *line));
    return;
  }
  const std::vector<Connector>& found = at.system->model().connectors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    model.connectors[i].length = found[i].length;
    model.connectors[i].length_rule = ConnectorLength::given;
  }
}

}  // namespace nurbeam
