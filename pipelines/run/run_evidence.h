#pragma once
#include <vector>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"
#include "pipelines/results/evidence.h"

namespace nurbeam {

/// The evidence that the known answers of `nurbeam verify` are for a case and its model.
std::vector<FeatureEvidence> run_evidence(const CaseFile& case_file, const BuiltModel& built);

}  // namespace nurbeam
