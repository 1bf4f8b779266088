#include "pipelines/results/layer_checks.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

void HighStress::look_at(const Snapshot& frame, const BeamModel& model) {
  constexpr double borne = 1.0 / 50;  // of Young's modulus
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    const Extreme& stress = frame.beams[b].stress_max;
    const double limit = borne * model.beams[b].material.youngs_modulus;
    if (!(limit > 0) || !(std::abs(stress.value) > std::max(limit, std::abs(value)))) continue;
    *this = {stress.value, model.beams[b].material.youngs_modulus, model.beams[b].name, stress.s, frame.time,
             stress.layer};
  }
}

void SlackKink::look_at(const Snapshot& frame, const BeamModel& model) {
  for (std::size_t b = 0; b < frame.beams.size() && beam.empty(); ++b)
    if (frame.beams[b].slack_kink) *this = {model.beams[b].name, *frame.beams[b].slack_kink, frame.time};
}

}  // namespace nurbeam
