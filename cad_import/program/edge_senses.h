#pragma once
#include <TopoDS_Edge.hxx>
#include <XSControl_Reader.hxx>
#include <unordered_map>

class TopoDS_TShape;

namespace nurbeam {

/// Which way the edges of a STEP wireframe run: by ISO 10303-42 from the first vertex of their EDGE_CURVE to
/// the last. OpenCASCADE lets them run along their curves, and turns those that it makes wires of.
class EdgeSenses {
 public:
  EdgeSenses() = default;  ///< of no edge
  explicit EdgeSenses(const XSControl_Reader& reader);

  /// Whether an EDGE_CURVE says it.
  bool know(const TopoDS_Edge& edge) const { return along_.contains(edge.TShape().get()); }

  /// An edge that no face uses, as it runs; as it is where it is not known.
  TopoDS_Edge of(const TopoDS_Edge& edge) const;

 private:
  std::unordered_map<const TopoDS_TShape*, bool> along_;  // whether along its curve; only looked up
};

}  // namespace nurbeam
