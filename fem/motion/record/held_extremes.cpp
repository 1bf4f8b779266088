#include "fem/motion/record/held_extremes.h"

#include <algorithm>
#include <iterator>

#include "fem/motion/record/beam_extremes.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Values that differ by less than this part count as one extreme, as in a symmetrical shape.
bool are_equal(double value, double extreme) { return std::abs(value - extreme) <= 1e-6 * std::abs(extreme); }

constexpr int samples = 4;  // of an element, from end to end

bool is_shared_by_many(std::size_t places) { return places > 2; }

double node_displacement(const BeamSystem& system, const State& state, int beam, int node) {
  const ReferenceCurve& curve = system.model().beams[beam].curve;
  const MeshNode& of = system.mesh().nodes[beam][node];
  return displacement(curve, vector_at(system, state.q, of.r), place_of(curve, of, state));
}

const ElementExtreme& of_elements(Extreme BeamRecord::*extreme) {
  return *std::find_if(
      std::begin(element_extremes), std::end(element_extremes),
      [&](const ElementExtreme& each) { return each.extreme == extreme; });
}

double value_in(const BeamSystem& system, const State& state, int span, int sample,
                Extreme BeamRecord::*extreme) {
  const ElementRecord element = record_element(system, state, span, CarriedBySpans(system, state)[span]);
  const double value = (element.*of_elements(extreme).values)[sample];
  return extreme == &BeamRecord::twist_max ? value + twist_before(system, state, span) : value;
}

}  // namespace

HeldExtremes::HeldExtremes(const BeamSystem& system, const State& state, const std::vector<BeamPart>& parts) {
  const std::vector<BeamRecord> records = record_beams(system, state);
  for (const BeamPart& part : parts) {
    Held& held = held_.emplace_back(Held{part});
    std::vector<SamePlace>& places = held.places;
    const BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) continue;
    const int first = system.mesh().first_span[part.beam], count = static_cast<int>(record.elements.size());
    if (!part.extreme) {
      const int lowest = first + lowest_element(record.elements, system.model().gravity);
      held.lowest = sag_near(system, state, part.beam, lowest);
    } else if (part.extreme == &BeamRecord::displacement_max) {
      for (int i = 0; i < static_cast<int>(record.node_s.size()); ++i)
        if (are_equal(node_displacement(system, state, part.beam, i), record.displacement_max.value))
          places.push_back({{i}});
    } else {
      const auto values = of_elements(part.extreme).values;
      const auto has = [&](int i, int sample) {
        return are_equal((record.elements[i].*values)[sample], (record.*part.extreme).value);
      };
      for (int i = 0; i < count; ++i)
        for (int sample = 0; sample < samples; ++sample) {
          if (!has(i, sample)) continue;
          if (i > 0 && sample == 0 && has(i - 1, samples - 1))
            places.back().push_back({first + i, sample});
          else
            places.push_back({{first + i, sample}});
        }
    }
  }
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
  for (const Held& held : held_) {
    const BeamPart& part = held.part;
    BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) {
      record = record_beam(system, state, part.beam);
    } else if (!part.extreme) {
      record.length = beam_length(system, state, part.beam);
      record.sag = sag_at(system, state, part.beam, held.lowest);
    } else if (part.extreme == &BeamRecord::displacement_max) {
      record.displacement_max = value_at(
          held.places, ElementExtreme::itself,
          [&](const Place& at) { return node_displacement(system, state, part.beam, at.index); });
    } else {
      record.*part.extreme = value_at(
          held.places, of_elements(part.extreme).size,
          [&](const Place& at) { return value_in(system, state, at.index, at.sample, part.extreme); });
    }
  }
  return records;
}

}  // namespace nurbeam
