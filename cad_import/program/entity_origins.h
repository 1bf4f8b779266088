#pragma once
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_Reader.hxx>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cad_import/occt/appearance.h"
#include "cad_import/report/import_report.h"

class TopoDS_TShape;

namespace nurbeam {

/// The entity of the file that an edge came from.
struct Origin {
  std::string name;
  std::string label;
  Appearance appearance;
  bool left_out = false;  // defective, or only there to be copied
};
// By the shared geometry of the edge; only ever looked up, so that no order depends on addresses.
using Origins = std::unordered_map<const TopoDS_TShape*, Origin>;

/// Entities of a model; only ever looked up, too.
using EntitySet = std::unordered_set<const Standard_Transient*>;

/// Without the blanks around it; "" of null.
std::string trimmed_text(const opencascade::handle<TCollection_HAsciiString>& value);

/// The entity's own name, or that of the curve it is made of.
std::string entity_name(const opencascade::handle<Standard_Transient>& entity);

/// "#17 TrimmedCurve" in STEP, "D15 BSplineCurve" in IGES.
std::string entity_label(const Interface_InterfaceModel& model,
                         const opencascade::handle<Standard_Transient>& entity);

/// What an entity refers to, and what a circular array (414) repeats, which OpenCASCADE's graph leaves out.
std::vector<opencascade::handle<Standard_Transient>> references_of(
    const opencascade::handle<Standard_Transient>& entity, const Interface_Graph& graph);

/// Of an edge's own entity first, then of the smallest of those that hold it: wire or set, face, solid. Of a
/// face's own entity, then of its shell or solid. B-spline curves of the file that cannot be are warned of
/// and left out, as are those that were `refused` before.
Origins origins_of_edges_and_faces(const XSControl_Reader& reader, const EntitySet& refused,
                                   ImportReport& report);

/// Adds a diagnostic about an entity, "" for the whole file.
void add_diagnostic(ImportReport& report, Severity severity, const std::string& entity,
                    const std::string& message);

}  // namespace nurbeam
