#include "fem/motion/rest/adapted_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "fem/material/bending_layer.h"
#include "fem/motion/rest/resting_place.h"
#include "fem/system/bending_layers.h"
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

/// A kink, or a clamp, that stands for a layer of bending. It moves what is beside it by half its angle times
/// the reach of the layer, and has the length of the shorter element beside it.
struct Kink {
  double s, reach, offset, element;  ///< [m]

  /// A slope that is one on both sides misses this part of the offset at most (cubic elements of length l on
  /// a taut beam, (l/reach)^4 for short ones).
  static constexpr double of_smooth = 6.4e-4;
  static constexpr double longest_smooth = 16;  ///< in reaches; a kink costs less where elements are longer

  /// By the slope that is less wrong [m].
  double error() const {
    const double l = element / reach;
    return l < longest_smooth ? offset * std::min(1.0, of_smooth * std::pow(l, 4)) : offset;
  }
  /// The longest element with a part of the offset [m].
  double element_for(double allowed) const {
    return reach * std::pow(std::min(1.0, allowed / offset) / of_smooth, 0.25);
  }
};

std::vector<Kink> kinks_of(const MeshedState& at, int b) {
  const BeamSystem& system = *at.system;
  const Beam& beam = system.model().beams[b];
  const double EI = std::pow(bending_reach(beam.properties, 1), 2);
  std::vector<Kink> kinks;
  for (const LayerRecord& layer :
       bending_layers(system, at.state, CarriedBySpans(system, at.state), b).layers)
    if (layer.reach > 0)
      kinks.push_back({layer.s, layer.reach, std::abs(layer.moment) * layer.reach * layer.reach / EI,
                       beam.home_spacing(layer.s)});
  return kinks;
}

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
    double error = 0, spread = 0, of_kinks = 0;
    for (const Interval& interval : now) {
      error += interval.error;
      spread += interval.elements * std::pow(interval.error / interval.elements, 0.2);
    }
    const std::vector<Kink> kinks = result_.from_equilibrium ? kinks_of(at, b) : std::vector<Kink>{};
    for (const Kink& kink : kinks) of_kinks += kink.error() / beam.curve.length();
    result_.error = std::max(result_.error, error + of_kinks);
    if (error + of_kinks <= *tolerances_[b]) return false;
    constexpr double margin = 0.9;  // part of the tolerance, as the next estimate differs a little
    const double left = margin * *tolerances_[b] - std::min(of_kinks, *tolerances_[b] / 2);
    const double density = std::pow(spread / left, 0.25);
    std::vector<int> parts;
    for (const Interval& interval : now) parts.push_back(interval.elements_for(density));
    if (of_kinks > *tolerances_[b] / 2) resolve(kinks, beam, nodes, *tolerances_[b], parts);
    if (std::accumulate(parts.begin(), parts.end(), 0) > most_elements_ || !has_grown(parts, now)) {
      result_.reached = false;
      return false;
    }
    beam.home = divided(beam, nodes, parts);
    return true;
  }

  // Gives the elements beside kinks the length at which all of them take a third of the tolerance.
  static void resolve(const std::vector<Kink>& kinks, const Beam& beam, const std::vector<int>& nodes,
                      double tolerance, std::vector<int>& parts) {
    const double allowed = tolerance / 3 * beam.curve.length() / static_cast<double>(kinks.size());
    for (const Kink& kink : kinks)
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const double from = beam.home_place(nodes[i]), to = beam.home_place(nodes[i + 1]);
        const double beside = 1e-9 * beam.curve.length();
        if (kink.error() <= allowed || kink.s < from - beside || kink.s > to + beside) continue;
        const double wanted = std::ceil((to - from) / kink.element_for(allowed));
        parts[i] = std::max(parts[i], static_cast<int>(std::min(wanted, 1e6)));
      }
  }

  static bool has_grown(const std::vector<int>& parts, const std::vector<Interval>& now) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i] > now[i].elements) return true;
    return false;
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
