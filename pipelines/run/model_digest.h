#pragma once
#include <string>
#include <vector>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// What makes the model of a case, without what is asked of it: a line for each part, its key and a digest.
std::string model_digest(const CaseFile& c, const BuiltModel& built);

/// The keys of the parts by which two digests differ.
std::vector<std::string> differing_parts(const std::string& a, const std::string& b);

/// The text of a case without what it asks of errors, on which no result depends.
std::string text_without_accuracy(const CaseFile& c);

}  // namespace nurbeam
