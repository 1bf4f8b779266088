#pragma once
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>

namespace nurbeam {

/// Faces that are sewn where their edges lie on each other.
struct SewnFaces {
  TopoDS_Shape shape;  ///< null where there are none
  TopTools_IndexedMapOfShape faces;
};

/// The flat and cylindrical faces of a shape that belong to no solid, sewn. Each has the number in `faces` of
/// the result that it had in `faces`, those of the shape. Of more than 5000 none are.
SewnFaces sewn_loose_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces);

}  // namespace nurbeam
