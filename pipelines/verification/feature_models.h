#pragma once
#include <string>
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam::verification {

/// A model with one feature of the mechanics beside the beam at work, to hold laws against.
struct FeatureModel {
  std::string name;      ///< one word
  std::string measures;  ///< curvature, strain and stress-free state of its beams
  BeamModel model;
  double end, step;       ///< of a motion that is resolved [s]
  double most_departure;  ///< of the total energy, over the energy that moves, with that step [-]
};

/// Guides; friction that slides, sticks, brakes and resists at kinks; drag in still air and in wind; stops
/// and buffers; springs, ropes, dampers and rods; bodies that hang, or slide on two beams; tension, weights
/// at ends, lumped masses and damping.
std::vector<FeatureModel> feature_models();

}  // namespace nurbeam::verification
