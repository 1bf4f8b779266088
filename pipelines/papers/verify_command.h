#pragma once
#include "pipelines/command/verify.h"

namespace nurbeam {

/// `nurbeam verify [NAME | papers]`: the table of the problems whose name holds NAME, or the page of the
/// papers. Throws UsageError where no problem has that name.
int verify_command(const Arguments& arguments, Streams streams);

}  // namespace nurbeam
