#pragma once
#include "pipelines/command/commands.h"

namespace nurbeam {

/// `nurbeam schema study` and `nurbeam study`: become the program nurbeam-study. Throw UsageError, and
/// std::runtime_error where that program is missing.
int study_schema_command();
int study_command_line(const Arguments& arguments, Streams streams);

}  // namespace nurbeam
