#pragma once
#include "pipelines/command/commands.h"

namespace nurbeam {

/// `nurbeam convert`: the curves of a file written to another one.
Command convert_entry();

/// `nurbeam transform`: the same, moved, turned, scaled and mirrored.
Command transform_entry();

}  // namespace nurbeam
