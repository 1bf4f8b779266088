#include "cad_import/ifc/ifc_alignment.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

bool is_true(const IfcValue& flag) { return flag.text == "T"; }

double number_or(const IfcValue& value, double otherwise) {
  return value.kind == IfcValue::Kind::none ? otherwise : value.as_number();
}

/// Of a radius with its sign; 0 or none: of a line.
double curvature(double radius) { return radius == 0 || !std::isfinite(radius) ? 0 : 1 / radius; }

Eigen::Vector2d plane_point(const IfcModel& model, const IfcValue& point) {
  return ifc_point(model, point).head<2>();
}

[[noreturn]] void refuse(const std::string& kind) {
  throw std::runtime_error(
      "it has an element " + kind +
      ", which is not read; lines, arcs, spirals and polynomials in plan, and lines, arcs and parabolas "
      "in elevation are: export it as a polyline or B-spline");
}

// --------------------------------------------------------------------------------------- transitions in plan

/// An element whose curvature goes from one value to another, and how: the word of either schema, without
/// CURVE at its end.
struct Transition {
  PlanElement element;  // without its turning
  std::string kind;
  double first, last;  // curvature

  double change() const { return last - first; }
};

std::string without_ending(std::string kind, std::string_view ending) {
  if (kind.ends_with(ending)) kind.resize(kind.size() - ending.size());
  return kind;
}

/// Of those that are one spiral. With x = s / L: clothoid x, Bloss 3x^2 - 2x^3, cosine (1 - cos pi x) / 2,
/// sine x - sin(2 pi x) / (2 pi), Vienna 35x^4 - 84x^5 + 70x^6 - 20x^7 of the change.
std::optional<Spiral> spiral_of(const Transition& transition) {
  const double L = transition.element.length, k = transition.first, d = transition.change();
  const auto over = [&](double factor, int power) { return factor * d / std::pow(L, power); };
  if (transition.kind == "CLOTHOID") return Spiral{{k, over(1, 1)}};
  if (transition.kind == "BLOSS") return Spiral{{k, 0, over(3, 2), over(-2, 3)}};
  if (transition.kind == "COSINE") return Spiral{{k + d / 2}, -d / 2, 0, L};
  if (transition.kind == "SINE") return Spiral{{k, over(1, 1)}, 0, -d / (2 * std::numbers::pi), L};
  if (transition.kind == "VIENNESEBEND")
    return Spiral{{k, 0, 0, 0, over(35, 4), over(-84, 5), over(70, 6), over(-20, 7)}};
  return std::nullopt;
}

/// Two halves: 2x^2 of the change, and 1 - 2 (1 - x)^2.
void add_helmert(const Transition& transition, std::vector<PlanElement>& plan) {
  const double L = transition.element.length, k = transition.first, d = transition.change();
  const Spiral first{{k, 0, 2 * d / (L * L)}}, second{{k - d, 4 * d / L, -2 * d / (L * L)}};
  PlanElement half = transition.element;
  half.length = L / 2;
  half.turning = turning_of(first, 0, half.length);
  plan.push_back(half);
  half.start = half.place(half.length);
  half.heading += half.turning.angle(half.length);
  half.turning = turning_of(second, L / 2, half.length);
  plan.push_back(half);
}

/// The parabola y = x^3 / (6 R L), from where it has the first curvature, as long as the element.
Turning cubic_parabola(const Transition& transition) {
  const double L = transition.element.length, d = transition.change();
  const PolynomialCurve parabola{{0, 1}, {0, 0, 0, d / (6 * L)}};
  return turning_of(parabola, parabola.parameter(0, L * transition.first / d), L);
}

void add_transition(Transition transition, std::vector<PlanElement>& plan) {
  PlanElement& element = transition.element;
  if (element.length == 0 || transition.change() == 0) {
    element.turning = even_turning(transition.first);
    return plan.push_back(element);
  }
  if (transition.kind == "HELMERT" || transition.kind == "BIQUADRATICPARABOLA")
    return add_helmert(transition, plan);
  if (transition.kind == "CUBIC" || transition.kind == "CUBICPARABOLA")
    element.turning = cubic_parabola(transition);
  else if (const std::optional<Spiral> spiral = spiral_of(transition))
    element.turning = turning_of(*spiral, 0, element.length);
  else
    refuse("of kind " + transition.kind);
  plan.push_back(element);
}

// ------------------------------------------------------------------------------------------- IFC 4.1

