#pragma once
#include "pipelines/case/case_json.h"

namespace nurbeam {

/// Checks a value against its shape, turns every quantity into a number in SI units, and makes what is
/// unusable null (it has been reported), so that what is left can be checked further. Returns whether the
/// value is usable.
bool check_shape(const Shape& shape, Json& value, Findings& findings);

/// The same of a value that may become whole later, and whose files are not read: what it lacks is no error.
bool check_part(const Shape& shape, Json& value, Findings& findings);

}  // namespace nurbeam
