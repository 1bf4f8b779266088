#include "fem/motion/recentring.h"

#include <algorithm>

#include "fem/system/assembly.h"

namespace nurbeam {

namespace {

bool is_clamped(const BeamSystem& system, const MeshElement<3>& e, int end) {
  const MeshNode& node = end == 0 ? system.mesh().node_a(e) : system.mesh().node_b(e);
  return node.home >= 0 && system.model().beams[e.beam].home[node.home].hold == Hold::clamp;
}

}  // namespace

bool recentring_due(const BeamSystem& system, const State& state) {
  const Assembly<3>* spatial = system.assembly<3>();
  if (!spatial) return false;
  const auto& elements = spatial->elements();
  return std::any_of(elements.begin(), elements.end(), [&](const MeshElement<3>& e) {
    return e.twist && e.twist->element.should_recentre(gather_twist(e, state.q));
  });
}

MeshedState recentred(const BeamSystem& system, const State& state, const std::vector<bool>& held) {
  MeshPlan plan = present_plan(system, state);  // of the same elements, in their order
  auto charts = plan.section_charts.begin();
  State next = state;
  for (const MeshElement<3>& e : system.assembly<3>()->elements()) {
    if (!e.twist) continue;
    const TwistElement& element = e.twist->element;
    const TwistState x = gather_twist(e, state);
    MeshPlan::SectionCharts& now = *charts++;
    for (const int end : {0, 1}) {
      if (is_clamped(system, e, end)) continue;
      now.charts[end] = element.end_section(x.q, end).matrix();
      const int angle = e.twist->dofs[TwistLayout::angle(end)];
      next.q[angle] = 0;
      next.v[angle] = element.spin(x, end);
    }
  }
  return {system.replanned(std::move(plan), held), std::move(next)};
}

}  // namespace nurbeam
