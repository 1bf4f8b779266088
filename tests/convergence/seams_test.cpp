// A body swings through the lowest place of a rigid ring: whether the seam is there, or a joint of the
// curve's segments, or none of them, changes nothing of what resists, stops and hangs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "pipelines/verification/models.h"
#include "pipelines/verification/verify_run.h"

namespace nurbeam {
namespace {

using namespace verification;
using std::numbers::pi;
constexpr double ring_radius = 3;

struct Swing {
  const char* name;
  /// What is added; gets s of a direction [degrees].
  std::function<void(BeamModel&, const std::function<double(double)>&)> add;
};

void hang(BeamModel& model, ConnectorType type, double stiffness, double damping) {
  const Eigen::Vector3d at = model.beams[0].curve.position(model.riders[0].s);
  model.bodies.push_back({.name = "load", .mass = 4, .position = at + Eigen::Vector3d(0.3, -0.8, 0)});
  model.connectors.push_back({.name = "rope",
                              .ends = {Grip::on_body(0), Grip::on_body(1)},
                              .type = type,
                              .stiffness = stiffness,
                              .damping = damping,
                              .length = std::hypot(0.3, 0.8)});
}

/// A stop for the body at 300 degrees, ahead of it.
Stop stop_ahead(const BeamModel& model, double place) {
  const double length = 2 * pi * ring_radius;
  return {.rider = 0, .place = place < model.riders[0].s ? place + length : place};
}

/// Segments of 120 degrees, the first from the seam on; the body starts at 215 degrees, at rest.
RunRecord swing(const Swing& of, double seam) {
  ModelBuilder builder(2, {0, -9.81, 0});
  builder.add_guide(
      ReferenceCurve(arc_cubics({0, 0, 0}, ring_radius, seam * pi / 180, (seam + 360) * pi / 180, 3), 2,
                     Metric::arc_length, true));
  const auto s = [&](double direction) {
    return ring_radius * std::fmod(direction - seam + 720, 360) * pi / 180;
  };
  builder.slide(builder.add_body("body", 5), 0, s(215));
  BeamModel model = builder.build();
  of.add(model, s);
  return run_model(model, even_times(2.5, 50), 1e-3);
}

class Seams : public ::testing::TestWithParam<Swing> {};

TEST_P(Seams, ChangeNothing) {
  const RunRecord free = swing(GetParam(), 90);
  for (const double seam : {270.0, 150.0}) {
    const RunRecord run = swing(GetParam(), seam);
    double apart = 0, pull = 0, rubs = 0, greatest_pull = 1, booked = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const Snapshot &a = free.frames[i], &b = run.frames[i];
      for (std::size_t k = 0; k < a.bodies.size(); ++k)
        apart = std::max(apart, (a.bodies[k].point.position - b.bodies[k].point.position).norm());
      for (std::size_t k = 0; k < a.connectors.size(); ++k) {
        pull = std::max(pull, std::abs(a.connectors[k].force - b.connectors[k].force));
        greatest_pull = std::max(greatest_pull, std::abs(a.connectors[k].force));
      }
      if (std::isfinite(a.bodies[0].friction_force))
        rubs = std::max(rubs, std::abs(a.bodies[0].friction_force - b.bodies[0].friction_force));
      booked = std::max(booked, std::abs(a.energy.dissipated - b.energy.dissipated));
    }
    const auto physical = [](const RunRecord& record) {
      return std::count_if(record.report.events.begin(), record.report.events.end(),
                           [](const RunEvent& event) { return event.kind >= EventKind::sticks; });
    };
    EXPECT_EQ(physical(run), physical(free)) << seam;
    EXPECT_LT(apart, 1e-4) << seam;
    EXPECT_LT(pull, 3e-3 * greatest_pull) << seam;
    EXPECT_LT(rubs, 0.05) << seam;
    EXPECT_LT(booked, 1e-3 * std::max(10.0, free.report.energy_scale())) << seam;
    EXPECT_LT(run.report.energy_drift, 1e-3 * run.report.energy_scale()) << seam;
  }
}

using PlaceOf = std::function<double(double)>;

INSTANTIATE_TEST_SUITE_P(
    Each, Seams,
    ::testing::Values(
        Swing{"Guide", [](BeamModel&, const PlaceOf&) {}},
        Swing{"Friction",
              [](BeamModel& model, const PlaceOf&) {
                model.riders[0].friction = Friction{.coefficient = 0.1, .static_coefficient = 0.2};
              }},
        Swing{"Brake",
              [](BeamModel& model, const PlaceOf&) {
                model.riders[0].friction = Friction{.force = TimeTable{{0, 0}, {0.5, 0}, {2, 40}}};
              }},
        Swing{"Wind",
              [](BeamModel& model, const PlaceOf&) {
                model.air = {.density = 1.2, .wind = {8, 0, 0}};
                model.bodies[0].drag_area = 0.5;
              }},
        Swing{"HardStop",
              [](BeamModel& model, const PlaceOf& s) {
                model.stops.push_back(stop_ahead(model, s(300)));
                model.stops[0].restitution = 0.7;
              }},
        Swing{"Buffer",
              [](BeamModel& model, const PlaceOf& s) {
                model.stops.push_back(stop_ahead(model, s(300)));
                model.stops[0].buffer = Buffer{4e3, 60};
              }},
        Swing{"Rod", [](BeamModel& model, const PlaceOf&) { hang(model, ConnectorType::rod, 0, 0); }},
        Swing{"RopeWithADamper",
              [](BeamModel& model, const PlaceOf&) { hang(model, ConnectorType::tension_only, 2e3, 40); }}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace nurbeam
