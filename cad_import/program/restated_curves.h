#pragma once
#include <Eigen/Geometry>
#include <Standard_Transient.hxx>
#include <XSControl_Reader.hxx>
#include <optional>
#include <vector>

#include "cad_import/occt/true_places.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// An entity that scales or mirrors what it places, where that was given a stand-in.
struct RestatedPlace {
  opencascade::handle<Standard_Transient> entity;
  std::optional<Eigen::Affine3d> place;     ///< [m]; nothing where it cannot be placed so
  std::optional<Eigen::Affine3d> stand_in;  ///< [m]; where OpenCASCADE may take the way back
};

struct RestatedCurves {
  EntitySet refused;  ///< named in a warning
  EntitySet parents;  ///< of replicas, which refer to them no more
  std::vector<RestatedPlace> places;
};

/// Says those curves of a model anew that OpenCASCADE reads otherwise than the standards have them, before it
/// translates them: in IGES chains of matrices (124), circular and conic arcs (100, 104), offset curves
/// (130) and scaled instances of subfigures (408), in STEP offset curves, replicas, pieces of parabolas,
/// parts and mapped items that are placed by transformation operators or between two placements. A warning
/// names each that cannot be read as it is meant, rays and infinite lines of IGES too. To be called once.
RestatedCurves restate_curves(const XSControl_Reader& reader, ImportReport& report);

/// Where the shapes truly stand that OpenCASCADE has made, after all that can be read have been translated.
TruePlaces true_places(const XSControl_Reader& reader, const RestatedCurves& restated);

}  // namespace nurbeam
