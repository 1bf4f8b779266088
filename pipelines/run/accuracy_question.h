#pragma once
#include <vector>

#include "pipelines/accuracy/accuracy_table.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// What is asked of the errors of a case, with what they depend on in its model.
AccuracyQuestion accuracy_question(const CaseFile& case_file, const BuiltModel& built);

/// Whether elements are smooth where something pulls at the inside of a beam, and its axial force jumps.
bool has_jumps_inside(const BuiltModel& built);

/// Errors of what is asked for that is no number of the case, with the nearest one; empty where all is.
std::vector<Diagnostic> unknown_in_accuracy(const CaseFile& case_file, const BuiltModel& built);

}  // namespace nurbeam
