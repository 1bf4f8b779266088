#include "fem/system/same_elements.h"

#include <algorithm>

#include "fem/system/with_assembly.h"

namespace nurbeam {

namespace {

bool is_same(const MeshNode& a, const MeshNode& b) { return a.home == b.home && a.rider == b.rider; }

// The spans of one beam by their first nodes, asked for in order along the beam.
class SpansByStart {
 public:
  SpansByStart(const Mesh& mesh, int beam) : mesh_(mesh), beam_(beam) {}

  /// The span between two nodes; -1 where there is none.
  int span_between(const MeshNode& a, const MeshNode& b) {
    const bool follows = follower_ < mesh_.first_span[beam_ + 1] && is_between(follower_, a, b);
    const int span = follows ? follower_ : search(a, b);
    if (span >= 0) follower_ = span + 1;
    return span;
  }

 private:
  bool is_between(int span, const MeshNode& a, const MeshNode& b) const {
    return is_same(mesh_.node_a(mesh_.spans[span]), a) && is_same(mesh_.node_b(mesh_.spans[span]), b);
  }
  int search(const MeshNode& a, const MeshNode& b) {
    const int node = a.home >= 0 ? at_home(a.home) : mesh_.riders[a.rider].node;
    const int span = node < 0 ? -1 : mesh_.first_span[beam_] + node;
    return span >= 0 && span < mesh_.first_span[beam_ + 1] && is_same(mesh_.node_b(mesh_.spans[span]), b)
               ? span
               : -1;
  }
  int at_home(int home) {
    const std::vector<MeshNode>& nodes = mesh_.nodes[beam_];
    while (next_ < nodes.size() && nodes[next_].home < home) ++next_;  // a moving node has home -1
    return next_ < nodes.size() && nodes[next_].home == home ? static_cast<int>(next_) : -1;
  }

  const Mesh& mesh_;
  int beam_;
  int follower_ = mesh_.first_span[beam_];  // the span after the last one found
  std::size_t next_ = 0;
};

template <int D>
std::vector<int> changed(const Assembly<D>& from, const Assembly<D>& to) {
  const MeshPlan &before = from.mesh().plan, &plan = to.mesh().plan;
  if (before.modes != plan.modes || before.held != plan.held || before.closed != plan.closed ||
      from.constraint_count() != to.constraint_count() || from.forces().size() != to.forces().size())
    return {};
  std::vector<int> unknowns;
  const std::vector<const MeshElement<D>*> same = same_elements(to, from);
  for (std::size_t i = 0; i < same.size(); ++i) {
    const MeshElement<D>& e = to.elements()[i];
    if (e.twist) return {};
    if (same[i]) continue;
    for (const int dof : e.dofs)
      if (dof >= 0) unknowns.push_back(dof);
  }
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

}  // namespace

template <int D>
std::vector<const MeshElement<D>*> same_elements(const Assembly<D>& to, const Assembly<D>& from) {
  const Mesh& mesh = to.mesh();
  std::vector<const MeshElement<D>*> same(to.elements().size(), nullptr);
  for (int beam = 0; beam + 1 < static_cast<int>(mesh.first_span.size()); ++beam) {
    SpansByStart spans(from.mesh(), beam);
    for (int i = mesh.first_span[beam]; i < mesh.first_span[beam + 1]; ++i) {
      const int span = spans.span_between(mesh.node_a(mesh.spans[i]), mesh.node_b(mesh.spans[i]));
      if (span >= 0 && from.elements()[span].element.chart() == to.elements()[i].element.chart())
        same[i] = &from.elements()[span];
    }
  }
  return same;
}

std::vector<int> kept_elements(const BeamSystem& from, const BeamSystem& to) {
  return with_assembly(
      to,
      [&]<int D>(const Assembly<D>& assembly) {
        const Assembly<D>& old = *from.assembly<D>();
        const std::vector<const MeshElement<D>*> same = same_elements(assembly, old);
        std::vector<int> kept(old.elements().size(), -1);
        for (std::size_t i = 0; i < same.size(); ++i)
          if (same[i]) kept[static_cast<std::size_t>(same[i] - old.elements().data())] = static_cast<int>(i);
        return kept;
      });
}

std::vector<int> changed_unknowns(const BeamSystem& from, const BeamSystem& to) {
  return with_assembly(
      to, [&]<int D>(const Assembly<D>& assembly) { return changed(*from.assembly<D>(), assembly); });
}

template std::vector<const MeshElement<2>*> same_elements<2>(const Assembly<2>&, const Assembly<2>&);
template std::vector<const MeshElement<3>*> same_elements<3>(const Assembly<3>&, const Assembly<3>&);

}  // namespace nurbeam
