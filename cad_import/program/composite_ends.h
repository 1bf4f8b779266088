#pragma once
#include <XSControl_Reader.hxx>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "cad_import/report/import_report.h"

class TopoDS_TShape;

namespace nurbeam {

/// The curves of a report that edges became: one for each place of an edge. Only ever looked up.
using CurvesOfEdges = std::unordered_map<const TopoDS_TShape*, std::vector<std::size_t>>;

/// Moves the ends of the parts of a composite curve that nearly meet to the point midway, by the rule of
/// report/leniency.h: the file says that they are one curve. A note tells how many and how far.
void join_composites(const XSControl_Reader& reader, const CurvesOfEdges& curves, ImportReport& report);

/// Whether one curve is the other but for ends that were moved so.
bool is_same_but_for_ends(const NurbsCurve& a, const NurbsCurve& b);

}  // namespace nurbeam