void add_plan_element(const IfcModel& model, const IfcValue& segment, std::vector<PlanElement>& plan) {
  const auto side = [&](std::size_t radius, std::size_t is_left) {
    return curvature(number_or(segment.at(radius), 0)) * (is_true(segment.at(is_left)) ? 1 : -1);
  };
  PlanElement element{plane_point(model, segment.at(0)), segment.at(1).as_number() * model.angle_unit(),
                      segment.at(2).as_number()};
  if (segment.text == "IFCTRANSITIONCURVESEGMENT2D")
    return add_transition({element, without_ending(segment.at(7).text, "CURVE"), side(3, 5), side(4, 6)},
                          plan);
  if (segment.text == "IFCCIRCULARARCSEGMENT2D")
    element.turning = even_turning(side(3, 4));
  else if (segment.text != "IFCLINESEGMENT2D")
    refuse(segment.text);
  plan.push_back(element);
}

GradeElement grade_element(const IfcValue& segment) {
  GradeElement element{segment.at(3).as_number(), segment.at(5).as_number(), segment.at(6).as_number()};
  const double sign = is_true(segment.at(8)) ? -1 : 1;  // convex: a crest
  if (segment.text == "IFCALIGNMENT2DVERSEGPARABOLICARC")
    element.bend = sign / (2 * segment.at(7).as_number());
  else if (segment.text == "IFCALIGNMENT2DVERSEGCIRCULARARC")
    element.radius = sign * segment.at(7).as_number();
  else if (segment.text != "IFCALIGNMENT2DVERSEGLINE")
    refuse(segment.text);
  return element;
}

// ------------------------------------------------------------------------------------- IFC 4.3, segments

void add_plan_segment(const IfcModel& model, const IfcValue& parameters, std::vector<PlanElement>& plan) {
  PlanElement element{plane_point(model, parameters.at(2)), parameters.at(3).as_number() * model.angle_unit(),
                      parameters.at(6).as_number()};
  const double first = curvature(number_or(parameters.at(4), 0)),
               last = curvature(number_or(parameters.at(5), 0));
  const std::string& kind = parameters.at(8).text;
  if (kind == "VIENNESEBEND" && number_or(parameters.at(7), 0) != 0)
    refuse(parameters.text + " of kind VIENNESEBEND about a centre of gravity beside the track");
  if (kind != "LINE" && kind != "CIRCULARARC")
    return add_transition({element, without_ending(kind, "CURVE"), first, last}, plan);
  element.turning = even_turning(kind == "LINE" ? 0 : first);
  plan.push_back(element);
}

GradeElement grade_segment(const IfcValue& parameters) {
  const double length = parameters.at(3).as_number(), slope = parameters.at(5).as_number(),
               last = parameters.at(6).as_number();
  GradeElement element{parameters.at(2).as_number(), parameters.at(4).as_number(), slope};
  const std::string& kind = parameters.at(8).text;
  if (kind == "PARABOLICARC") {
    element.bend = length > 0 ? (last - slope) / (2 * length) : 0;
  } else if (kind == "CIRCULARARC") {
    const double turn = last / std::hypot(1, last) - slope / std::hypot(1, slope);
    element.radius = turn == 0 ? 0 : length / turn;
  } else if (kind != "CONSTANTGRADIENT") {
    refuse(parameters.text + " of kind " + kind);
  }
  return element;
}

/// What an object nests, in order.
std::vector<int> nested_in(const IfcModel& model, int object) {
  std::vector<int> nested;
  for (const char* kind : {"IFCRELNESTS", "IFCRELAGGREGATES"})
    for (const int number : model.with_keyword(kind)) {
      const IfcValue relation = model.instance(number);
      if (!relation.at(4).is_reference() || relation.at(4).reference != object) continue;
      for (const IfcValue& item : relation.at(5).items) {
        model.at(item);  // throws where it is not there
        nested.push_back(item.reference);
      }
    }
  return nested;
}

/// The parameters of the segments that a layout nests.
std::vector<IfcValue> design_parameters(const IfcModel& model, int layout) {
  std::vector<IfcValue> parameters;
  for (const int segment : nested_in(model, layout))
    if (model.keyword(segment) == "IFCALIGNMENTSEGMENT")
      parameters.push_back(model.at(model.instance(segment).at(7)));
  return parameters;
}

// -------------------------------------------------------------------------------- IFC 4.3, curve segments

/// A curve segment: where it is, from where its parent curve is taken, and for how long.
struct CurveSegment {
  Eigen::Affine3d place;
  double start, length;
  IfcValue parent;
  bool starts_at_parameter;  // of a polynomial; else an arc length

