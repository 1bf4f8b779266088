#include "fem/mesh/mesh_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/material/slenderness.h"

namespace nurbeam {

namespace {

std::array<double, 4> drawn_weights(const ReferenceCurve& curve, int segment, double s_a, double s_b) {
  const Eigen::Matrix4d points =
      curve.segment(segment)
          .piece(std::max(0.0, curve.parameter(segment, s_a)), std::min(1.0, curve.parameter(segment, s_b)))
          .points();
  return {points(3, 0), points(3, 1), points(3, 2), points(3, 3)};
}

Chart choose_chart(const Beam& beam, const MeshPlan& plan, const MeshSpan& span, bool arc_length) {
  Chart chart;
  if (beam.weights == WeightRule::ones) return chart;
  if (!arc_length) chart.segment = beam.curve.segment_at((span.s_a + span.s_b) / 2);
  if (beam.weights == WeightRule::material) return chart;
  for (const MeshPlan::Weights& w : plan.weights)
    if (w.beam == span.beam && w.s_a == span.s_a && w.s_b == span.s_b) chart.constant_weights = w.w;
  if (!chart.constant_weights && !arc_length)
    chart.constant_weights = drawn_weights(beam.curve, chart.segment, span.s_a, span.s_b);
  return chart;
}

// The drawn slope before a node minus the drawn slope after it, for the element before the node.
template <int D>
Eigen::Matrix<double, D, 1> drawn_slope_jump(const Beam& beam, const MeshNode& node) {
  const bool is_break = beam.curve.segment_at(node.s, true) != beam.curve.segment_at(node.s);
  if (!is_break || node.rider >= 0 || node.slope_left != node.slope_right)
    return Eigen::Matrix<double, D, 1>::Zero();
  const Eigen::Vector3d jump = beam.curve.tangent(node.s, true) - beam.curve.tangent(node.s);
  // What is straight when it is free has no corner: an eyelet led it round the drawn one.
  constexpr double of_drawing = 1e-3;  // greatest angle of a smooth drawing
  if (beam.curve.straight() && jump.norm() > of_drawing) return Eigen::Matrix<double, D, 1>::Zero();
  return jump.template head<D>();
}

template <int D>
std::array<int, element_size<D>> dofs_of(const Mesh& mesh, const MeshSpan& span) {
  using Layout = ElementLayout<D>;
  const MeshNode &a = mesh.node_a(span), &b = mesh.node_b(span);
  std::array<int, element_size<D>> dofs;
  for (int d = 0; d < D; ++d) {
    dofs[Layout::r(0) + d] = a.r + d;
    dofs[Layout::slope(0) + d] = a.slope_right + d;
    dofs[Layout::r(1) + d] = b.r + d;
    dofs[Layout::slope(1) + d] = b.slope_left + d;
  }
  dofs[Layout::place(0)] = span.place_a;
  dofs[Layout::place(1)] = span.place_b;
  return dofs;
}

const BeamProperties& properties_of(const Beam& beam, const MeshSpan& span) {
  return beam.properties_at((span.s_a + span.s_b) / 2);
}

// The section charts that the plan has for a span; null where they are those of the drawing.
const MeshPlan::SectionCharts* charts_in(const MeshPlan& plan, const MeshSpan& span) {
  for (const MeshPlan::SectionCharts& now : plan.section_charts)
    if (now.beam == span.beam && now.s_a == span.s_a && now.s_b == span.s_b) return &now;
  return nullptr;
}

// The sections of an element. `same`: the same element in another mesh, null if it was not there.
TwistElement twist_of(const Mesh& mesh, const MeshElement<3>& e, const Beam& beam, const Mesh* other,
                      const MeshElement<3>* same) {
  const MeshPlan::SectionCharts* now = charts_in(mesh.plan, *e.span);
  if (same && now) return same->twist->element.in_charts(now->charts, now->turn);
  if (same && !charts_in(other->plan, *same->span)) return same->twist->element;
  const Ends ends = e.element.fixed() ? Ends::fixed : Ends::moving;
  const Chart& chart = e.element.chart();
  const double s_a = e.span->s_a, s_b = e.span->s_b;
  const BeamProperties& properties = e.element.properties();
  if (now) return {beam.curve, properties, chart, s_a, s_b, ends, now->charts, now->turn};
  return {beam.curve, properties, chart, s_a, s_b, ends};
}

// The sections of an element with their coordinates; null without torsion. `same`: see twist_of.
std::unique_ptr<const MeshTwist> make_twist(const Mesh& mesh, const MeshElement<3>& e, const Beam& beam,
                                            const Mesh* other, const MeshElement<3>* same) {
  if (!beam.has_torsion()) return nullptr;
  if (beam.form == Form::virtual_work)
    throw std::invalid_argument("a beam in form P (virtual work) has no torsion");
  std::array<int, TwistLayout::size> dofs;
  std::copy(e.dofs.begin(), e.dofs.end(), dofs.begin());
  dofs[TwistLayout::angle(0)] = mesh.node_a(*e.span).angle_right;
  dofs[TwistLayout::angle(1)] = mesh.node_b(*e.span).angle_left;
  dofs[TwistLayout::bubble] = e.span->bubble;
  return std::make_unique<const MeshTwist>(MeshTwist{dofs, twist_of(mesh, e, beam, other, same)});
}

// Whether an element and a span lie on one segment that is drawn alike, with equal properties.
template <int D>
bool axis_is(const MeshElement<D>& e, const MeshSpan& span, const Chart& chart, const ReferenceCurve& curve,
             const BeamProperties& properties) {
  return e.element.fixed() && e.span->beam == span.beam && chart.segment >= 0 && e.element.chart() == chart &&
         e.element.curve().draws_alike(curve, chart.segment, e.span->s_a, span.s_a) &&
         e.element.curve().draws_alike(curve, chart.segment, e.span->s_b, span.s_b) &&
         e.element.properties() == properties;
}

// Whether two beams draw a segment alike and divide it alike: its home nodes, and the next ones on both
// sides, lie equally far from its start. Corresponding places on it then do too.
bool divided_alike(const Beam& beam, const Beam& other, int segment) {
  if (segment < 0) return false;
  const double start = beam.curve.breaks()[segment], end = beam.curve.breaks()[segment + 1],
               round_off = 1e-9 * beam.curve.length();
  for (int h = beam.home_interval(start + round_off);; ++h) {
    if (!beam.curve.draws_alike(other.curve, segment, beam.home_place(h), other.home_place(h))) return false;
    if (beam.home_place(h) >= end - round_off) return true;
  }
}

// The slopes of a span that belong to no other element and turn freely: those of free ends. At hinges and
// beside kinks the rope is taut, and the end value is right; with moving nodes it conserves more of the
// energy.
OwnSlopes own_slopes(const Mesh& mesh, const MeshSpan& span, const Beam& beam) {
  if (beam.properties.axial_strain == AxialStrain::pointwise || beam.is_ring()) return {};
  const auto is_free = [&](const MeshNode& node, int of_end) {
    if (node.rider >= 0 || node.home != of_end) return false;
    const HomeNode& home = beam.home[static_cast<std::size_t>(node.home)];
    return home.hold == Hold::nothing && !home.joined;
  };
  return {is_free(mesh.node_a(span), 0), is_free(mesh.node_b(span), beam.home_intervals())};
}

AxialRule axial_rule(const Mesh& mesh, const MeshSpan& span, const Beam& beam) {
  const double l = beam.home_spacing((span.s_a + span.s_b) / 2);
  AxialRule rule{.fold_resistance = 0};
  if (is_slender(beam.properties, l))
    rule = {.own_slopes = own_slopes(mesh, span, beam), .fold_resistance = 1};
  if (beam.properties.compression == Compression::buckles)
    rule.buckling_strain = beam.properties.buckling_strain(l);
  return rule;
}

// Finds elements with fixed ends of one mesh in another one, in the order of both.
template <int D>
class SameElements {
 public:
  SameElements(const Structure& structure, const std::optional<MeshedBeams<D>>& like)
      : structure_(&structure), like_(like) {}

