#pragma once
#include <string>

namespace nurbeam {

/// The JSON schema of the case file.
std::string case_file_schema();

}  // namespace nurbeam
