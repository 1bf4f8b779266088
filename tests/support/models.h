#pragma once
#include "pipelines/verification/verify_models.h"

/// The models of the verification problems, under the name the tests know them by.
namespace nurbeam::testing {

using verification::add_slider;
using verification::arc_cubics;
using verification::line_cubic;
using verification::one_beam;
using verification::round_bar;

}  // namespace nurbeam::testing