  const Mesh* mesh() const { return like_ ? &like_->mesh : nullptr; }

  // The counterpart of a fixed element, or null. In a neighbouring model, which must have as many elements
  // and draw this one alike, the index finds it; else the span does.
  const MeshElement<D>* find(std::size_t index, std::size_t count, const MeshSpan& span, const Chart& chart,
                             const AxialRule& rule, const Beam& beam) {
    if (!like_) return nullptr;
    const std::vector<MeshElement<D>>& others = like_->elements;
    if (&like_->structure != structure_)
      return others.size() == count && others[index].element.axial_rule() == rule &&
                     axis_is(others[index], span, chart, beam.curve, properties_of(beam, span))
                 ? &others[index]
                 : nullptr;
    const auto comes_before = [&](const MeshSpan& other) {
      return other.beam != span.beam ? other.beam < span.beam : other.s_a < span.s_a;
    };
    while (next_ < others.size() && comes_before(*others[next_].span)) ++next_;
    if (next_ == others.size()) return nullptr;
    const MeshElement<D>& other = others[next_];
    const bool is_same = other.element.fixed() && other.span->beam == span.beam &&
                         other.span->s_a == span.s_a && other.span->s_b == span.s_b &&
                         other.element.chart() == chart && other.element.axial_rule() == rule;
    return is_same ? &other : nullptr;
  }

