#pragma once
#include <TopoDS_Shape.hxx>

#include "cad_import/occt/true_places.h"
#include "cad_import/program/composite_ends.h"
#include "cad_import/program/edge_senses.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/program/part_names.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// What is known of the edges and faces of a shape.
struct ShapeFacts {
  Origins origins = {};
  PartNames parts = {};
  TruePlaces places = {};
  EdgeSenses senses = {};
};

/// Adds the curves of all edges of a shape [mm] that are not degenerate, each once, with what is known of
/// where they came from; what is unnamed itself goes by its part, but for the many edges of a solid. A
/// warning names an edge whose curve is none, and approximations that are worse than `tolerance` [m]. Returns
/// which they are.
CurvesOfEdges add_edges(const TopoDS_Shape& shape, const ShapeFacts& facts, double tolerance,
                        ImportReport& report);

/// Adds the centre lines of its pipes.
void add_centre_lines(const TopoDS_Shape& shape, const ShapeFacts& facts, double tolerance,
                      ImportReport& report);

}  // namespace nurbeam
