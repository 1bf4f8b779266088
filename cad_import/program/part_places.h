#pragma once
#include <StepBasic_ProductDefinition.hxx>
#include <TopoDS_Shape.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_Reader.hxx>
#include <gp_Trsf.hxx>
#include <optional>
#include <vector>

#include "cad_import/occt/true_places.h"
#include "cad_import/program/part_names.h"

namespace nurbeam {

/// A place of a part in an assembly.
struct PartPlace {
  gp_Trsf to_world;  ///< of its coordinates [mm]
  PartName name;
};

/// The parts of a STEP file that OpenCASCADE has translated.
class PartPlaces {
 public:
  PartPlaces(const XSControl_Reader& reader, TruePlaces true_places);

  /// The shape of a part; null where none was made.
  TopoDS_Shape shape_of(const opencascade::handle<StepBasic_ProductDefinition>& part) const;

  /// Where the whole has a part, in its order; none where it has it nowhere, or where one place scales or
  /// mirrors it.
  std::vector<PartPlace> of(const opencascade::handle<StepBasic_ProductDefinition>& part) const;

 private:
  opencascade::handle<Transfer_TransientProcess> process_;
  TruePlaces true_places_;
  TopoDS_Shape whole_;
  PartNames names_;
};

/// The part whose shape a representation holds the entity in, and that representation. Nothing where none
/// does, where it is several, or where one is drawn in another (MAPPED_ITEM).
struct Holder {
  opencascade::handle<StepBasic_ProductDefinition> part;
  opencascade::handle<Standard_Transient> context;  ///< of the coordinates
};
std::optional<Holder> holder_of(const opencascade::handle<Standard_Transient>& entity,
                                const Interface_Graph& graph);

}  // namespace nurbeam
