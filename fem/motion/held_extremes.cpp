#include "fem/motion/held_extremes.h"

#include <algorithm>
#include <iterator>

#include "fem/motion/beam_extremes.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Values that are equal but for this part of them count as one extreme: those of a shape that is symmetrical.
bool are_equal(double value, double extreme) { return std::abs(value - extreme) <= 1e-6 * std::abs(extreme); }

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
    std::vector<Place>& places = held.places;
    const BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) continue;
    const int first = system.mesh().first_span[part.beam], count = static_cast<int>(record.elements.size());
    if (!part.extreme) {
      const int lowest = first + lowest_element(record.elements, system.model().gravity);
      held.lowest = sag_near(system, state, part.beam, lowest);
    } else if (part.extreme == &BeamRecord::displacement_max) {
      for (int i = 0; i < static_cast<int>(record.node_s.size()); ++i)
        if (are_equal(node_displacement(system, state, part.beam, i), record.displacement_max.value))
          places.push_back({i});
    } else {
      const auto values = of_elements(part.extreme).values;
      for (int i = 0; i < count; ++i)
        for (int sample = 0; sample < 4; ++sample)
          if (are_equal((record.elements[i].*values)[sample], (record.*part.extreme).value))
            places.push_back({first + i, sample});
    }
  }
}

bool HeldExtremes::are_shared() const {
  return std::any_of(
      held_.begin(), held_.end(),
      [](const Held& held) {
        return std::any_of(
            held.places.begin(), held.places.end(),
            [&](const Place& place) { return place.index != held.places.front().index; });
      });
}

std::vector<BeamRecord> HeldExtremes::at(const BeamSystem& system, const State& state) const {
  std::vector<BeamRecord> records(system.model().beams.size());
  for (const auto& [part, places, lowest] : held_) {
    BeamRecord& record = records[part.beam];
    if (system.model().beams[part.beam].rigid) {
      record = record_beam(system, state, part.beam);
    } else if (!part.extreme) {
      record.length = beam_length(system, state, part.beam);
      record.sag = sag_at(system, state, part.beam, lowest);
    } else if (part.extreme == &BeamRecord::displacement_max) {
      for (const Place& place : places)
        keep(record.displacement_max, node_displacement(system, state, part.beam, place.index), 0,
             ElementExtreme::itself);
    } else {
      for (const auto& [span, sample] : places)
        keep(record.*part.extreme, value_in(system, state, span, sample, part.extreme), 0,
             of_elements(part.extreme).size);
    }
  }
  return records;
}

}  // namespace nurbeam
