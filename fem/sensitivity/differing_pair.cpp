#include "fem/sensitivity/differing_pair.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "fem/sensitivity/number_adjoint.h"

namespace nurbeam {

namespace {

// Whether a body is carried as a point on one of these elements, or runs on a guide.
template <int D>
bool carries_point(const Assembly<D>& assembly, const std::vector<bool>& elements, const State& near) {
  const Mesh& mesh = assembly.mesh();
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    const Carried mode = mesh.plan.modes[j];
    if (mode == Carried::node || mode == Carried::free) continue;
    const int beam = assembly.model()->riders[j].beam;
    if (assembly.model()->beams[beam].rigid) return true;
    if (elements[find_span(*assembly.model(), mesh, near.q, beam, mesh.plan.places[j])]) return true;
  }
  return false;
}

// Whether the line loads that elements carry are equal.
bool have_same_line_loads(const BeamModel& one, const BeamModel& other) {
  return one.gravity == other.gravity &&
         std::equal(
             one.forces.begin(), one.forces.end(), other.forces.begin(), other.forces.end(),
             [](const auto& force, const auto& of_other) {
               const auto is_same = [&](const auto& a) {
                 using Kind = std::decay_t<decltype(a)>;
                 if constexpr (
                     requires { a.per_length(a.beam, 0.0); }) {
                   const Kind* b = std::get_if<Kind>(&of_other);
                   return b && a.beam == b->beam && a.even == b->even && a.value == b->value &&
                          a.time == b->time;
                 }
                 return true;
               };
               return std::visit(is_same, force);
             });
}

}  // namespace

template <int D>
DifferingPair<D> DifferingPair<D>::of(const ResidualDifferences::Pair& of, const std::vector<bool>& unlike,
                                      const State& near) {
  DifferingPair pair{.more = of.more->template assembly<D>(),
                     .less = of.less->template assembly<D>(),
                     .step = of.step,
                     .work = 2 * static_cast<double>(std::count(unlike.begin(), unlike.end(), true)) /
                             std::max<double>(1, static_cast<double>(unlike.size()))};
  for (int i = 0; i < static_cast<int>(unlike.size()); ++i) {
    if (!unlike[i]) continue;
    const MeshElement<D>& e = pair.more->elements()[i];
    if (e.twist || !ElementBatch<D>::takes(e.element))
      pair.apart.push_back({i});
    else
      pair.batched.push_back({i, i});
  }
  pair.carries_point = nurbeam::carries_point(*pair.more, unlike, near);
  return pair;
}

template <int D>
DifferingPair<D> DifferingPair<D>::behind(const std::vector<int>& elements) const {
  DifferingPair pair{.more = more,
                     .less = less,
                     .step = step,
                     .work = work,
                     .batched = batched,
                     .outlasts = true,
                     .is_local = {true, true}};
  for (Different& each : pair.batched) each.now = elements[each.now];
  return pair;
}

template <int D>
std::vector<std::optional<bool>> DifferingPair<D>::known_unlike(const std::vector<int>& elements,
                                                                std::size_t count) const {
  std::vector<std::optional<bool>> known(count);
  const auto set = [&](int old, bool is_unlike) {
    if (elements[old] >= 0) known[elements[old]] = is_unlike;
  };
  for (int old = 0; old < static_cast<int>(elements.size()); ++old) set(old, false);
  for (const Different& each : batched) set(each.now, true);
  for (const Apart& each : apart) set(each.index, true);
  return known;
}

template <int D>
bool DifferingPair<D>::has_same_free_strains() const {
  const std::vector<Beam>&above = more->model()->beams, &below = less->model()->beams;
  return std::equal(above.begin(), above.end(), below.begin(), below.end(), [](const Beam& a, const Beam& b) {
    return a.properties.free_strain == b.properties.free_strain;
  });
}

template <int D>
bool DifferingPair<D>::has_other_numbers_alone(const Assembly<D>& system) const {
  constexpr double round_off = 1e-14;  // of slopes, whose length is 1
  const auto is_alike = [&](const Different& each, const Assembly<D>& side) {
    const MeshElement<D>&own = system.elements()[each.now], &other = side.elements()[each.index];
    return NumberAdjoint<D>::takes(own) && other.element.properties() == own.element.properties() &&
           (other.slope_offset - own.slope_offset).norm() <= round_off;
  };
  return has_same_free_strains() && have_same_line_loads(*more->model(), *less->model()) &&
         std::all_of(batched.begin(), batched.end(),
                     [&](const Different& each) { return is_alike(each, *more) && is_alike(each, *less); });
}

template struct DifferingPair<2>;
template struct DifferingPair<3>;

}  // namespace nurbeam
