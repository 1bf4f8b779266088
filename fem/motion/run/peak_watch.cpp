#include "fem/motion/run/peak_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fem/system/observables.h"
#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

// Mean axial strain and curvatures at both ends of the cubic in s through the nodal values of a span.
struct SpanShape {
  double strain, curvature[2];
};
template <int D>
SpanShape shape_of(const double* r_a, const double* t_a, const double* r_b, const double* t_b, double L) {
  double dd = 0, da = 0, db = 0, aa = 0, ab = 0, bb = 0;
  for (int k = 0; k < D; ++k) {
    const double d = (r_b[k] - r_a[k]) / L, a = t_a[k], b = t_b[k];
    dd += d * d;
    da += d * a;
    db += d * b;
    aa += a * a;
    ab += a * b;
    bb += b * b;
  }
  const double squared_stretch = (36 * dd - 6 * (da + db) + 4 * (aa + bb) - 2 * ab) / 30;
  const double start = 36 * dd + 16 * aa + 4 * bb - 48 * da - 24 * db + 16 * ab,
               end = 36 * dd + 4 * aa + 16 * bb - 24 * da - 48 * db + 16 * ab;
  return {(squared_stretch - 1) / 2,
          {std::sqrt(std::max(start, 0.0)) / L, std::sqrt(std::max(end, 0.0)) / L}};
}

// The indicators of one beam, and the energies.
struct OfBeam {
  enum { displacement, tension, compression, bending, stress, count };
};
struct OfEnergy {
  enum { kinetic, axial, bending, count };
};

}  // namespace

void PeakWatch::prepare(const BeamSystem& system, const State& state) {
  system_ = &system;
  const Mesh& mesh = system.mesh();
  beams_.clear();
  for (std::size_t b = 0; b < mesh.nodes.size(); ++b) {
    const Beam& beam = system.model().beams[b];
    BeamSpans& of = beams_.emplace_back(
        BeamSpans{{}, {}, &beam.properties, beam.rigid ? 0 : beam.properties.radius_of_disk()});
    if (beam.rigid) continue;
    for (const MeshNode& node : mesh.nodes[b]) {
      const double s = node.place >= 0 ? state.q[node.place] : node.s;
      of.nodes.emplace_back(node.r, beam.curve.position(s));
    }
    for (int i = mesh.first_span[b]; i < mesh.first_span[b + 1]; ++i) {
      const MeshSpan& span = mesh.spans[i];
      const MeshNode &a = mesh.node_a(span), &e = mesh.node_b(span);
      const double s_a = span.start(state.q), s_b = span.end(state.q);
      const Eigen::Vector3d r_a = beam.curve.position(s_a), r_b = beam.curve.position(s_b),
                            t_a = beam.curve.tangent(s_a), t_b = beam.curve.tangent(s_b, true);
      const SpanShape drawn = shape_of<3>(r_a.data(), t_a.data(), r_b.data(), t_b.data(), s_b - s_a);
      of.spans.push_back({{a.r, e.r},
                          {a.slope_right, e.slope_left},
                          s_b - s_a,
                          drawn.strain,
                          {drawn.curvature[0], drawn.curvature[1]}});
    }
  }
}

template <int D>
void PeakWatch::measure_beam(const BeamSpans& beam, const State& state, double* energies) {
  const double *q = state.q.data(), *v = state.v.data();
  std::array<double, OfBeam::count> largest{};
  for (const auto& [r, drawn] : beam.nodes) {
    double square = 0;
    for (int k = 0; k < D; ++k) square += (q[r + k] - drawn[k]) * (q[r + k] - drawn[k]);
    largest[OfBeam::displacement] = std::max(largest[OfBeam::displacement], square);
  }
  for (const Span& s : beam.spans) {
    const SpanShape shape = shape_of<D>(q + s.r[0], q + s.slope[0], q + s.r[1], q + s.slope[1], s.length);
    const double strain = shape.strain - s.strain, start = std::abs(shape.curvature[0] - s.curvature[0]),
                 end = std::abs(shape.curvature[1] - s.curvature[1]);
    largest[OfBeam::tension] = std::max(largest[OfBeam::tension], strain);
    largest[OfBeam::compression] = std::max(largest[OfBeam::compression], -strain);
    largest[OfBeam::bending] = std::max({largest[OfBeam::bending], start, end});
    largest[OfBeam::stress] =
        std::max(largest[OfBeam::stress], std::abs(strain) + beam.radius * std::max(start, end));
    double squared_speeds = 0;
    for (int k = 0; k < D; ++k)
      squared_speeds += v[s.r[0] + k] * v[s.r[0] + k] + v[s.r[1] + k] * v[s.r[1] + k];
    const BeamProperties& of = *beam.properties;
    energies[OfEnergy::kinetic] += of.mass_per_length * s.length * squared_speeds / 4;
    energies[OfEnergy::axial] += of.small_strain_energy(strain) * s.length;
    energies[OfEnergy::bending] += of.bent_energy(std::hypot(start, end) * s.length, 2 * s.length);
  }
  largest[OfBeam::displacement] = std::sqrt(largest[OfBeam::displacement]);
  now_.insert(now_.end(), largest.begin(), largest.end());
}

