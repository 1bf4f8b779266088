#pragma once
#include <utility>

#include "pipelines/model/features.h"

namespace nurbeam::verification {

/// The features of all models and analyses noted on this thread since the last call.
Features take_noted();

void note(const Features& features);

/// The model, whose features are noted; for those that a problem computes with.
template <class Model>
Model&& noted(Model&& model) {
  note(features_of(model));
  return std::forward<Model>(model);
}
/// The same with the options of its analysis.
template <class Model, class Options>
Model&& noted(Model&& model, const Options& options) {
  note(features_of(options));
  return noted(std::forward<Model>(model));
}
inline const SimulationOptions as_statics{.statics = true};

}  // namespace nurbeam::verification
