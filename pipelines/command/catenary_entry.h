#pragma once
#include "pipelines/command/commands.h"

namespace nurbeam {

/// `nurbeam catenary`: the case file of an overhead contact line, from its data.
Command catenary_entry();

}  // namespace nurbeam
