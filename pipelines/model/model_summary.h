#pragma once
#include <string>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// As the case file has it.
std::string name_of(CaseAnalysis::Type type);

/// The model as it stood at the start of a run, as a JSON object: dimension, plane_normal (planar models;
/// else null), gravity, and lists of beams, bodies, supports, joints and loads. Keys name the units, vectors
/// are in world coordinates, lengths along a beam in reference arc length. `outward` of a support points away
/// from the beam where it ends there, else against gravity.
std::string model_summary(const CaseFile& case_file, const BuiltModel& built);

}  // namespace nurbeam