 private:
  const Structure* structure_;
  const std::optional<MeshedBeams<D>>& like_;
  std::size_t next_ = 0;
};

// The ends of a fixed element. If it is one of the equal parts of an evenly drawn line: the ends of the first
// such part, as all that is computed from the ends is equal but for the round-off of the places.
std::array<double, 2> first_alike(const ReferenceCurve& curve, const Chart& chart, const MeshSpan& span) {
  const int j = chart.segment;
  if (j < 0 || chart.constant_weights || curve.metric() != Metric::arc_length || !curve.is_uniform_line(j))
    return {span.s_a, span.s_b};
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * curve.length();
  const double start = curve.breaks()[j], line = curve.breaks()[j + 1] - start, length = span.s_b - span.s_a;
  const double part = line / std::round(line / length);
  if (!(std::abs(part - length) <= round_off)) return {span.s_a, span.s_b};
  return {start, start + part};
}

// Puts the numbers of elements side by side: eight at a time that follow one another on a beam, in the order
// of their batch. Elements that stand so in another mesh already stay there.
template <int D>
class ByEights {
 public:
  /// The elements must stay where they are until close().
  void add(MeshElement<D>& e) {
    if (e.twist || !e.element.is_one_part()) return;
    if (!group_.empty() && group_.front()->span->beam != e.span->beam) close();
    group_.push_back(&e);
    if (group_.size() == FixedLanes::lanes) close();
  }

  /// The element in the last group of eight whose lane the next element of this beam takes; null: none.
  const MeshElement<D>* counterpart(int beam) const {
    const std::size_t lane = group_.size();
    return lane < last_.size() && last_[lane]->span->beam == beam ? last_[lane] : nullptr;
  }

  void close() {
    const int count = static_cast<int>(group_.size());
    bool stand_so = true;
    for (int i = 0; i < count; ++i)
      stand_so = stand_so && group_[i]->element.stands_beside(group_[0]->element, i);
    const auto numbers = stand_so ? nullptr : std::make_shared<FixedLanes>();
    for (int i = 0; i < count && numbers; ++i) group_[i]->element.stand_beside(numbers, i);
    last_.swap(group_);
    group_.clear();
  }

