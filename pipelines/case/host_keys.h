#pragma once
#include "pipelines/case/case_values.h"

namespace nurbeam {

/// The case as a program makes it in memory: the keys of the case file, and "laws", forces by functions of
/// the program, each known by its place in that list; "motion_law" of supports and sliding joints, the number
/// of a function that prescribes the motion.
const Shape& host_keys();

/// The laws of a case that has been checked against host_keys().
std::vector<CaseLaw> read_laws(const Json& json);

}  // namespace nurbeam
