#include "fem/motion/record/held_extremes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fem/system/bending_layers.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Values that differ by less than this part count as one extreme, as in a symmetrical shape.
bool are_equal(double value, double extreme) { return std::abs(value - extreme) <= 1e-6 * std::abs(extreme); }

bool is_shared_by_many(std::size_t places) { return places > 2; }

const ElementExtreme& of_elements(Extreme BeamRecord::*extreme) {
  return *std::find_if(
      std::begin(element_extremes), std::end(element_extremes),
      [&](const ElementExtreme& each) { return each.extreme == extreme; });
}

// Whether an element may have a value as large as the extreme, by its samples.
bool may_have(const ElementRecord& element, const ElementExtreme& of, double extreme) {
  constexpr double estimate = 0.01;
  const Eigen::Vector4d& samples = element.*of.samples;
  if (samples.hasNaN()) return false;
  const double size = of.size(extreme);
  return std::max({of.size(samples[0]), of.size(samples[3]), estimated_size(samples, of.size)}) >=
         size - estimate * std::abs(size);
}

// The places of an element that have the extreme, in order, and the ends, thirds and the middle of one with
// an even value.
std::vector<double> places_in(const ElementSections& sections, const ElementExtreme& of, double extreme) {
  std::vector<double> places;
  const auto has = [&](double x) { return are_equal(sections.value(of, x), extreme); };
  const bool even = has(0) && has(1) && has(0.5);
  if (even) places = {0, 1. / 3, 0.5, 2. / 3, 1};
  for (const Peak& peak : sections.peaks(of)) {
    const auto beside = [&](double x) { return std::abs(x - peak.x) < 1e-4; };
    if (are_equal(peak.value, extreme) && std::none_of(places.begin(), places.end(), beside))
      places.push_back(peak.x);
  }
  std::sort(places.begin(), places.end());
  return places;
}

ElementSections sections_of(const BeamSystem& system, const State& state, const CarriedBySpans& carried,
                            int span) {
  return {system, state, span, carried[span], twist_before(system, state, span)};
}

std::vector<LayerRecord> layers_of(const BeamSystem& system, const State& state, int beam) {
  return bending_layers(system, state, CarriedBySpans(system, state), beam).layers;
}

double value_of(const LayerRecord& layer, Extreme BeamRecord::*extreme) {
  if (extreme == &BeamRecord::moment_max) return layer.moment;
  return extreme == &BeamRecord::stress_max ? layer.stress : layer.von_mises;
}

}  // namespace

HeldExtremes::HeldExtremes(const BeamSystem& system, const State& state, const std::vector<BeamPart>& parts) {
  const std::vector<BeamRecord> records = record_beams(system, state);
  const CarriedBySpans carried(system, state);
  for (const BeamPart& part : parts) {
    Held& held = held_.emplace_back(Held{part});
    const BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) continue;
    const int first = system.mesh().first_span[part.beam];
    if (!part.extreme) {
      const int lowest = first + lowest_element(record.elements, system.model().gravity);
      held.lowest = sag_near(system, state, part.beam, lowest);
      continue;
    }
    if ((record.*part.extreme).layer) {
      const std::vector<LayerRecord> layers = layers_of(system, state, part.beam);
      for (int i = 0; i < static_cast<int>(layers.size()); ++i)
        if (value_of(layers[i], part.extreme) == (record.*part.extreme).value) held.layer = i;
      continue;
    }
    const ElementExtreme& of = of_elements(part.extreme);
    const double extreme = (record.*part.extreme).value;
    for (int i = 0; i < static_cast<int>(record.elements.size()); ++i) {
      const int span = first + i;
      if (!carried.has_actions(span) && !may_have(record.elements[i], of, extreme)) continue;
      for (const double x : places_in(sections_of(system, state, carried, span), of, extreme))
        hold({span, x}, held.places);
    }
    if (held.places.empty() && !std::isnan(extreme))
      hold_place((record.*part.extreme).s, record.elements, first, held.places);
  }
}

// Where values differ by round-off alone, none may be found again.
void HeldExtremes::hold_place(double s, const std::vector<ElementRecord>& elements, int first,
                              std::vector<SamePlace>& places) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double start = elements[i].s_start, end = elements[i].s_end;
    if (s < start || s > end) continue;
    return hold({first + static_cast<int>(i), (s - start) / (end - start)}, places);
  }
}

// The end of an element and the start of the next are one place.
void HeldExtremes::hold(const Place& place, std::vector<SamePlace>& places) {
  if (!places.empty()) {
    const Place& last = places.back().back();
    if (place.x == 0 && last.span + 1 == place.span && last.x == 1) return places.back().push_back(place);
  }
  places.push_back({place});
}

bool HeldExtremes::are_shared_by_many() const {
  return std::any_of(
      held_.begin(), held_.end(), [](const Held& held) { return is_shared_by_many(held.places.size()); });
}

template <class Value>
Extreme HeldExtremes::value_at(const std::vector<SamePlace>& places, double (*size)(double),
                               const Value& value) {
  Extreme greatest;
  double sum = 0;
  for (const SamePlace& place : places) {
    double here = 0;
    for (const Place& each : place) {
      const double of_each = value(each);
      keep(greatest, of_each, 0, size);
      here += of_each;
    }
    sum += here / static_cast<double>(place.size());
  }
  if (!places.empty() && !is_shared_by_many(places.size()))
    greatest.value = sum / static_cast<double>(places.size());
  return greatest;
}

std::vector<BeamRecord> HeldExtremes::at(const BeamSystem& system, const State& state) const {
  std::vector<BeamRecord> records(system.model().beams.size());
  const CarriedBySpans carried(system, state);
  for (const Held& held : held_) {
    const BeamPart& part = held.part;
    BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) {
      record = record_beam(system, state, part.beam);
    } else if (!part.extreme) {
      record.length = beam_length(system, state, part.beam);
      record.sag = sag_at(system, state, part.beam, held.lowest);
    } else if (held.layer >= 0) {
      const LayerRecord layer = layers_of(system, state, part.beam).at(held.layer);
      record.*part.extreme = {value_of(layer, part.extreme), layer.s, layer.reach};
    } else {
      const ElementExtreme& of = of_elements(part.extreme);
      record.*part.extreme = value_at(held.places, of.size, [&](const Place& at) {
        return sections_of(system, state, carried, at.span).value(of, at.x);
      });
    }
  }
  return records;
}

}  // namespace nurbeam
