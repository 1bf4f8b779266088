#pragma once
#include "pipelines/case/case_values.h"

namespace nurbeam {

/// The case as a program makes it in memory: the keys of the case file, and "laws", forces by functions of
/// the program. A function is known by its place in that list.
const Shape& host_keys();

/// The laws of a case that has been checked against host_keys().
std::vector<CaseLaw> read_laws(const Json& json);

}  // namespace nurbeam
