#include "fem/motion/record/element_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace nurbeam {

namespace {

// A cubic by its values at 0, 1/3, 2/3 and 1.
class SampledCubic {
 public:
  explicit SampledCubic(const Eigen::Vector4d& v)
      : c_{v[0], (-11 * v[0] + 18 * v[1] - 9 * v[2] + 2 * v[3]) / 2,
           (18 * v[0] - 45 * v[1] + 36 * v[2] - 9 * v[3]) / 2,
           (-9 * v[0] + 27 * v[1] - 27 * v[2] + 9 * v[3]) / 2} {}

  double at(double x) const { return c_[0] + x * (c_[1] + x * (c_[2] + x * c_[3])); }
  // Calls visit(x) where the cubic is stationary, inside (0, 1).
  template <class Visit>
  void stationary(const Visit& visit) const {
    const double a = 3 * c_[3], b = c_[2], c = c_[1], root = b * b - a * c;
    if (!(root >= 0)) return;
    const double q = -(b + std::copysign(std::sqrt(root), b));
    for (const double x : {q / a, c / q})
      if (x > 0 && x < 1) visit(x);
  }

 private:
  std::array<double, 4> c_;
};

}  // namespace

double ElementExtreme::magnitude(double x) { return std::abs(x); }

void keep(Extreme& extreme, double value, double s, double (*size)(double), std::optional<double> layer) {
  if (std::isnan(value)) return;
  if (std::isnan(extreme.value) || size(value) > size(extreme.value)) extreme = {value, s, layer};
}

double estimated_size(const Eigen::Vector4d& samples, double (*size)(double)) {
  double largest = std::max(size(samples[1]), size(samples[2]));
  const SampledCubic cubic(samples);
  cubic.stationary([&](double x) { largest = std::max(largest, size(cubic.at(x))); });
  return largest;
}

ElementSections::ElementSections(const BeamSystem& system, const State& state, int span,
                                 SpanResultants carried, double twisted)
    : system_(&system),
      state_(&state),
      span_(span),
      carried_(std::move(carried)),
      twisted_(twisted),
      start_(system.mesh().spans[span].start(state.q)),
      end_(system.mesh().spans[span].end(state.q)) {}

double ElementSections::value(const ElementExtreme& of, double x) const {
  const double s = x == 1 ? end_ : place(x);
  const double value = section_at(*system_, *state_, span_, carried_, s).*of.value;
  return of.value == &SectionRecord::twist ? value + twisted_ : value;
}

// Parabolas through three values, ever narrower. A peak is flat: values beside it differ by round-off alone
// where they are closer than the root of round-off, and the narrowest parabola is wider than that.
Peak ElementSections::refined(const ElementExtreme& of, double x, double a, double b) const {
  constexpr double widest = 0.05, narrowest = 1e-4;
  constexpr int most = 40;
  double d = widest * (b - a), best = x;
  for (int i = 0; i < most; ++i) {
    const double m = std::clamp(best, a + d, b - d);
    const double left = of.size(value(of, m - d)), middle = of.size(value(of, m)),
                 right = of.size(value(of, m + d));
    const double bend = left - 2 * middle + right;
    const bool is_peak = bend < 0;
    best = is_peak        ? std::clamp(m + d / 2 * (left - right) / bend, m - d, m + d)
           : left > right ? m - d
                          : m + d;
    if (std::abs(best - m) >= d && best > a && best < b) continue;  // the peak is beyond
    if (!is_peak || d <= narrowest * (b - a)) break;
    d = std::max(d / 8, narrowest * (b - a));
  }
  return {best, value(of, best)};
}

void ElementSections::add_peaks_between(const ElementExtreme& of, double a, double b,
                                        std::vector<Peak>& peaks) const {
  Eigen::Vector4d values;
  for (int i = 0; i < 4; ++i) values[i] = value(of, i == 3 ? b : a + (b - a) * i / 3);
  peaks.push_back({a, values[0]});
  SampledCubic(values).stationary([&](double x) { peaks.push_back(refined(of, a + x * (b - a), a, b)); });
  peaks.push_back({b, values[3]});
}

std::vector<Peak> ElementSections::peaks(const ElementExtreme& of) const {
  constexpr double beside = 1e-9;  // of the element's length
  std::vector<double> cuts;
  for (const SpanResultants::Inside& each : carried_.inside())
    cuts.push_back((each.action.s - start_) / (end_ - start_));
  std::sort(cuts.begin(), cuts.end());
  std::vector<Peak> peaks;
  double a = 0;
  for (const double cut : cuts) {
    if (cut - beside > a) add_peaks_between(of, a, cut - beside, peaks);
    a = cut;
  }
  add_peaks_between(of, a, 1, peaks);
  return peaks;
}

BeamExtremes::BeamExtremes(const BeamSystem& system, const State& state, const CarriedBySpans& carried,
                           int beam)
    : system_(system), state_(state), carried_(carried), beam_(beam) {}

void BeamExtremes::look_at(const std::vector<ElementRecord>& elements, int first) {
  const ReferenceCurve& curve = system_.model().beams[beam_].curve;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ElementRecord& e = elements[i];
    const int span = first + static_cast<int>(i);
    const bool has_torsion = !std::isnan(e.twist[0]);
    std::optional<ElementSections> sections;
    if (carried_.has_actions(span)) sections.emplace(system_, state_, span, carried_[span], twisted_);
    for (std::size_t k = 0; k < kinds; ++k) {
      const ElementExtreme& of = element_extremes[k];
      if (of.of_torsion && !has_torsion) continue;
      const Eigen::Vector4d& samples = e.*of.samples;
      if (samples.hasNaN()) continue;
      keep(found_[k], samples[0], curve.wrapped(e.s_start), of.size);
      keep(found_[k], samples[3], curve.wrapped(e.s_end), of.size);
      if (sections)
        look_inside(*sections, k);
      else
        put_aside(candidates_[k], {span, twisted_, estimated_size(samples, of.size)});
    }
    if (has_torsion) twisted_ = e.twist[3];
  }
}

// The list stays in falling order.
void BeamExtremes::put_aside(std::array<Candidate, most>& list, const Candidate& candidate) {
  if (std::isnan(candidate.size)) return;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].span < 0 || candidate.size > list[i].size) {
      std::move_backward(list.begin() + i, list.end() - 1, list.end());
      list[i] = candidate;
      return;
    }
}

void BeamExtremes::look_inside(const ElementSections& sections, std::size_t kind) {
  const ElementExtreme& of = element_extremes[kind];
  const ReferenceCurve& curve = system_.model().beams[beam_].curve;
  for (const Peak& peak : sections.peaks(of))
    keep(found_[kind], peak.value, curve.wrapped(sections.place(peak.x)), of.size);
}

void BeamExtremes::finish(BeamRecord& record) {
  constexpr double round_off = 1e-9;
  for (std::size_t k = 0; k < kinds; ++k) {
    for (const Candidate& each : candidates_[k]) {
      const double size = element_extremes[k].size(found_[k].value);
      if (each.span >= 0 && each.size > size + round_off * std::abs(size))
        look_inside({system_, state_, each.span, carried_[each.span], each.twisted}, k);
    }
    record.*element_extremes[k].extreme = found_[k];
  }
}

}  // namespace nurbeam
