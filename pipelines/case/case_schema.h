#pragma once
#include <string>

#include "pipelines/case/case_keys.h"

namespace nurbeam {

/// The JSON schema of files of that shape.
std::string schema_text(const Shape& shape, const std::string& title);

/// The JSON schema of the case file.
std::string case_file_schema();

}  // namespace nurbeam
