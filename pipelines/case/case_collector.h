#pragma once
#include "pipelines/case/case_file.h"
#include "pipelines/case/case_json.h"

/// Private to the reader of case files.
namespace nurbeam {

CaseCollector read_collector(const Json& json, const std::string& path, Findings& findings);

/// Holds the collectors of a whole case to the analysis and to the probes that they name.
void check_collectors(const CaseFile& c, Findings& findings);

}  // namespace nurbeam
