#pragma once
#include "pipelines/case/case_keys.h"

namespace nurbeam {

/// The study file.
const Shape& study_keys();

}  // namespace nurbeam
