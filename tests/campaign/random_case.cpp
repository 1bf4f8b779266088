#include "tests/campaign/random_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/campaign/draw.h"

namespace nurbeam::campaign {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Json to_json(const Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

class Generator : private Draw {
 public:
  explicit Generator(unsigned long seed) : Draw(seed) {}

  Json make() {
    planar_ = chance(0.5);
    Json c;
    c["nurbeam"] = 1;
    c["gravity"] = chance(0.15) ? to_json(Vector3d::Zero()) : to_json(Vector3d(0, 0, -9.81));
    add_beams(c);
    add_supports(c);
    add_joint(c);
    if (!torsion_) add_bodies(c);
    add_loads(c);
    add_analysis(c);
    return c;
  }

 private:
  /// In the x-z plane where the model is planar.
  Vector3d vector(double size) {
    return {uniform(-size, size), planar_ ? 0 : uniform(-size, size), uniform(-size, size)};
  }
  Vector3d direction() {
    while (true)
      if (const Vector3d v = vector(1); v.norm() > 0.3) return v.normalized();
  }

  // ---- Beams ----

  void add_beams(Json& c) {
    torsion_ = !planar_ && chance(0.4);
    length_ = log_uniform(0.5, 30);
    const int count = chance(0.7) ? 1 : 2;
    ring_ = count == 1 && chance(0.12);
    slenderness_ = log_uniform(30, 1000);
    modulus_ = log_uniform(1e7, 2e11);
    density_ = log_uniform(500, 8000);
    Vector3d start = Vector3d::Zero();
    for (int i = 0; i < count; ++i) {
      Json beam;
      beam["name"] = "beam " + std::to_string(i + 1);
      auto [axis, end] = ring_ ? ring() : axis_from(start);
      beam["axis"] = axis;
      beam["section"] = section();
      beam["material"] = {{"density", density_}, {"youngs_modulus", modulus_}};
      if (damped_or_not_) beam["material"]["damping"] = damping_;
      beam["elements"] = {{"count", whole(ring_ ? 8 : 3, 14)}};
      if (ring_) beam["closed"] = true;
      if (torsion_) {
        beam["torsion"] = true;
        if (chance(0.4)) beam["orientation"] = {{"start", to_json(direction())}};
      } else {
        beam["stress_free"] = planar_ && chance(0.6) ? "as-drawn" : "straight";
        if (!planar_ && chance(0.3)) beam["stress_free"] = "as-drawn-without-torsion";
      }
      c["beams"].push_back(beam);
      start = end;
    }
  }

  Json section() {
    const double r = length_ / slenderness_;
    if (!torsion_ || chance(0.5)) return {{"radius", r}};
    const double area = pi * r * r, I = area * r * r / 4, ratio = uniform(1, 5);
    return {{"area", area},
            {"second_moments", Json::array({I * ratio, I})},
            {"torsion_constant", I * uniform(0.5, 2)}};
  }

  std::pair<Json, Vector3d> axis_from(const Vector3d& start) {
    const int kind = whole(0, 2);
    Vector3d along = direction();
    if (kind == 0) {
      const Vector3d end = start + length_ * along;
      return {{{"polyline", Json::array({to_json(start), to_json(end)})}}, end};
    }
    if (kind == 1) {
      const double angle = uniform(0.3, 4.5), radius = length_ / angle;
      const Vector3d normal =
          planar_ ? Vector3d(0, chance(0.5) ? 1 : -1, 0) : Vector3d(along.unitOrthogonal());
      const Vector3d outward = -along.cross(normal).normalized();  // from the centre to the start
      const Vector3d centre = start - radius * outward;
      const Vector3d end = centre + Eigen::AngleAxisd(angle, normal) * (start - centre);
      return {{{"arc",
                {{"center", to_json(centre)},
                 {"start", to_json(start)},
                 {"end", to_json(end)},
                 {"normal", to_json(normal)}}}},
              end};
    }
    Json points = Json::array({to_json(start)});
    Vector3d p = start;
    const int count = whole(4, 7);
    for (int i = 1; i < count; ++i) {
      p += length_ / (count - 1) * (along + 0.35 * vector(1));
      points.push_back(to_json(p));
    }
    Json knots = Json::array();
    for (int i = 0; i < count + 4; ++i) knots.push_back(std::clamp(i - 3, 0, count - 3));
    Json nurbs = {{"degree", 3}, {"knots", knots}, {"control_points", points}};
    if (chance(0.5))
      for (int i = 0; i < count; ++i) nurbs["weights"].push_back(uniform(0.7, 1.4));
    return {{{"nurbs", nurbs}}, p};
  }

  std::pair<Json, Vector3d> ring() {
    const double R = length_ / (2 * pi);
    Json points = Json::array(), weights = Json::array();
    const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, z[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
    for (int i = 0; i < 9; ++i) {
      points.push_back(to_json(Vector3d(R * x[i], 0, R * z[i])));
      weights.push_back(i % 2 ? std::sqrt(0.5) : 1);
    }
    return {{{"nurbs",
              {{"degree", 2},
               {"knots", {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}},
               {"control_points", points},
               {"weights", weights}}}},
            Vector3d(R, 0, 0)};
  }

  // ---- What holds them ----

  Json place() { return {{"fraction", std::round(100 * uniform(0.03, 0.97)) / 100}}; }
  std::string some_beam(const Json& c) {
    return one_of(std::vector<Json>(c["beams"].begin(), c["beams"].end()))["name"];
  }
  std::string support_type() {
    if (torsion_ && chance(0.3)) return "fork";
    return chance(0.5) ? "clamped" : "pinned";
  }

  void add_supports(Json& c) {
    const auto add = [&](const Json& at) {
      c["supports"].push_back({{"beam", "beam 1"}, {"at", at}, {"type", support_type()}});
    };
    if (chance(0.06)) return;  // it flies
    if (ring_) {
      add({{"fraction", 0.25}});
      if (chance(0.5)) add({{"fraction", 0.6}});
      return;
    }
    add("start");
    if (c["beams"].size() == 1 && chance(0.55)) add("end");
    if (chance(0.12)) add(place());
    if (c["beams"].size() > 1 && chance(0.5))
      c["supports"].push_back({{"beam", "beam 2"}, {"at", "end"}, {"type", support_type()}});
  }

  void add_joint(Json& c) {
    if (c["beams"].size() < 2) return;
    c["joints"].push_back(
        {{"beams", Json::array({"beam 1", "beam 2"})}, {"type", chance(0.5) ? "rigid" : "hinged"}});
  }

  // ---- What slides and what acts ----

  void add_bodies(Json& c) {
    const int count = chance(0.45) ? 1 : chance(0.2) ? 2 : 0;
    const double r = length_ / slenderness_, mass = density_ * pi * r * r * length_;
    for (int i = 0; i < count; ++i) {
      const std::string name = "body " + std::to_string(i + 1);
      c["bodies"].push_back({{"name", name}, {"mass", mass * log_uniform(0.05, 20)}});
      Json joint = {{"body", name},
                    {"beam", i == 0 ? "beam 1" : some_beam(c)},
                    {"at", {{"fraction", i == 0 ? uniform(0.05, 0.4) : uniform(0.5, 0.9)}}}};
      const double speed = length_ * uniform(-1, 1);
      const int kind = whole(0, 3);
      if (kind == 1) joint["speed"] = speed;
      if (kind == 2) joint["motion"] = {{"speed", speed}};
      if (chance(0.35)) joint["slope"] = "discontinuous";
      if (chance(0.4)) joint["at_beam_end"] = "stop";
      c["sliding_joints"].push_back(joint);
    }
  }

  Json time_rows(double end) {
    Json rows = Json::array();
    double t = 0;
    for (int i = 0; i < whole(1, 4); ++i) {
      rows.push_back(Json::array({t, uniform(-1, 1)}));
      t += uniform(0.1, 0.5) * end;
    }
    return rows;
  }

  void add_loads(Json& c) {
    const double r = length_ / slenderness_, I = pi * std::pow(r, 4) / 4;
    const double weight = density_ * pi * r * r * 9.81 * length_;
    const double bends = modulus_ * I / (length_ * length_),
                 size = std::sqrt(weight * bends) * log_uniform(0.03, 1);
    for (int i = whole(0, 3); i > 0; --i) {
      Json load = {{"beam", some_beam(c)}};
      const int kind = whole(0, 3);
      if (kind == 0) {
        load["force_per_length"] = to_json(size / length_ * vector(1));
      } else if (kind == 1) {
        load["at"] = place();
        load["moment"] = planar_ ? to_json(Vector3d(0, 0.3 * size * length_ * uniform(-1, 1), 0))
                                 : to_json(0.3 * size * length_ * vector(1));
      } else {
        load["at"] = place();
        load["force"] = to_json(size * vector(1));
        if (chance(0.3)) load["moves"] = {{"speed", length_ * uniform(-1, 1)}};
      }
      if (kind != 0 && !load.contains("moves") && chance(0.3)) load["follower"] = true;
      if (chance(0.5)) load["time"] = time_rows(end_time());
      c["loads"].push_back(load);
    }
  }

  /// Long enough for a body to run along half the beam, or for a fall.
  double end_time() const { return std::min(0.5, std::sqrt(length_ / 9.81)); }

  void add_analysis(Json& c) {
    Json analysis = {{"end_time", end_time()}};
    if (chance(0.3)) analysis["initial"] = "equilibrium";
    if (chance(0.5))
      analysis["step"] = end_time() / whole(40, 160);
    else if (chance(0.5))
      analysis["tolerance"] = log_uniform(1e-5, 1e-3);
    const int kind = whole(0, 9);
    if (kind <= 3)
      analysis["integrator"] = {{"type", "generalized-alpha"}, {"rho_infinity", uniform(0.3, 1)}};
    if (kind >= 4 && kind <= 6) analysis["integrator"] = {{"type", "radau"}};
    if (chance(0.06)) analysis = {{"type", "static"}};
    c["analysis"] = analysis;
    c["output"] = {{"report", false},
                   {"probes", Json::array({{{"name", "probe"}, {"beam", "beam 1"}, {"at", place()}}})}};
    if (!analysis.contains("type")) c["output"]["every"] = end_time() / 20;
  }

  bool planar_ = true, torsion_ = false, ring_ = false;
  double length_ = 1, slenderness_ = 100, modulus_ = 1e9, density_ = 1000;
  bool damped_or_not_ = false;
  double damping_ = 0;

 public:
  void choose_damping() {
    damped_or_not_ = chance(0.4);
    damping_ = log_uniform(1e-5, 1e-2);
  }
};

}  // namespace

Json random_case(unsigned long seed) {
  Generator generator(seed);
  generator.choose_damping();
  return generator.make();
}

}  // namespace nurbeam::campaign
