#include "cad_import/program/brep_text.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <sstream>
#include <stdexcept>

#include "cad_import/step/local_origin.h"
#include "cad_import/step/spine.h"
#include "cad_import/step/swept_solid.h"

namespace nurbeam {
namespace {

template <class Item, class Shape>
std::string text_of_all(const std::vector<Item>& items, const Shape& shape_of) {
  try {
    const BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    for (const Item& item : items) builder.Add(all, shape_of(item));
    std::ostringstream out;
    BRepTools::Write(all, out);
    return std::move(out).str();
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE cannot make a shape: ") + e.GetMessageString());
  }
}

}  // namespace

std::string brep_text(const std::vector<NamedCurve>& curves) {
  return text_of_all(
      curves,
      [](const NamedCurve& curve) {
        const Eigen::Vector3d origin = local_origin(curve.curve);
        if (origin.isZero()) return TopoDS_Shape(edge(curve));
        return moved_back(edge({curve.name, moved_to_origin(curve.curve, origin), curve.part}), origin);
      });
}

std::string brep_solid_text(const std::vector<NamedSolid>& solids) {
  return text_of_all(
      solids, [](const NamedSolid& solid) { return swept_solid(solid); });
}

TopoDS_Shape brep_shape(const std::string& content) {
  const char* const damaged =
      "OpenCASCADE reads no shape in it: the file is damaged; export or copy it again";
  std::istringstream in(content);
  in.exceptions(std::ios::failbit);  // else OpenCASCADE reads beyond the end for ever
  TopoDS_Shape shape;
  try {
    BRepTools::Read(shape, in, BRep_Builder());
  } catch (const std::ios::failure&) {
    throw std::runtime_error(damaged);
  }
  if (shape.IsNull()) throw std::runtime_error(damaged);
  return shape;
}

}  // namespace nurbeam
