#pragma once
#include <NCollection_DataMap.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_Reader.hxx>
#include <string>

namespace nurbeam {

/// The part that holds a shape.
struct PartName {
  std::string own;   ///< "cable left"
  std::string path;  ///< from the assembly down: "bridge/cable left"
};
/// By shape and location.
using PartNames = NCollection_DataMap<TopoDS_Shape, PartName, TopTools_ShapeMapHasher>;

/// The product's name, else its id; "" without.
std::string product_name(const opencascade::handle<StepBasic_ProductDefinition>& definition);

/// Those of all edges, faces and compounds in `root`, the reader's shape. An occurrence goes by its own
/// name, without one by that of its product (PRODUCT's name, else its id); in IGES a group (402) by its name.
PartNames part_names(const XSControl_Reader& reader, const TopoDS_Shape& root);

}  // namespace nurbeam
