#pragma once
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam::testing {

/// Axial laws other than Green's, each without a jump of its second derivative at strains from -0.9 to 3.
inline std::vector<AxialLaw> other_laws() {
  return {HookeLaw(), ForceOverStretch({{-0.95, -900}, {-0.9, -450}, {3, 700}})};
}

/// The model with its beams of another law.
inline BeamModel with_law(BeamModel model, const AxialLaw& law) {
  for (Beam& beam : model.beams) beam.properties.law = law;
  return model;
}

}  // namespace nurbeam::testing
