#include "fem/motion/run/peak_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fem/motion/record/adrift.h"
#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

struct OfEnergy {
  enum { kinetic, axial, bending, count };
};

double place_of(const MeshNode& node, const State& state) {
  return node.place >= 0 ? state.q[node.place] : node.s;
}

// Whether a value of an indicator is larger by more than round-off.
bool exceeds(double value, double than) { return value > (1 + 1e-9) * than; }

}  // namespace

void PeakWatch::prepare(const BeamSystem& system, const State& state) {
  const Mesh& mesh = system.mesh();
  beams_.clear();
  for (std::size_t b = 0; b < mesh.nodes.size(); ++b) {
    const Beam& beam = system.model().beams[b];
    WatchedBeam& of = beams_.emplace_back(WatchedBeam{&beam, {}, {}, 0});
    if (beam.rigid) continue;
    of.radius = beam.properties.radius_of_disk();
    of.spans = SpanShapes(beam, mesh, static_cast<int>(b), state);
    for (const MeshNode& node : mesh.nodes[b]) {
      const double s = place_of(node, state);
      of.nodes.push_back({&node, beam.curve.position(s)});
    }
    for (int i = mesh.first_span[b]; i < mesh.first_span[b + 1]; ++i)
      for (const int node : {mesh.spans[i].node_a, mesh.spans[i].node_b})
        of.nodes[node].length += (mesh.spans[i].s_b - mesh.spans[i].s_a) / 2;
  }
  adrift_ = bodies_adrift(system, state);
  rows_.clear();
  const int constraints = static_cast<int>(system.model().constraints.size());
  if (constraints == 0) return;
  with_assembly(system, [&](const auto& assembly) {
    const auto [first, count] = assembly.rows_of(constraints - 1);
    assembly.for_each_constraint([&, end = first + count](const auto&, const auto& rows) {
      if (rows.first < end) rows_.emplace_back(rows.first, rows.count);
    });
  });
}

Eigen::Vector3d PeakWatch::drawn_near(const Beam& beam, double s, Node& node) {
  const double near = near_place(beam, s);
  if (near != node.s) {
    node.s = near;
    node.drawn = beam.curve.position(near);
    node.tangent = beam.curve.tangent(near);
  }
  return node.drawn + (s - near) * node.tangent;
}

template <int D>
void PeakWatch::measure_beam(WatchedBeam& watched, const State& state, double* energies) {
  const Beam& beam = *watched.beam;
  double displacement = 0, speeds = 0;
  for (Node& each : watched.nodes) {
    const MeshNode* node = each.node;
    const Eigen::Vector3d drawn = node->place < 0 ? each.drawn : drawn_near(beam, state.q[node->place], each);
    const double *r = state.q.data() + node->r, *v = state.v.data() + node->r;
    double square = 0, speed = 0;
    for (int k = 0; k < D; ++k) {
      square += (r[k] - drawn[k]) * (r[k] - drawn[k]);
      speed += v[k] * v[k];
    }
    displacement = std::max(displacement, square);
    speeds += speed * each.length;
  }
  const ShapeExtremes of = watched.spans.extremes<D>(beam, state, watched.radius);
  for (const double each : {std::sqrt(displacement), of.tension, of.compression, of.bending, of.stress})
    now_.push_back(each);
  energies[OfEnergy::kinetic] += beam.properties.mass_per_length * speeds / 2;
  energies[OfEnergy::axial] += beam.properties.small_strain_energy(1) * of.squared_strain;
  energies[OfEnergy::bending] += beam.properties.bent_energy(1, 1) * of.squared_bending;
}

void PeakWatch::measure(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  now_.clear();
  std::array<double, OfEnergy::count> sums{};
  for (WatchedBeam& beam : beams_)
    system.dimension() == 2 ? measure_beam<2>(beam, state, sums.data())
                            : measure_beam<3>(beam, state, sums.data());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (adrift_[b]) {
      now_.insert(now_.end(), 2, 0.0);
      continue;
    }
    const double speed = vector_at(system, state.v, system.mesh().bodies[b]).norm();
    const Eigen::Vector3d a = vector_at(system, state.a, system.mesh().bodies[b]);
    now_.push_back(speed);
    now_.push_back((a - model.gravity).norm());
    sums[OfEnergy::kinetic] += model.bodies[b].mass * speed * speed / 2;
  }
  now_.insert(now_.end(), sums.begin(), sums.end());
  for (std::size_t i = 0; i < model.connectors.size(); ++i)
    now_.push_back(std::abs(length_and_force(system, state, static_cast<int>(i)).second));
  for (const auto& [first, count] : rows_) now_.push_back(state.lambda.segment(first, count).norm());
}

