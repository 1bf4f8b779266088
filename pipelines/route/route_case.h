#pragma once
#include "pipelines/case/case_file.h"
#include "pipelines/route/route.h"

namespace nurbeam {

/// The case whose equilibrium is the route: one beam of that unstressed length [m], drawn as `start`,
/// straight where it is free, clamped at both ends; as many elements as the tolerance asks for.
CaseFileReport route_case(const RouteRequest& request, const NurbsCurve& start, double length,
                          double tolerance);

/// Findings of that case at the places of the request: what the case calls beams[0].section is its section.
std::vector<Diagnostic> in_places_of(const RouteRequest& request, std::vector<Diagnostic> findings);

}  // namespace nurbeam