  double heading() const { return std::atan2(place(1, 0), place(0, 0)); }
};

/// A measure of a curve segment as an arc length.
double length_on(const IfcModel& model, const IfcValue& parent, const IfcValue& measure) {
  const double number = measure.as_number();
  if (measure.text != "IFCPARAMETERVALUE" || parent.text == "IFCPOLYNOMIALCURVE") return number;
  if (parent.text == "IFCCIRCLE") return number * model.angle_unit() * parent.at(1).as_number();
  if (parent.text == "IFCLINE") return number * model.at(parent.at(1)).at(1).as_number();
  refuse(parent.text + " measured by its parameter");
}

CurveSegment curve_segment(const IfcModel& model, const IfcValue& segment) {
  if (segment.text != "IFCCURVESEGMENT") refuse(segment.text);
  IfcValue parent = model.at(segment.at(4));
  const double start = length_on(model, parent, segment.at(2)),
               length = length_on(model, parent, segment.at(3));
  return {ifc_placement(model, segment.at(1)), start, length, std::move(parent),
          segment.at(2).text == "IFCPARAMETERVALUE"};
}

/// Powers of a spiral whose terms stand from the highest down: a term A of power n is s^n / A^(n + 1), with
/// its sign.
Spiral spiral_of_terms(const IfcValue& parent, std::size_t first, std::size_t order) {
  Spiral spiral;
  for (std::size_t power = 0; power <= order; ++power) {
    const double term = number_or(parent.at(first + order - power), 0);
    const double size = std::pow(std::abs(term), static_cast<double>(power + 1));
    spiral.powers.push_back(term == 0 ? 0 : (term < 0 ? -1 : 1) / size);
  }
  return spiral;
}

/// That of a parent curve; `period`: the length of its segment. The wave of a cosine or sine spiral is its
/// first term.
std::optional<Spiral> spiral_of_parent(const IfcValue& parent, double period) {
  static const std::map<std::string, std::size_t> orders{{"IFCSECONDORDERPOLYNOMIALSPIRAL", 2},
                                                         {"IFCTHIRDORDERPOLYNOMIALSPIRAL", 3},
                                                         {"IFCSEVENTHORDERPOLYNOMIALSPIRAL", 7}};
  if (const auto known = orders.find(parent.text); known != orders.end())
    return spiral_of_terms(parent, 1, known->second);
  Spiral spiral;
  if (parent.text == "IFCCLOTHOID") {
    spiral.powers = {0, spiral_of_terms(parent, 1, 0).powers[0]};
    spiral.powers[1] *= std::abs(spiral.powers[1]);
  } else if (parent.text == "IFCCOSINESPIRAL") {
    spiral = spiral_of_terms(parent, 2, 0);
    spiral.cosine = spiral_of_terms(parent, 1, 0).powers[0];
  } else if (parent.text == "IFCSINESPIRAL") {
    spiral = spiral_of_terms(parent, 2, 1);
    spiral.sine = spiral_of_terms(parent, 1, 0).powers[0];
  } else {
    return std::nullopt;
  }
  spiral.period = period;
  return spiral;
}

std::vector<double> factors_of(const IfcValue& list) {
  std::vector<double> factors;
  for (const IfcValue& item : list.items) factors.push_back(item.as_number());
  return factors;
}

PolynomialCurve polynomial_of(const IfcValue& parent) {
  PolynomialCurve curve{factors_of(parent.at(1)), factors_of(parent.at(2))};
  constexpr std::size_t most = 20;
  if (curve.x.size() > most || curve.y.size() > most) refuse("IFCPOLYNOMIALCURVE of a degree above 19");
  return curve;
}

/// The parameter of a polynomial where its segment begins.
double first_parameter(const CurveSegment& segment, const PolynomialCurve& curve) {
  return segment.starts_at_parameter ? segment.start : curve.parameter(0, segment.start);
}

PlanElement plan_element(const CurveSegment& segment) {
  const double length = std::abs(segment.length);
  PlanElement element{segment.place.translation().head<2>(), segment.heading(), length};
  if (length == 0) return element;
  if (segment.parent.text == "IFCCIRCLE") {
    element.turning =
        even_turning((segment.length < 0 ? -1 : 1) * curvature(segment.parent.at(1).as_number()));
  } else if (segment.parent.text == "IFCPOLYNOMIALCURVE") {
    const PolynomialCurve curve = polynomial_of(segment.parent);
    element.turning = turning_of(curve, first_parameter(segment, curve), segment.length);
  } else if (const std::optional<Spiral> spiral = spiral_of_parent(segment.parent, length)) {
    element.turning = turning_of(*spiral, segment.start, segment.length);
  } else if (segment.parent.text != "IFCLINE") {
    refuse(segment.parent.text);
  }
  return element;
}