bool PeakWatch::passes_peak(const std::shared_ptr<const BeamSystem>& system, const State& after,
                            bool afresh) {
  if (system_ != system || afresh) {
    system_ = system;
    prepare(*system, after);
  }
  std::swap(earlier_, last_);
  std::swap(last_, now_);
  measure(*system, after);
  ++steps_;
  best_.resize(now_.size(), 0.0);
  top_.resize(now_.size(), 0.0);
  if (afresh || last_.size() != now_.size() || earlier_.size() != now_.size()) {
    last_.assign(now_.size(), 0.0);
    return false;
  }
  for (std::size_t i = 0; i < now_.size(); ++i)
    if (last_[i] >= earlier_[i] && last_[i] > now_[i] && exceeds(last_[i], top_[i])) return true;
  return false;
}

void PeakWatch::keep(PeakMoment moment) {
  moment.indicators = last_;
  kept_.push_back(std::move(moment));
  for (std::size_t i = 0; i < top_.size(); ++i) top_[i] = std::max(top_[i], last_[i]);
  drop_surpassed();
}

void PeakWatch::drop_surpassed() {
  std::erase_if(
      kept_,
      [&](const PeakMoment& each) {
        for (std::size_t i = 0; i < top_.size(); ++i)
          if (each.indicators[i] >= top_[i] && exceeds(each.indicators[i], best_[i])) return false;
        return true;
      });
}

bool PeakWatch::is_full() const {
  constexpr std::size_t most = 8;
  return kept_.size() > most;
}

void PeakWatch::record() {
  best_.resize(now_.size(), 0.0);
  top_.resize(now_.size(), 0.0);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    best_[i] = std::max(best_[i], now_[i]);
    top_[i] = std::max(top_[i], now_[i]);
  }
  drop_surpassed();
}

std::vector<PeakMoment> PeakWatch::take_notable() {
  // Small changes count while snapshots are few.
  constexpr double small = 1e-4, large = 0.02;
  constexpr long at_first = 8, steps_each = 400;
  std::vector<PeakMoment> taken;
  for (PeakMoment& each : std::exchange(kept_, {})) {
    const double margin = found_ < at_first + steps_ / steps_each ? small : large;
    bool counts = false;
    for (std::size_t i = 0; i < best_.size() && !counts; ++i)
      counts = exceeds(each.indicators[i], (1 + margin) * best_[i]);
    if (!counts) continue;
    for (std::size_t i = 0; i < best_.size(); ++i) best_[i] = std::max(best_[i], each.indicators[i]);
    taken.push_back(std::move(each));
    ++found_;
  }
  top_ = best_;
  return taken;
}

std::vector<double> PeakWatch::numbers() const {
  std::vector<double> numbers{static_cast<double>(steps_), static_cast<double>(found_),
                              static_cast<double>(kept_.size())};
  const auto add = [&](const auto& list) {
    numbers.push_back(static_cast<double>(list.size()));
    numbers.insert(numbers.end(), list.begin(), list.end());
  };
  for (const auto* each : {&best_, &top_, &last_, &now_}) add(*each);
  for (const auto& [state, step, account, indicators] : kept_) {
    for (const double each :
         {step, account.dissipated(), account.input(), state.t, state.load, state.stabilisation})
      numbers.push_back(each);
    for (const auto* each : {&state.q, &state.v, &state.a, &state.lambda, &state.memory, &state.sides})
      add(*each);
    add(indicators);
  }
  return numbers;
}

void PeakWatch::go_on_from(const std::vector<double>& numbers,
                           const std::shared_ptr<const BeamSystem>& system, const State& state) {
  if (numbers.empty()) return;
  system_ = system;
  prepare(*system, state);
  auto next = numbers.begin();
  const auto take = [&](auto& list) {
    const auto count = static_cast<std::ptrdiff_t>(*next++);
    list.resize(count);
    std::copy_n(next, count, list.begin());
    next += count;
  };
  steps_ = static_cast<long>(*next++);
  found_ = static_cast<long>(*next++);
  kept_.resize(static_cast<std::size_t>(*next++));
  for (auto* each : {&best_, &top_, &last_, &now_}) take(*each);
  for (auto& [of, step, account, indicators] : kept_) {
    step = *next++;
    account = EnergyAccount(next[0], next[1], 0);
    next += 2;
    for (double* each : {&of.t, &of.load, &of.stabilisation}) *each = *next++;
    for (auto* each : {&of.q, &of.v, &of.a, &of.lambda, &of.memory, &of.sides}) take(*each);
    take(indicators);
  }
}

}  // namespace nurbeam
