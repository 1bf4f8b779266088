#include "cad_import/ifc/ifc_alignment.h"

#include <cmath>
#include <stdexcept>
#include <string>

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
      ", which is not read; lines, arcs and clothoids in plan, and lines, arcs and parabolas "
      "in elevation are: export it as a polyline or B-spline");
}

// ------------------------------------------------------------------------------------------- IFC 4.1

PlanElement plan_element(const IfcModel& model, const IfcValue& segment) {
  const auto side = [&](std::size_t radius, std::size_t is_left) {
    return curvature(number_or(segment.at(radius), 0)) * (is_true(segment.at(is_left)) ? 1 : -1);
  };
  PlanElement element{plane_point(model, segment.at(0)), segment.at(1).as_number() * model.angle_unit(),
                      segment.at(2).as_number()};
  if (segment.text == "IFCCIRCULARARCSEGMENT2D") {
    element.start_curvature = element.end_curvature = side(3, 4);
  } else if (segment.text == "IFCTRANSITIONCURVESEGMENT2D") {
    if (segment.at(7).text != "CLOTHOIDCURVE") refuse(segment.text + " of kind " + segment.at(7).text);
    element.start_curvature = side(3, 5);
    element.end_curvature = side(4, 6);
  } else if (segment.text != "IFCLINESEGMENT2D") {
    refuse(segment.text);
  }
  return element;
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

PlanElement plan_segment(const IfcModel& model, const IfcValue& parameters) {
  PlanElement element{plane_point(model, parameters.at(2)), parameters.at(3).as_number() * model.angle_unit(),
                      parameters.at(6).as_number(), curvature(number_or(parameters.at(4), 0)),
                      curvature(number_or(parameters.at(5), 0))};
  const std::string& kind = parameters.at(8).text;
  if (kind == "LINE") element.start_curvature = element.end_curvature = 0;
  if (kind == "CIRCULARARC") element.end_curvature = element.start_curvature;
  if (kind != "LINE" && kind != "CIRCULARARC" && kind != "CLOTHOID")
    refuse(parameters.text + " of kind " + kind);
  return element;
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
      for (const IfcValue& item : relation.at(5).items)
        if (item.is_reference()) nested.push_back(item.reference);
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

  double heading() const { return std::atan2(place(1, 0), place(0, 0)); }
};

CurveSegment curve_segment(const IfcModel& model, const IfcValue& segment) {
  if (segment.text != "IFCCURVESEGMENT") refuse(segment.text);
  return {ifc_placement(model, segment.at(1)), segment.at(2).as_number(), segment.at(3).as_number(),
          model.at(segment.at(4))};
}

PlanElement plan_element(const CurveSegment& segment) {
  const double sign = segment.length < 0 ? -1 : 1;
  PlanElement element{segment.place.translation().head<2>(), segment.heading(), std::abs(segment.length)};
  if (segment.parent.text == "IFCCIRCLE") {
    element.start_curvature = element.end_curvature = sign * curvature(segment.parent.at(1).as_number());
  } else if (segment.parent.text == "IFCCLOTHOID") {
    const double constant = segment.parent.at(1).as_number();
    const double rate = (constant < 0 ? -1 : 1) / (constant * constant);
    element.start_curvature = sign * rate * segment.start;
    element.end_curvature = sign * rate * (segment.start + segment.length);
  } else if (segment.parent.text != "IFCLINE") {
    refuse(segment.parent.text);
  }
  return element;
}

GradeElement grade_element(const CurveSegment& segment) {
  const double slope = std::tan(segment.heading());
  GradeElement element{segment.place.translation().x(), segment.place.translation().y(), slope};
  if (segment.parent.text == "IFCCIRCLE") {
    element.radius = (segment.length < 0 ? -1 : 1) * segment.parent.at(1).as_number();
  } else if (segment.parent.text == "IFCPOLYNOMIALCURVE") {
    const std::vector<IfcValue>& y = segment.parent.at(2).items;
    if (y.size() > 3) refuse("IFCPOLYNOMIALCURVE of a degree above 2");
    element.bend = y.size() == 3 ? y[2].as_number() : 0;
  } else if (segment.parent.text != "IFCLINE") {
    refuse(segment.parent.text);
  }
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
  alignment.plan = elements_of<PlanElement>(horizontal.at(1), [&](const IfcValue& item) {
    return plan_element(model, model.at(model.at(item).at(3)));
  });
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
        found.plan.push_back(plan_segment(model, parameters));
    if (model.keyword(layout) == "IFCALIGNMENTVERTICAL")
      for (const IfcValue& parameters : design_parameters(model, layout))
        found.grade.push_back(grade_segment(parameters));
  }
  return found;
}

Alignment alignment_of_composite(const IfcModel& model, const IfcValue& curve) {
  if (curve.text == "IFCSEGMENTEDREFERENCECURVE")  // the cant does not move the curve of the track's middle
    return alignment_of_composite(model, model.at(curve.at(2)));
  if (curve.text == "IFCGRADIENTCURVE") {
    const IfcValue base = model.at(curve.at(2));
    if (base.text == "IFCGRADIENTCURVE") throw std::runtime_error("its base curve has a grade itself");
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
