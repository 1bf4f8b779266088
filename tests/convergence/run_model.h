#pragma once
#include <gtest/gtest.h>

#include "pipelines/verification/verify_run.h"

/// The runs of the verification problems, under the name the tests know them by; a run that ends early
/// throws.
namespace nurbeam::testing {

using verification::even_times;
using verification::run_model;
using verification::RunRecord;

}  // namespace nurbeam::testing
