#include "fem/motion/remesh/recentring.h"

#include <algorithm>

#include "fem/element/section_frame.h"
#include "fem/system/assembly.h"

namespace nurbeam {

bool keeps_drawn_chart(const BeamSystem& system, const MeshElement<3>& e, int end) {
  const MeshNode& node = end == 0 ? system.mesh().node_a(*e.span) : system.mesh().node_b(*e.span);
  if (node.home < 0) return false;
  const HomeNode& home = system.model().beams[e.span->beam].home[node.home];
  return home.hold == Hold::clamp && !home.turns;
}

bool recentring_due(const BeamSystem& system, const State& state) {
  const Assembly<3>* spatial = system.assembly<3>();
  if (!spatial) return false;
  const auto& elements = spatial->elements();
  return std::any_of(elements.begin(), elements.end(), [&](const MeshElement<3>& e) {
    return e.twist && e.twist->element.should_recentre(gather_twist(e, state.q));
  });
}

MeshedState recentred(const BeamSystem& system, const State& state, const std::vector<bool>& held,
                      const MeshPlan* like) {
  MeshPlan plan = present_plan(system, state);  // a plan with the same elements in the same order
  State next = state;
  std::size_t i = 0;
  for (const MeshElement<3>& e : system.assembly<3>()->elements()) {
    if (!e.twist) continue;
    const TwistElement& element = e.twist->element;
    const TwistState x = gather_twist(e, state);
    MeshPlan::SectionCharts& now = plan.section_charts[i];
    const MeshPlan::SectionCharts* const of_like = like ? &like->section_charts[i] : nullptr;
    ++i;
    if (of_like) now.turn = of_like->turn;
    for (const int end : {0, 1}) {
      if (keeps_drawn_chart(system, e, end)) continue;
      const Eigen::Matrix3d section = element.end_section(x.q, end).matrix();
      const int angle = e.twist->dofs[TwistLayout::angle(end)], slope = TwistLayout::slope(end);
      const Eigen::Matrix3d& chart = now.charts[end] = of_like ? of_like->charts[end] : section;
      const auto rate = [&](double t) {
        const TwistState then{x.q + t * x.v, x.v + t * x.a, x.a};
        return element.spin(then, end) -
               spin_row<double>(chart, then.q.segment<3>(slope)).dot(then.v.segment<3>(slope));
      };
      next.q[angle] = of_like ? angle_in(chart, section) : 0;
      next.v[angle] = of_like ? rate(0) : element.spin(x, end);
      // A difference over 2 t, accurate to a part in 10^10.
      const auto of_slope = [&](const auto& of) {
        return of.template segment<3>(slope).template lpNorm<Eigen::Infinity>();
      };
      const double quick = std::max(of_slope(x.v), std::sqrt(1e-5 * of_slope(x.a)));
      const double t = quick > 0 ? 1e-5 / quick : 1;
      next.a[angle] = (rate(t) - rate(-t)) / (2 * t);
    }
  }
  return {system.replanned(std::move(plan), held), std::move(next)};
}

}  // namespace nurbeam
