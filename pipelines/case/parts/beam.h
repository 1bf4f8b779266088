#pragma once
#include <numbers>

#include "fem/structure/beam.h"
#include "pipelines/case/parts/axis.h"
#include "pipelines/case/parts/elements.h"
#include "pipelines/case/parts/initial.h"
#include "pipelines/case/parts/material.h"
#include "pipelines/case/parts/section.h"

namespace nurbeam {

enum class ElementKind { ale_rancf, ale_ancf };
/// What a corner of the axis above `smooth_angle` is; error and smooth: an error; rigid: it keeps its angle.
enum class Corners { error, smooth, rigid, hinge };
enum class StressFree { automatic, as_drawn, straight, as_drawn_without_torsion };

struct CaseBeam {
  std::string name;
  std::string path;  ///< JSON path of this object, for messages
  CaseAxis axis;
  /// For axes of degree above 3 [m]; else approximation_tolerance() of beam_axis.h.
  std::optional<double> approximation_tolerance = {};
  bool rigid = false;  ///< a guide: no section, material or elements
  bool ring = false;   ///< the axis is closed, and so is the beam
  Corners corners = Corners::error;
  double smooth_angle = 0;  ///< greatest corner that is smoothed [rad]; 0: none
  CaseSection section;
  CaseMaterial material;
  CaseElements elements;
  ElementKind element = ElementKind::ale_rancf;
  WeightRule weights = WeightRule::material;
  MergeRule merge = MergeRule::standard;
  bool torsion = false;
  bool torsion_by_drawing = false;  ///< nothing asks for torsion or against it: the model decides
  Orientation orientation = {};     ///< with torsion, or of a guide
  bool has_orientation = false;     ///< whether the case gives it
  StressFree stress_free = StressFree::automatic;
  CurvatureMeasure curvature = CurvatureMeasure::material;
  AxialStrain axial_strain = AxialStrain::ends_and_mean;
  Metric metric = Metric::arc_length;
  Form form = Form::variational;
  std::optional<double> unstressed_length = {};  ///< [m]
  double tension = 0;                            ///< as drawn [N]
  TimeTable temperature = {};                    ///< above that of the unstressed length [K]; empty: none
  std::optional<CaseVelocity> velocity = {};
};

inline Fields<Orientation> orientation_fields() {
  using namespace shapes;
  using O = Orientation;
  return {
      {
          field_by<O>("up", vector(Dimension::number), "the section's y axis points up this way everywhere",
                      [](const Json& json, const std::string&, O& to, Findings&) {
                        to.rule = O::Rule::up;
                        take(json, to.direction);
                      }),
          field_by<O>(
              "start", vector(Dimension::number),
              "direction of the y axis at the start; from there sections do not twist; z, or x where the "
              "beam starts along z, when omitted",
              [](const Json& json, const std::string&, O& to, Findings&) { take(json, to.direction); }),
          field_by<O>("frenet", boolean(), "it points to the centre of curvature everywhere",
                      [](const Json& json, const std::string&, O& to, Findings&) {
                        bool frenet = false;
                        take(json, frenet);
                        if (frenet) to.rule = O::Rule::frenet;
                      }),
          field_by<O>("twist", table_over_length(Dimension::angle, {.lower = -1e6, .upper = 1e6}),
                      "turned about the axis besides: [s, angle], smooth between rows, constant outside",
                      [](const Json& json, const std::string&, O& to, Findings&) {
                        TimeTable rows;
                        take(json, rows);
                        for (const auto& [s, degrees] : rows)
                          to.twist.emplace_back(s, degrees * std::numbers::pi / 180);
                      }),
      },
      {{{"up", "start", "frenet"}, false}}};
}

inline Fields<CaseBeam> beam_fields() {
  using namespace shapes;
  using B = CaseBeam;
  const auto elsewhere = [](const Json&, const std::string&, B&, Findings&) {};  // read_beam takes it
  const Shape initial = object({{"velocity", velocity_fields().shape(),
                                 "the sum of its parts, as far as supports and joints let it", required}});
  const Range kelvin{.lower = -1e4, .upper = 1e4, .reason = "a difference in kelvin"};
  return {
      {
          field(&B::name, "name", name(), "name of the beam").needed(),
          field_by<B>("axis", axis_shape(), "the reference curve of the beam", elsewhere).needed(),
          field(&B::rigid, "rigid", boolean(),
                "a rigid curve, or track: it does not deform, and takes neither section nor material")
              .otherwise("false"),
          field_by<B>("section", section_shape(), "cross-section; needed unless the beam is `rigid`",
                      elsewhere),
          field_by<B>("material", either(choice(standard_material_names()), material_fields().shape()),
                      "a standard material by its name, or its numbers; needed unless the beam is `rigid`",
                      elsewhere),
          object_field(&B::elements, "elements", elements_fields(), "how the axis is divided"),
          choice_field(&B::element, "element",
                       {{"ale-rancf", ElementKind::ale_rancf}, {"ale-ancf", ElementKind::ale_ancf}},
                       "rational elements, or all weights 1")
              .otherwise("ale-rancf"),
          choice_field(&B::weights, "weights",
                       {{"material", WeightRule::material}, {"constant", WeightRule::constant}},
                       "whether weights follow the material or stay with the element, as the paper's")
              .otherwise("material"),
          choice_field(
              &B::merge, "merge",
              {{"default", MergeRule::standard}, {"paper", MergeRule::paper}, {"ones", MergeRule::ones}},
              "for comparison, with constant weights: the paper's weights of merged elements (Eqs. "
              "31-38), or ones; the nodes keep their velocities then"),
          choice_field(&B::metric, "metric", {{"reference", Metric::arc_length}, {"none", Metric::label}},
                       "metric of the material coordinate; none: the subdivision paper's elements, for "
                       "comparison, with spatial curvature and no sliding bodies")
              .otherwise("reference"),
          field(
              &B::torsion, "torsion", boolean(),
              "the beam bends about its section's own axes and twists, in space; when omitted true with "
              "`orientation` or `second_moments`, and, where `stress_free` does not say \"straight\", where "
              "the axis is curved in space, where a profile in space has I_x other than I_y, and where a "
              "support, joint, load or body needs its sections"),
          object_field(&B::orientation, "orientation", orientation_fields(),
                       "orientation of the sections of a beam with torsion"),
          choice_field(
              &B::stress_free, "stress_free",
              {{"as-drawn", StressFree::as_drawn},
               {"straight", StressFree::straight},
               {"as-drawn-without-torsion", StressFree::as_drawn_without_torsion}},
              "the stress-free shape; when omitted as-drawn in planar models and with torsion, else straight"),
          choice_field(&B::curvature, "curvature",
                       {{"material", CurvatureMeasure::material}, {"spatial", CurvatureMeasure::spatial}},
                       "curvature measure; spatial: that of the paper on the element")
              .otherwise("material"),
          choice_field(
              &B::axial_strain, "axial_strain",
              {{"ends-and-mean", AxialStrain::ends_and_mean}, {"pointwise", AxialStrain::pointwise}},
              "the assumed axial strain: the quadratic with the end values and the mean of the strain in an "
              "element, or the strain at every point, as in the papers, which locks in slender beams; when "
              "omitted ends-and-mean, but pointwise with constant weights, without metric and with form "
              "virtual-work"),
          field(&B::tension, "tension", quantity(Dimension::force, plausible(-1e12, 1e12)),
                "axial force in the reference configuration; negative: compression of a beam that bends")
              .otherwise("0"),
          field(
              &B::unstressed_length, "unstressed_length", quantity(Dimension::length, positive()),
              "length of the beam without stress; the reference curve is then where the analysis starts, "
              "and its shape, scaled to this length, is stress-free; the length of the reference curve when "
              "omitted"),
          field(&B::temperature, "temperature", constant_or_table(Dimension::temperature, kelvin),
                "difference of temperature from the state of the unstressed length, or that over time; needs "
                "material.thermal_expansion"),
          field_by<B>("initial", initial, "how it moves at time 0; at rest when omitted",
                      [](const Json& json, const std::string& path, B& beam, Findings& findings) {
                        if (const Json* velocity = value_under(json, "velocity"))
                          velocity_fields().read(*velocity, path, beam.velocity.emplace(), findings);
                      }),
          choice_field(
              &B::form, "form", {{"variational", Form::variational}, {"virtual-work", Form::virtual_work}},
              "form of the forces on moving elements; virtual-work: the paper's, for comparison, which "
              "drifts")
              .otherwise("variational"),
          field(&B::ring, "closed", boolean(),
                "true: a ring, whose end is its start; else a closed axis is open at its seam"),
          choice_field(
              &B::corners, "corners",
              {{"error", Corners::error},
               {"smooth", Corners::smooth},
               {"rigid", Corners::rigid},
               {"hinge", Corners::hinge}},
              "treatment of a corner of the axis; smooth: rounded, if small; rigid: a frame that conserves "
              "the angle")
              .otherwise("error"),
          field_by<B>("smooth_up_to", quantity(Dimension::angle, {.lower = 0, .upper = 45, .open = true}),
                      "largest corner that is rounded; when omitted 5 with smooth, else none",
                      [](const Json& json, const std::string&, B& beam, Findings&) {
                        take(json, beam.smooth_angle);
                        beam.smooth_angle *= std::numbers::pi / 180;
                      })
              .beside("corners"),
          field(&B::approximation_tolerance, "approximation_tolerance",
                quantity(Dimension::length, positive()),
                "maximum deviation of the cubics from an axis of degree above 3")
              .otherwise("1e-6 m, or 1e-6 of its length where that is less,"),
      },
      {{{"tension", "unstressed_length"}, false}}};
}

}  // namespace nurbeam