/// Of a parabola y(x), as it lies where its segment begins.
double bend_of(const CurveSegment& segment, double slope) {
  const PolynomialCurve curve = polynomial_of(segment.parent);
  constexpr double same = 1e-4;  // as the digits of directions leave it
  if (curve.y.size() > 3) refuse("IFCPOLYNOMIALCURVE of a degree above 2");
  if (curve.x.size() != 2 || curve.x[1] != 1)
    refuse("IFCPOLYNOMIALCURVE that is no parabola over the length");
  const double own = std::tan(curve.heading(first_parameter(segment, curve)));
  if (!(std::abs(own - slope) <= same))
    refuse("IFCPOLYNOMIALCURVE that is turned from a slope of " + text_of(own) + " to " + text_of(slope));
  return curve.y.size() == 3 ? curve.y[2] : 0;
}

GradeElement grade_element(const CurveSegment& segment) {
  const double slope = std::tan(segment.heading());
  GradeElement element{segment.place.translation().x(), segment.place.translation().y(), slope};
  if (segment.length == 0) return element;
  if (segment.parent.text == "IFCCIRCLE")
    element.radius = (segment.length < 0 ? -1 : 1) * segment.parent.at(1).as_number();
  else if (segment.parent.text == "IFCPOLYNOMIALCURVE")
    element.bend = bend_of(segment, slope);
  else if (segment.parent.text != "IFCLINE")
    refuse(segment.parent.text);
  return element;
}

template <class Element, class Make>
std::vector<Element> elements_of(const IfcValue& list, const Make& make) {
  std::vector<Element> elements;
  for (const IfcValue& item : list.items) elements.push_back(make(item));
  return elements;
}

}  // namespace

Alignment alignment_of_curve(const IfcModel& model, const IfcValue& curve) {
  Alignment alignment;
  if (!curve.at(0).is_reference()) throw std::runtime_error("it has no horizontal alignment");
  const IfcValue horizontal = model.at(curve.at(0));
  alignment.begin = number_or(horizontal.at(0), 0);
  for (const IfcValue& item : horizontal.at(1).items)
    add_plan_element(model, model.at(model.at(item).at(3)), alignment.plan);
  if (curve.at(1).is_reference())
    alignment.grade = elements_of<GradeElement>(
        model.at(curve.at(1)).at(0), [&](const IfcValue& item) { return grade_element(model.at(item)); });
  return alignment;
}

Alignment alignment_of_segments(const IfcModel& model, int alignment) {
  Alignment found;
  for (const int layout : nested_in(model, alignment)) {
    if (model.keyword(layout) == "IFCALIGNMENTHORIZONTAL")
      for (const IfcValue& parameters : design_parameters(model, layout))
        add_plan_segment(model, parameters, found.plan);
    if (model.keyword(layout) == "IFCALIGNMENTVERTICAL")
      for (const IfcValue& parameters : design_parameters(model, layout))
        found.grade.push_back(grade_segment(parameters));
  }
  return found;
}

Alignment alignment_of_composite(const IfcModel& model, const IfcValue& curve) {
  if (curve.text == "IFCSEGMENTEDREFERENCECURVE") {  // the cant does not move the curve of the track's middle
    const IfcValue base = model.at(curve.at(2));
    if (base.text == curve.text) throw std::runtime_error("its base curve has a cant itself");
    return alignment_of_composite(model, base);
  }
  if (curve.text == "IFCGRADIENTCURVE") {
    const IfcValue base = model.at(curve.at(2));
    if (base.text == curve.text || base.text == "IFCSEGMENTEDREFERENCECURVE")
      throw std::runtime_error("its base curve has a grade itself");
    Alignment alignment = alignment_of_composite(model, base);
    alignment.grade = elements_of<GradeElement>(curve.at(0), [&](const IfcValue& item) {
      return grade_element(curve_segment(model, model.at(item)));
    });
    return alignment;
  }
  return {elements_of<PlanElement>(
              curve.at(0),
              [&](const IfcValue& item) { return plan_element(curve_segment(model, model.at(item))); }),
          {},
          0};
}

}  // namespace nurbeam
