#include "fem/sensitivity/neighbouring_mesh.h"

#include <stdexcept>
#include <utility>

#include "fem/motion/remesh/recentring.h"
#include "fem/motion/run/run_follower.h"
#include "fem/system/assembly.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// Place in a neighbouring model of a rider that the rest of `at` holds [m].
double held_place(const MeshedState& at, int rider, const BeamModel& model) {
  const BeamModel& drawn = at.system->model();
  const double s = at.system->mesh().plan.places[rider];
  const Rider &own = drawn.riders[rider], &other = model.riders[rider];
  if (other.motion) return other.motion->at(at.state.t).s;
  if (s == own.s) return other.s;
  return corresponding_place(drawn.beam_of(own), s, model.beam_of(other));
}

/// The home nodes with a fixed place, between which other home nodes may be placed differently.
std::vector<int> dividing(const Beam& beam) {
  std::vector<int> nodes;
  for (int h = 0; h <= beam.home_intervals(); ++h) {
    const HomeNode& node = beam.home[h];
    if (h == 0 || h == beam.home_intervals() || node.permanent || node.joined || node.kept ||
        node.kind != NodeKind::smooth || node.hold != Hold::nothing)
      nodes.push_back(h);
  }
  return nodes;
}

bool alike(const HomeNode& a, const HomeNode& b) {
  return a.permanent == b.permanent && a.kind == b.kind && a.hold == b.hold && a.joined == b.joined &&
         a.kept == b.kept;
}

// Home nodes of `beam`, divided as those of `drawn`.
std::vector<HomeNode> home_like(const Beam& beam, const Beam& drawn) {
  const std::vector<int> own = dividing(beam), nodes = dividing(drawn);
  bool correspond = own.size() == nodes.size();
  for (std::size_t i = 0; correspond && i < nodes.size(); ++i)
    correspond = alike(beam.home[own[i]], drawn.home[nodes[i]]);
  if (!correspond)
    throw std::runtime_error("a derivative needs neighbouring models of one mesh, and the parts of beam \"" +
                             beam.name + "\" change with the parameter");
  std::vector<HomeNode> home{beam.home.front()};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double from = drawn.home[nodes[i]].s, to = drawn.home[nodes[i + 1]].s;
    const HomeNode &own_from = beam.home[own[i]], &own_to = beam.home[own[i + 1]];
    for (int h = nodes[i] + 1; h < nodes[i + 1]; ++h) {
      home.push_back(drawn.home[h]);
      home.back().s = own_from.s + (own_to.s - own_from.s) * (drawn.home[h].s - from) / (to - from);
    }
    home.push_back(own_to);
  }
  return home;
}

// Section charts of a rest for a neighbour that is on its mesh in the charts of the drawing. In the same
// charts angles mean the same in both, except where the drawing's chart is kept.
std::vector<MeshPlan::SectionCharts> charts_like(const MeshedState& at, const BeamSystem& neighbour) {
  const std::vector<MeshElement<3>>&own = at.system->assembly<3>()->elements(),
        &others = neighbour.assembly<3>()->elements();
  std::vector<MeshPlan::SectionCharts> charts;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!own[i].twist) continue;
    const MeshElement<3>& e = others[i];
    const TwistElement& like = own[i].twist->element;
    const auto chart = [&](int end) {
      return keeps_drawn_chart(neighbour, e, end) ? e.twist->element.chart(end) : like.chart(end);
    };
    const MeshSpan& span = *e.span;
    charts.push_back(
        {span.beam, span.s_a, span.s_b, {chart(0), chart(1)}, like.turn(gather_twist(own[i], at.state.q))});
  }
  return charts;
}

}  // namespace

std::shared_ptr<const BeamModel> divided_like(std::shared_ptr<const BeamModel> model,
                                              const BeamModel& drawn) {
  std::shared_ptr<BeamModel> other;
  for (std::size_t b = 0; b < model->beams.size() && b < drawn.beams.size(); ++b) {
    if (dividing(model->beams[b]) == dividing(drawn.beams[b])) continue;
    if (!other) other = std::make_shared<BeamModel>(*model);
    other->beams[b].home = home_like(model->beams[b], drawn.beams[b]);
  }
  if (other) return other;
  return model;
}