void PeakWatch::measure_constraints(const BeamSystem& system, const State& state) {
  const std::size_t first = now_.size(), count = system.model().constraints.size();
  now_.resize(first + 2 * count, 0.0);
  with_assembly(system, [&]<int D>(const Assembly<D>& a) {
    std::vector<Eigen::Vector3d> forces(count, Eigen::Vector3d::Zero()), couples = forces;
    std::size_t i = 0;
    a.for_each_constraint([&](const auto& c, const auto& rows) {
      while (i < count &&
             rows.first >= a.rows_of(static_cast<int>(i)).first + a.rows_of(static_cast<int>(i)).count)
        ++i;
      if (i >= count) return;
      const auto y = state.lambda.segment(rows.first, rows.count);
      if constexpr (offers_of<decltype(c)>.couple)
        couples[i] += c.couple(a.beams(), state, y);
      else if constexpr (offers_of<decltype(c)>.force)
        forces[i] += c.force(y);
      else
        forces[i].head(rows.count) -= y;
    });
    for (std::size_t k = 0; k < count; ++k) {
      now_[first + 2 * k] = forces[k].norm();
      now_[first + 2 * k + 1] = couples[k].norm();
    }
  });
}

void PeakWatch::measure(const BeamSystem& system, const State& state) {
  const BeamModel& model = system.model();
  now_.clear();
  std::array<double, OfEnergy::count> sums{};
  for (const BeamSpans& beam : beams_)
    system.dimension() == 2 ? measure_beam<2>(beam, state, sums.data())
                            : measure_beam<3>(beam, state, sums.data());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double speed = vector_at(system, state.v, system.mesh().bodies[b]).norm();
    const Eigen::Vector3d a = vector_at(system, state.a, system.mesh().bodies[b]);
    now_.push_back(speed);
    now_.push_back((a - model.gravity).norm());
    sums[OfEnergy::kinetic] += model.bodies[b].mass * speed * speed / 2;
  }
  now_.insert(now_.end(), sums.begin(), sums.end());
  for (std::size_t i = 0; i < model.connectors.size(); ++i)
    now_.push_back(std::abs(length_and_force(system, state, static_cast<int>(i)).second));
  measure_constraints(system, state);
}

bool PeakWatch::passes_peak(const BeamSystem& system, const State& after, bool afresh) {
  // Small changes count while snapshots are few: they take longer than a step.
  constexpr double small = 1e-4, large = 0.02;
  constexpr long at_first = 8, steps_each = 400;
  if (system_ != &system || afresh) prepare(system, after);
  std::swap(earlier_, last_);
  std::swap(last_, now_);
  measure(system, after);
  ++steps_;
  best_.resize(now_.size(), 0.0);
  if (afresh || last_.size() != now_.size() || earlier_.size() != now_.size()) {
    last_.assign(now_.size(), 0.0);
    return false;
  }
  const double margin = 1 + (found_ < at_first + steps_ / steps_each ? small : large);
  for (std::size_t i = 0; i < now_.size(); ++i)
    if (last_[i] >= earlier_[i] && last_[i] > now_[i] && last_[i] > margin * best_[i] + 1e-12) {
      for (std::size_t k = 0; k < best_.size(); ++k) best_[k] = std::max(best_[k], last_[k]);
      ++found_;
      return true;
    }
  return false;
}

void PeakWatch::record() {
  best_.resize(now_.size(), 0.0);
  for (std::size_t k = 0; k < now_.size(); ++k) best_[k] = std::max(best_[k], now_[k]);
}

std::vector<double> PeakWatch::numbers() const {
  std::vector<double> numbers{static_cast<double>(steps_), static_cast<double>(found_)};
  for (const auto* each : {&best_, &last_, &now_}) {
    numbers.push_back(static_cast<double>(each->size()));
    numbers.insert(numbers.end(), each->begin(), each->end());
  }
  return numbers;
}

void PeakWatch::go_on_from(const std::vector<double>& numbers) {
  if (numbers.empty()) return;
  auto next = numbers.begin();
  steps_ = static_cast<long>(*next++);
  found_ = static_cast<long>(*next++);
  for (auto* each : {&best_, &last_, &now_}) {
    const auto count = static_cast<std::ptrdiff_t>(*next++);
    each->assign(next, next + count);
    next += count;
  }
}

}  // namespace nurbeam
