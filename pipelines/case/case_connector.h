#pragma once
#include "pipelines/case/case_values.h"
#include "pipelines/diagnostics/findings.h"

namespace nurbeam {

/// Reads one item of "connectors", which has been checked against its shape; reports what it cannot be by
/// itself.
CaseConnector read_connector(const Json& json, const std::string& path, Findings& findings);

/// Reports what connectors and bodies cannot be in this case: ends that are one, bodies that nothing holds or
/// places, lengths that no equilibrium gives.
void check_connectors(const CaseFile& c, Findings& findings);

}  // namespace nurbeam
