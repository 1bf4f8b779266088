#pragma once
#include "pipelines/case/case_values.h"
#include "pipelines/diagnostics/findings.h"

/// Private to the reader of case files: what is said of rigid bodies.
namespace nurbeam {

/// A support, a joint or a load of a body, which has been checked against its shape.
CaseBodyJoint read_body_support(const Json& json, const std::string& path, Findings& findings);
CaseBodyJoint read_body_joint(const Json& json, const std::string& path, Findings& findings);
CaseBodyLoad read_body_load(const Json& json, const std::string& path, Findings& findings);

/// Reports a body whose inertia no body can have, and what only a rigid body can have.
void check_rigid_body(const CaseBody& body, Findings& findings);

/// Makes a body of each point of a rigid body, "body.point", and whatever takes hold of the point takes hold
/// of that.
void add_body_points(CaseFile& file, Findings& findings);

/// Makes points of probes of rigid bodies, under the names of the probes; the others stay.
void add_body_probes(CaseFile& file, Findings& findings);

}  // namespace nurbeam
