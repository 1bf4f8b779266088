#include "cad_import/occt/loose_faces.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include "cad_import/occt/prism_edges.h"

namespace nurbeam {

SewnFaces sewn_loose_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces) {
  constexpr int fewest = 6, most = 5000;  // of two triangles, one in the other
  constexpr double seam = 1e-3;           // [mm]
  TopTools_IndexedMapOfShape of_solids, loose;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next())
    TopExp::MapShapes(solids.Current(), TopAbs_FACE, of_solids);
  for (int i = 1; i <= faces.Extent(); ++i)
    if (!of_solids.Contains(faces(i)) && is_side_of_prism(TopoDS::Face(faces(i)))) loose.Add(faces(i));
  if (loose.Extent() < fewest || loose.Extent() > most) return {};
  BRepBuilderAPI_Sewing sewing(seam);
  for (int i = 1; i <= loose.Extent(); ++i) sewing.Add(loose(i));
  sewing.Perform();
  SewnFaces sewn{sewing.SewedShape(), {}};
  for (int i = 1; i <= faces.Extent(); ++i)
    sewn.faces.Add(loose.Contains(faces(i)) ? sewing.Modified(faces(i)) : faces(i));
  return sewn;
}

}  // namespace nurbeam
