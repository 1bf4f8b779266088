#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/campaign/draw.h"
#include "tests/campaign/random_case.h"

namespace nurbeam::campaign {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Json json_of(const Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json circle(double radius) {
  Json points = Json::array(), weights = Json::array();
  const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, z[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  for (int i = 0; i < 9; ++i) {
    points.push_back(json_of(Vector3d(radius * x[i], 0, radius * z[i])));
    weights.push_back(i % 2 ? std::sqrt(0.5) : 1);
  }
  return {{"nurbs",
           {{"degree", 2},
            {"knots", {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}},
            {"control_points", points},
            {"weights", weights}}}};
}

class Mechanics : private Draw {
 public:
  explicit Mechanics(unsigned long seed) : Draw(seed) {}

  Json make() {
    planar_ = chance(0.5);
    length_ = log_uniform(2, 60);
    body_mass_ = log_uniform(1, 200);
    carrier_ = one_of<Carrier>({Carrier::guide, Carrier::guide, Carrier::ring, Carrier::rope, Carrier::rope,
                                Carrier::elastic_ring, Carrier::bar});
    c_["nurbeam"] = 1;
    c_["gravity"] = json_of(Vector3d(0, 0, -9.81));
    if (chance(0.35)) add_air();
    add_beam();
    add_sliding_bodies();
    if (chance(0.6)) add_hanging_loads();
    if (chance(0.4)) add_couplings();
    if (is_elastic() && chance(0.4)) add_droppers();
    if (chance(0.5)) add_stops();
    add_analysis();
    return c_;
  }

 private:
  enum class Carrier { guide, ring, rope, elastic_ring, bar };

  bool is_ring() const { return carrier_ == Carrier::ring || carrier_ == Carrier::elastic_ring; }
  bool is_elastic() const { return carrier_ != Carrier::guide && carrier_ != Carrier::ring; }
  Vector3d across() { return planar_ ? Vector3d::Zero() : Vector3d(0, uniform(-1, 1), 0); }

  void add_air() {
    c_["air"] = {{"density", 1.225}};
    if (chance(0.5))
      c_["air"]["wind"] = json_of(Vector3d(uniform(-15, 15), 0, uniform(-3, 3)) + 5 * across());
  }

  // ---- The beam ----

  void add_beam() {
    Json beam = {{"name", "line"}};
    end_ = length_ * (Vector3d(1, 0, uniform(-0.5, 0.3)) + 0.3 * across()).normalized();
    beam["axis"] = is_ring() ? circle(length_ / (2 * pi)) : open_axis();
    if (is_ring()) beam["closed"] = true;
    if (!is_elastic()) {
      beam["rigid"] = true;
      c_["beams"].push_back(beam);
      return;
    }
    const double radius =
        length_ / (carrier_ == Carrier::rope ? log_uniform(500, 5000) : log_uniform(60, 300));
    const double E = log_uniform(1e9, 2e11), axial = E * pi * radius * radius;
    beam["section"] = {{"radius", radius}};
    beam["material"] = {{"density", log_uniform(1000, 8000)}, {"youngs_modulus", E}};
    if (chance(0.3)) beam["material"]["mass_damping"] = log_uniform(1e-2, 2);
    if (chance(0.3)) beam["material"]["stiffness_damping"] = log_uniform(1e-5, 1e-3);
    beam["elements"] = {{"count", whole(6, 24)}};
    beam["stress_free"] = "straight";
    if (carrier_ == Carrier::rope && chance(0.5))
      beam["tension"] = axial * log_uniform(1e-4, 3e-3);
    else if (carrier_ == Carrier::rope)
      beam["unstressed_length"] = length_ * uniform(0.999, 1.03);
    if (carrier_ == Carrier::elastic_ring)
      beam["stress_free"] = planar_ ? "as-drawn" : "as-drawn-without-torsion";
    c_["beams"].push_back(beam);
    add_supports(axial);
  }

  Json open_axis() {
    if (is_elastic() || chance(0.4))
      return {{"polyline", Json::array({json_of(Vector3d::Zero()), json_of(end_)})}};
    Json points = Json::array({json_of(Vector3d::Zero())}), knots = Json::array();
    const int count = whole(4, 7);
    for (int i = 1; i < count; ++i)
      points.push_back(json_of(end_ * i / (count - 1) +
                               length_ / count * (Vector3d(0, 0, uniform(-0.6, 0.6)) + 0.6 * across())));
    for (int i = 0; i < count + 4; ++i) knots.push_back(std::clamp(i - 3, 0, count - 3));
    return {{"nurbs", {{"degree", 3}, {"knots", knots}, {"control_points", points}}}};
  }

  void add_supports(double axial) {
    const auto hold = [&](const Json& at, const char* type) {
      c_["supports"].push_back({{"beam", "line"}, {"at", at}, {"type", type}});
    };
    if (is_ring()) {
      for (const double at : {0.05, 0.35, 0.7}) hold({{"fraction", at}}, chance(0.5) ? "clamped" : "pinned");
      return;
    }
    hold("start", carrier_ == Carrier::bar ? "clamped" : "pinned");
    if (carrier_ == Carrier::rope || chance(0.5)) hold("end", "pinned");
    if (carrier_ == Carrier::rope && chance(0.25)) {
      Json& guided = c_["supports"].back();
      guided["type"] = "guided";
      guided["direction"] = json_of(end_.normalized());
      guided["force"] = axial * log_uniform(1e-4, 2e-3);
      if (chance(0.7)) guided["mass"] = body_mass_ * uniform(1, 10);
    }
    if (chance(0.3)) hold({{"fraction", std::round(100 * uniform(0.3, 0.7)) / 100}}, "pinned");
  }

  // ---- What slides ----

  void add_sliding_bodies() {
    const int count = one_of<int>({1, 1, 2, 2, 3});
    for (int i = 0; i < count; ++i) {
      const std::string name = "body " + std::to_string(i + 1);
      const double at = (i + uniform(0.15, 0.85)) / count;
      Json body = {{"name", name}, {"mass", body_mass_ * log_uniform(0.3, 3)}};
      if (c_.contains("air") && chance(0.7)) body["drag_area"] = log_uniform(0.01, 1);
      c_["bodies"].push_back(body);
      Json joint = {{"body", name}, {"beam", "line"}, {"at", {{"fraction", at}}}};
      if (chance(0.5)) joint["speed"] = uniform(-1, 1) * std::sqrt(9.81 * length_);
      if (chance(carrier_ == Carrier::rope ? 0.85 : carrier_ == Carrier::elastic_ring ? 0.3 : 0))
        joint["slope"] = "discontinuous";
      if (chance(0.7)) joint["friction"] = friction(body["mass"], joint.contains("slope"));
      if (chance(0.3)) joint["at_beam_end"] = "stop";
      if (chance(0.2)) joint["equilibrium"] = "free";
      c_["sliding_joints"].push_back(joint);
      places_.push_back(at);
    }
  }

  Json friction(double mass, bool kinked) {
    Json friction = Json::object();
    if (chance(0.8)) friction["coefficient"] = log_uniform(0.01, 0.8);
    if (friction.contains("coefficient") && chance(0.4))
      friction["static"] = friction["coefficient"].get<double>() * uniform(1, 2);
    if (friction.contains("coefficient") && kinked && chance(0.5)) friction["law"] = "capstan";
    if (chance(0.3)) friction["force"] = mass * log_uniform(0.1, 10);
    if (chance(0.2))
      friction["force"] = Json::array({Json::array({0, 0}), Json::array({uniform(0.1, 0.5), 0}),
                                       Json::array({uniform(0.6, 1), mass * log_uniform(1, 10)})});
    if (friction.empty() || chance(0.2)) friction["viscous"] = mass * log_uniform(0.01, 3);
    return friction;
  }

  // ---- What hangs and couples ----

  Vector3d drawn(double fraction) const {
    const double angle = 2 * pi * fraction;
    return is_ring() ? Vector3d(length_ / (2 * pi) * Vector3d(std::cos(angle), 0, std::sin(angle)))
                     : Vector3d(fraction * end_);
  }

  double stiffness() { return body_mass_ * std::pow(2 * pi * log_uniform(1, 20), 2); }

  Json connector(const Json& from, const Json& to, const std::string& type) {
    Json made = {{"name", "c" + std::to_string(c_.contains("connectors") ? c_["connectors"].size() : 0)},
                 {"from", from},
                 {"to", to},
                 {"type", type}};
    if (type == "rod") return made;
    const double k = stiffness();
    made["stiffness"] = k;
    if (chance(0.5)) made["damping"] = std::sqrt(k * body_mass_) * log_uniform(0.01, 3);
    return made;
  }

  std::string some_type() {
    return one_of<std::string>({"rod", "rod", "spring", "tension-only", "tension-only"});
  }

  void add_hanging_loads() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (chance(0.4)) continue;
      const std::string name = "load " + std::to_string(i + 1);
      const Vector3d down = length_ * uniform(0.03, 0.2) * (Vector3d(uniform(-1, 1), 0, -1) + 0.5 * across());
      Json load = {{"name", name},
                   {"mass", body_mass_ * log_uniform(0.1, 5)},
                   {"position", json_of(drawn(places_[i]) + down)}};
      if (c_.contains("air") && chance(0.5)) load["drag_area"] = log_uniform(0.01, 1);
      if (chance(0.3)) load["velocity"] = json_of(2 * across() + Vector3d(uniform(-2, 2), 0, 0));
      c_["bodies"].push_back(load);
      c_["connectors"].push_back(
          connector({{"body", "body " + std::to_string(i + 1)}}, {{"body", name}}, some_type()));
    }
  }

  void add_couplings() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Json body = {{"body", "body " + std::to_string(i + 1)}};
      if (i > 0 && chance(0.6))
        c_["connectors"].push_back(
            connector({{"body", "body " + std::to_string(i)}}, body,
                      one_of<std::string>({"spring", "tension-only", "compression-only"})));
      else if (chance(0.3))
        c_["connectors"].push_back(connector(
            body, {{"point", json_of(drawn(places_[i]) + length_ * 0.3 * (Vector3d(0, 0, 1) + across()))}},
            one_of<std::string>({"spring", "tension-only"})));
    }
  }

  void add_droppers() {
    for (int i = whole(1, 3); i > 0; --i) {
      const double at = std::round(100 * uniform(0.1, 0.9)) / 100;
      Json dropper = connector({{"beam", "line"}, {"at", {{"fraction", at}}}},
                               {{"point", json_of(drawn(at) + Vector3d(0, 0, 0.1 * length_))}},
                               one_of<std::string>({"spring", "tension-only", "tension-only"}));
      if (chance(0.3)) dropper["end_masses"] = Json::array({body_mass_ * 0.01, 0});
      c_["connectors"].push_back(dropper);
    }
  }

  Json strength() {
    if (chance(0.5)) return {{"restitution", one_of<double>({0, 0.3, 0.7, 1})}};
    const double k = stiffness();
    Json buffer = {{"stiffness", k}};
    if (chance(0.6)) buffer["damping"] = std::sqrt(k * body_mass_) * log_uniform(0.01, 2);
    return buffer;
  }

  void add_stops() {
    for (std::size_t i = 1; i < places_.size(); ++i) {
      Json stop = strength();
      stop["beam"] = "line";
      stop["bodies"] = Json::array({"body " + std::to_string(i), "body " + std::to_string(i + 1)});
      if (chance(0.5)) stop["gap"] = uniform(0, 0.5) * (places_[i] - places_[i - 1]) * length_;
      c_["stops"].push_back(stop);
    }
    for (const double at : {0.02, 0.98}) {
      if (is_ring() || chance(0.3)) continue;
      Json stop = strength();
      stop["beam"] = "line";
      stop["at"] = {{"fraction", at}};
      c_["stops"].push_back(stop);
    }
  }

  void add_analysis() {
    const double end = std::min(2.0, uniform(0.5, 1.5) * std::sqrt(length_ / 9.81));
    Json analysis = {{"end_time", end}};
    if (chance(0.75))
      analysis["step"] = end / whole(60, 400);
    else
      analysis["tolerance"] = log_uniform(1e-6, 1e-4);
    if (chance(0.7))
      analysis["integrator"] = {{"type", "generalized-alpha"}, {"rho_infinity", uniform(0.3, 1)}};
    if (chance(carrier_ == Carrier::rope ? 0.6 : 0.2)) analysis["initial"] = "equilibrium";
    c_["analysis"] = analysis;
    c_["output"] = {{"report", false}, {"every", end / 20}};
  }

  Json c_;
  bool planar_ = true;
  Carrier carrier_ = Carrier::guide;
  double length_ = 1, body_mass_ = 1;
  Vector3d end_ = Vector3d::Zero();
  std::vector<double> places_;  // of the sliding bodies, in parts of the length
};

}  // namespace

Json random_mechanics(unsigned long seed) { return Mechanics(seed).make(); }

}  // namespace nurbeam::campaign
