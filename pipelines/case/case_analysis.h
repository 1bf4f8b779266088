#pragma once
#include "pipelines/case/case_values.h"
#include "pipelines/diagnostics/findings.h"

namespace nurbeam {

/// Reads "analysis", which has been checked against its shape; reports what it cannot be by itself.
/// `nothing_deforms`: all beams are rigid guides.
CaseAnalysis read_analysis(const Json& json, bool nothing_deforms, Findings& findings);

/// Whether something has values over time, which a static analysis reads at its factor.
bool has_tables(const CaseFile& read);

}  // namespace nurbeam
