#pragma once
#include <XSControl_Reader.hxx>

#include "cad_import/program/entity_origins.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

struct RestatedCurves {
  EntitySet refused;  ///< named in a warning
  EntitySet parents;  ///< of replicas, which refer to them no more
};

/// Says those curves of a model anew that OpenCASCADE reads otherwise than the standards have them, before it
/// translates them: in IGES circular and conic arcs (100, 104) and offset curves (130), in STEP offset
/// curves, replicas and pieces of parabolas. A warning names each that cannot be read as it is meant. To be
/// called once.
RestatedCurves restate_curves(const XSControl_Reader& reader, ImportReport& report);

}  // namespace nurbeam
