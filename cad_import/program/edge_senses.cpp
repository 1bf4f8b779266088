#include "cad_import/program/edge_senses.h"

#include <StepShape_EdgeCurve.hxx>
#include <TopoDS.hxx>
#include <TopoDS_TShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

namespace nurbeam {

EdgeSenses::EdgeSenses(const XSControl_Reader& reader) {
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const auto edge = Handle(StepShape_EdgeCurve)::DownCast(process->Mapped(i));
    const TopoDS_Shape result = edge.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(process, edge);
    if (!result.IsNull()) along_.emplace(result.TShape().get(), edge->SameSense());
  }
}

TopoDS_Edge EdgeSenses::of(const TopoDS_Edge& edge) const {
  const auto known = along_.find(edge.TShape().get());
  if (known == along_.end()) return edge;
  return TopoDS::Edge(edge.Oriented(known->second ? TopAbs_FORWARD : TopAbs_REVERSED));
}

}  // namespace nurbeam
