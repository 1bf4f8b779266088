#include "fem/motion/rest/adapted_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "fem/motion/rest/resting_place.h"
#include "fem/system/material_points.h"

namespace nurbeam {

namespace {

bool divides(const HomeNode& node) {
  return node.permanent || node.joined || node.kind != NodeKind::smooth || node.hold != Hold::nothing;
}

/// Home nodes between which elements have one length.
std::vector<int> dividing_nodes(const Beam& beam) {
  std::vector<int> nodes{0};
  for (int h = 1; h < beam.home_intervals(); ++h)
    if (divides(beam.home[h])) nodes.push_back(h);
  nodes.push_back(beam.home_intervals());
  return nodes;
}

/// Estimated error of an element of the drawn shape, by how far a cubic misses an arc; comparable to
/// position_error() [m].
double drawn_error(const Beam& beam, double s_a, double s_b) {
  const double s = (s_a + s_b) / 2;
  const int segment = beam.curve.segment_at(s);
  const double kappa = beam.curve.geometry(segment, beam.curve.parameter(segment, s)).curvature[0];
  return quartic_strain_to_error * std::pow(kappa * (s_b - s_a), 4) / 560 * (s_b - s_a);
}

/// Contribution of each interval between two home nodes of a beam to the estimated error [m].
std::vector<double> home_errors(const MeshedState& at, int b, bool from_equilibrium) {
  const Beam& beam = at.system->model().beams[b];
  const Mesh& mesh = at.system->mesh();
  std::vector<double> errors(beam.home_intervals(), 0.0);
  for (int i = mesh.first_span[b]; i < mesh.first_span[b + 1]; ++i) {
    const double s_a = mesh.spans[i].start(at.state.q), s_b = mesh.spans[i].end(at.state.q);
    errors[beam.home_interval((s_a + s_b) / 2)] +=
        from_equilibrium ? position_error(*at.system, at.state, i) : drawn_error(beam, s_a, s_b);
  }
  return errors;
}

/// Elements between two dividing nodes, and their contribution to the estimated error over the length.
struct Interval {
  int elements;
  double error;

  /// The number of elements of this interval in an optimal mesh, with `density` [error^(1/5)] as the common
  /// factor. Errors fall with the fourth power of the number. With the fewest elements each has an equal
  /// error.
  int elements_for(double density) const {
    const double wanted = elements * density * std::pow(error / elements, 0.2);
    constexpr double most_at_once = 3;  // a coarse mesh's estimate is not trusted for a larger factor
    return static_cast<int>(std::ceil(std::clamp(wanted, 1.0 * elements, most_at_once * elements)));
  }
};

std::vector<Interval> intervals(const std::vector<int>& nodes, const std::vector<double>& errors,
                                double length) {
  std::vector<Interval> all;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    all.push_back({nodes[i + 1] - nodes[i],
                   std::accumulate(errors.begin() + nodes[i], errors.begin() + nodes[i + 1], 0.0) / length});
  return all;
}

class Adaption {
 public:
  Adaption(BeamModel& model, const std::vector<std::optional<double>>& tolerances, int most_elements,
           const std::function<bool()>& interrupted, double time)
      : model_(model),
        tolerances_(tolerances),
        most_elements_(most_elements),
        interrupted_(interrupted),
        time_(time) {}

  AdaptedMesh run() {
    constexpr int most_rounds = 12;
    for (int round = 0; round < most_rounds; ++round) {
      result_ = {};
      const MeshedState at = equilibrium();
      if (result_.interrupted) return result_;
      bool divided = false;
      for (int b = 0; b < static_cast<int>(model_.beams.size()); ++b)
        if (tolerances_[b]) divided = divide(at, b) || divided;
      if (!divided) return result_;
    }
    result_.reached = false;
    return result_;
  }

 private:
  MeshedState equilibrium() {
    const auto model = std::make_shared<const BeamModel>(model_);
    MeshedState at = MeshedState::drawn(model);
    at.state.t = time_;
    const RestReport found = find_held_equilibrium(at, interrupted_);
    result_.interrupted = found.interrupted;
    result_.from_equilibrium = !found.failure;
    return result_.from_equilibrium ? std::move(at) : MeshedState::drawn(model);
  }

  // Divides a beam further where its error is too large; returns whether it has got more elements.
  bool divide(const MeshedState& at, int b) {
    Beam& beam = model_.beams[b];
    const std::vector<int> nodes = dividing_nodes(beam);
    const std::vector<Interval> now =
        intervals(nodes, home_errors(at, b, result_.from_equilibrium), beam.curve.length());
    double error = 0, spread = 0;
    for (const Interval& interval : now) {
      error += interval.error;
      spread += interval.elements * std::pow(interval.error / interval.elements, 0.2);
    }
    result_.error = std::max(result_.error, error);
    if (error <= *tolerances_[b]) return false;
    constexpr double margin = 0.9;  // part of the tolerance, as the next estimate differs a little
    const double density = std::pow(spread / (margin * *tolerances_[b]), 0.25);
    std::vector<int> parts;
    for (const Interval& interval : now) parts.push_back(interval.elements_for(density));
    if (std::accumulate(parts.begin(), parts.end(), 0) > most_elements_) {
      result_.reached = false;
      return false;
    }
    beam.home = divided(beam, nodes, parts);
    return true;
  }

  static std::vector<HomeNode> divided(const Beam& beam, const std::vector<int>& nodes,
                                       const std::vector<int>& parts) {
    std::vector<HomeNode> home;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const HomeNode &from = beam.home[nodes[i]], &to = beam.home[nodes[i + 1]];
      home.push_back(from);
      for (int k = 1; k < parts[i]; ++k) home.push_back({.s = from.s + (to.s - from.s) * k / parts[i]});
    }
    home.push_back(beam.home.back());
    return home;
  }

  BeamModel& model_;
  const std::vector<std::optional<double>>& tolerances_;
  int most_elements_;
  const std::function<bool()>& interrupted_;
  double time_;
  AdaptedMesh result_;
};

}  // namespace

AdaptedMesh adapt_mesh(BeamModel& model, const std::vector<std::optional<double>>& tolerances,
                       int most_elements, const std::function<bool()>& interrupted, double time) {
  return Adaption(model, tolerances, most_elements, interrupted, time).run();
}

}  // namespace nurbeam