 private:
  std::vector<MeshElement<D>*> group_, last_;
};

// The element of a span. `counterpart`: another element of its beam, whose numbers are reused where they are
// equal; `same`: see twist_of. Both may be null.
template <int D>
BeamElement<D> fixed_element(const Beam& beam, Chart chart, const MeshSpan& span, const AxialRule& rule,
                             const MeshElement<D>* counterpart, const MeshElement<D>* same) {
  const std::array<double, 2> ends = first_alike(beam.curve, chart, span);
  if (counterpart && counterpart->element.fixed() && counterpart->element.chart() == chart &&
      counterpart->element.axial_rule() == rule && first_alike(beam.curve, chart, *counterpart->span) == ends)
    return counterpart->element;
  if (same) return same->element.on(beam.curve, properties_of(beam, span));
  return {beam.curve, properties_of(beam, span), std::move(chart), ends[0], ends[1], Ends::fixed, rule};
}

}  // namespace

template <int D>
std::vector<MeshElement<D>> make_elements(const Structure& structure, const Mesh& mesh,
                                          const std::optional<MeshedBeams<D>>& like) {
  SameElements<D> others(structure, like);
  std::vector<MeshElement<D>> elements;
  elements.reserve(mesh.spans.size());
  ByEights<D> by_eights;
  for (int i = 0; i < static_cast<int>(mesh.spans.size()); ++i) {
    const MeshSpan& span = mesh.spans[i];
    const Beam& beam = structure.beams[span.beam];
    if (beam.form == Form::virtual_work && beam.properties.axial_strain != AxialStrain::pointwise)
      throw std::invalid_argument("a beam in form P (virtual work) has the pointwise axial strain");
    if (!beam.properties.free_strain.is_none() && beam.properties.axial_strain == AxialStrain::pointwise)
      throw std::invalid_argument(
          "a beam with the pointwise axial strain is as long as it is drawn when free");
    const Ends ends = span.place_a < 0 && span.place_b < 0 ? Ends::fixed : Ends::moving;
    Chart chart = choose_chart(beam, mesh.plan, span, is_arc_length_span(structure, mesh, i));
    const AxialRule rule = axial_rule(mesh, span, beam);
    const MeshElement<D>* same =
        ends == Ends::fixed ? others.find(elements.size(), mesh.spans.size(), span, chart, rule, beam)
                            : nullptr;
    const bool of_model = same && &same->element.curve() == &beam.curve;
    elements.push_back(
        {&span, i, dofs_of<D>(mesh, span),
         of_model ? same->slope_offset : drawn_slope_jump<D>(beam, mesh.node_b(span)),
         ends == Ends::fixed
             ? fixed_element(beam, std::move(chart), span, rule, by_eights.counterpart(span.beam), same)
             : BeamElement<D>(beam.curve, properties_of(beam, span), std::move(chart), span.s_a, span.s_b,
                              ends, rule)});
    if constexpr (D == 3)
      elements.back().twist =
          make_twist(mesh, elements.back(), beam, others.mesh(), of_model ? same : nullptr);
    by_eights.add(elements.back());
  }
  by_eights.close();
  return elements;
}

template <int D>
ElementVector<D> gather(const MeshElement<D>& e, const Eigen::VectorXd& q) {
  using Layout = ElementLayout<D>;
  ElementVector<D> x;
  for (int i = 0; i < Layout::nodal; ++i) x[i] = q[e.dofs[i]];
  x[Layout::place(0)] = e.span->start(q);
  x[Layout::place(1)] = e.span->end(q);
  x.template segment<D>(Layout::slope(1)) += e.slope_offset;
  return x;
}

template <int D>
ElementState<D> gather(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& a) {
  ElementState<D> x;
  x.q = gather<D>(e, q);
  for (int i = 0; i < element_size<D>; ++i) {
    const int dof = e.dofs[i];
    x.v[i] = dof >= 0 ? v[dof] : 0;
    x.a[i] = dof >= 0 ? a[dof] : 0;
  }
  return x;
}

TwistLayout::Coordinates gather_twist(const MeshElement<3>& e, const Eigen::VectorXd& q) {
  TwistLayout::Coordinates x;
  x.head<TwistLayout::first>() = gather<3>(e, q);
  for (int i = TwistLayout::first; i < TwistLayout::size; ++i) x[i] = q[e.twist->dofs[i]];
  return x;
}

TwistState gather_twist(const MeshElement<3>& e, const State& state) {
  TwistState x{gather_twist(e, state.q), TwistLayout::Coordinates::Zero(), TwistLayout::Coordinates::Zero()};
  for (int i = 0; i < TwistLayout::size; ++i)
    if (const int dof = e.twist->dofs[i]; dof >= 0) {
      x.v[i] = state.v[dof];
      x.a[i] = state.a[dof];
    }
  return x;
}

template <int D>
bool same_axis(const MeshElement<D>& e, const MeshElement<D>& other, const Beam& beam,
               const Beam& other_beam) {
  constexpr double round_off = 1e-12;
  if (e.element.fixed() != other.element.fixed() || e.element.axial_rule() != other.element.axial_rule() ||
      !((e.slope_offset - other.slope_offset).norm() <= round_off))
    return false;
  if (e.element.fixed())
    return axis_is(e, *other.span, other.element.chart(), other.element.curve(), other.element.properties());
  const auto is_unturned = [](const MeshSpan& span) { return span.shift_a == 0 && span.shift_b == 0; };
  return is_unturned(*e.span) && is_unturned(*other.span) && e.element.chart() == other.element.chart() &&
         e.element.properties() == other.element.properties() &&
         divided_alike(beam, other_beam, e.element.chart().segment);
}

template <int D>
MaterialPoint<D> material_point(const ElementState<D>& x, const ShapeFunctions<double>& shape) {
  const ElementNodes<D> nodes = x.nodes(), rates = x.node_rates();
  const auto sum = [](const ElementNodes<D>& of, const std::array<double, 4>& functions) {
    return Eigen::Matrix<double, D, 1>(of * Eigen::Map<const Eigen::Vector4d>(functions.data()));
  };
  return {sum(nodes, shape.value), sum(nodes, shape.d1), sum(nodes, shape.d2),
          sum(rates, shape.value), sum(rates, shape.d1), shape.kappa0};
}

template <int D>
MaterialPoint<D> material_point(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                double s) {
  using Layout = ElementLayout<D>;
  const ElementState<D> x = gather<D>(e, q, v, v);
  if (e.element.fixed()) return material_point<D>(x, e.element.shape(x.q, e.local(x.q, s)));
  const ElementNodes<D> nodes = x.nodes(), rates = x.node_rates();
  const ShapeFunctions<Jet> shape = e.element.shape_series(x.q, e.local(x.q, s));
  const std::array<double, 2> w{x.v[Layout::place(0)], x.v[Layout::place(1)]};
  const PointField<D> r(shape.value, nodes), rs(shape.d1, nodes), rss(shape.d2, nodes);
  return {
      r.value, rs.value, rss.value, r.rate(nodes, rates, w), rs.rate(nodes, rates, w), shape.kappa0.value()};
}

template std::vector<MeshElement<2>> make_elements<2>(const Structure&, const Mesh&,
                                                      const std::optional<MeshedBeams<2>>&);
template std::vector<MeshElement<3>> make_elements<3>(const Structure&, const Mesh&,
                                                      const std::optional<MeshedBeams<3>>&);
template bool same_axis<2>(const MeshElement<2>&, const MeshElement<2>&, const Beam&, const Beam&);
template bool same_axis<3>(const MeshElement<3>&, const MeshElement<3>&, const Beam&, const Beam&);
template ElementVector<2> gather<2>(const MeshElement<2>&, const Eigen::VectorXd&);
template ElementVector<3> gather<3>(const MeshElement<3>&, const Eigen::VectorXd&);
template ElementState<2> gather<2>(const MeshElement<2>&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                                   const Eigen::VectorXd&);
template ElementState<3> gather<3>(const MeshElement<3>&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                                   const Eigen::VectorXd&);
template MaterialPoint<2> material_point<2>(const MeshElement<2>&, const Eigen::VectorXd&,
                                            const Eigen::VectorXd&, double);
template MaterialPoint<3> material_point<3>(const MeshElement<3>&, const Eigen::VectorXd&,
                                            const Eigen::VectorXd&, double);
template MaterialPoint<2> material_point<2>(const ElementState<2>&, const ShapeFunctions<double>&);
template MaterialPoint<3> material_point<3>(const ElementState<3>&, const ShapeFunctions<double>&);

}  // namespace nurbeam