bool same_mesh(const BeamSystem& system, const BeamSystem& neighbour) {
  const MeshPlan &plan = system.mesh().plan, &other = neighbour.mesh().plan;
  bool same = system.dimension() == neighbour.dimension() &&
              system.coordinate_count() == neighbour.coordinate_count() &&
              system.constraint_count() == neighbour.constraint_count() && plan.modes == other.modes &&
              plan.closed == other.closed && plan.beams.size() == other.beams.size();
  for (std::size_t b = 0; same && b < plan.beams.size(); ++b)
    same = plan.beams[b].present == other.beams[b].present;
  return same;
}

MeshPlan corresponding_plan(const BeamSystem& system, const BeamModel& neighbour) {
  MeshPlan plan = system.mesh().plan;
  const BeamModel& model = system.model();
  for (std::size_t j = 0; j < plan.places.size(); ++j)
    plan.places[j] = corresponding_place(model.beam_of(model.riders[j]), plan.places[j],
                                         neighbour.beam_of(neighbour.riders[j]));
  return plan;
}

std::vector<std::pair<int, double>> shifts_of_places(const BeamSystem& system, const State& state,
                                                     const BeamModel& more, const BeamModel& less,
                                                     double step) {
  std::vector<std::pair<int, double>> shifts;
  const BeamModel& model = system.model();
  for (std::size_t j = 0; j < model.riders.size(); ++j) {
    const int place = system.mesh().riders[j].place, b = model.riders[j].beam;
    if (place < 0) continue;
    const double s = state.q[place];
    const int h = model.beams[b].home_interval(s);
    const double from = model.beams[b].home_place(h), to = model.beams[b].home_place(h + 1);
    const auto apart = [&](int node) {
      return more.beams[b].home_place(node) - less.beams[b].home_place(node);
    };
    const double part = (s - from) / (to - from);
    const double by = ((1 - part) * apart(h) + part * apart(h + 1)) / (2 * step);
    if (by != 0) shifts.emplace_back(place, by);
  }
  return shifts;
}

std::vector<bool> held_joints(const BeamSystem& system) {
  std::vector<bool> held;
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j)
    held.push_back(row_of_place(system, j) && !system.model().riders[j].motion);
  return held;
}

void stand_on_like_spans(const MeshedState& at, MeshedState& neighbour) {
  const Mesh &mesh = at.system->mesh(), &other = neighbour.system->mesh();
  MeshPlan plan = other.plan;
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    const int beam = at.system->model().riders[j].beam;
    if (plan.modes[j] != Carried::point || at.system->model().beams[beam].rigid) continue;
    const int span = find_span(at.system->model(), mesh, at.state.q, beam, mesh.plan.places[j]);
    if (find_span(neighbour.system->model(), other, neighbour.state.q, beam, plan.places[j]) == span)
      continue;
    const MeshSpan& like = other.spans[static_cast<std::size_t>(span)];
    plan.places[j] = (like.start(neighbour.state.q) + like.end(neighbour.state.q)) / 2;
  }
  if (plan.places != other.plan.places)
    neighbour.system = neighbour.system->replanned(std::move(plan), held_joints(*neighbour.system));
}

std::unique_ptr<BeamSystem> at_rest_like(const MeshedState& at,
                                         const std::shared_ptr<const BeamModel>& model) {
  MeshPlan plan = at.system->mesh().plan;
  if (!plan.weights.empty())
    throw std::runtime_error(
        "an equilibrium has no derivative here where bodies slide to it on beams with constant weights; take "
        "differences of runs");
  for (int j = 0; j < static_cast<int>(plan.places.size()); ++j) plan.places[j] = held_place(at, j, *model);
  const bool has_charts = !std::exchange(plan.section_charts, {}).empty();
  auto drawn = std::make_unique<BeamSystem>(model, plan, held_joints(*at.system), *at.system);
  if (!has_charts) return drawn;
  plan.section_charts = charts_like(at, *drawn);
  return std::make_unique<BeamSystem>(model, std::move(plan), held_joints(*at.system), *at.system);
}

}  // namespace nurbeam
