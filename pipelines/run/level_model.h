#pragma once
#include <optional>

#include "pipelines/model/build_model.h"

namespace nurbeam {

/// Divides each element of a beam in two.
void halve_elements(Beam& beam);

/// A model with 2^level times the elements of another, which keep its grading and its nodes at what holds or
/// loads a beam. Nothing where a beam would have more than `most_elements`, or no element between two nodes
/// that stay.
std::optional<BeamModel> model_at_level(const BeamModel& model, int level);

/// The same of a case, whose kinks that have become fine are smooth. Nothing too where a beam has fewer than
/// six elements of which to take half, or eight of which to take a quarter.
std::optional<BuiltModel> at_level(const BuiltModel& built, int level);

/// The elements of all beams.
long element_count(const BeamModel& model);

}  // namespace nurbeam
