// Long because it is the one list of all keys.
#include "pipelines/case/case_keys.h"

#include <cmath>
#include <sstream>

#include "cad_import/files/cad_file_name.h"
#include "pipelines/case/case_file.h"
#include "pipelines/case/shapes.h"
#include "pipelines/case/standard_materials.h"

namespace nurbeam {

namespace {

using namespace shapes;

Range time_step() { return plausible(1e-12, 1e9); }
Range element_count() {
  return {.lower = 1, .upper = most_elements, .reason = "the most elements of one beam"};
}
/// [width, height].
Shape sides() {
  Shape shape =
      array(Shape{.kind = Kind::quantity, .dimension = Dimension::length, .range = plausible(1e-9, 1e4)}, 2);
  shape.most_items = 2;
  return shape;
}

Shape axis() {
  const Shape nurbs =
      object({{"degree", integer(from(1)), "degree of the curve", required},
              {"knots", array(quantity(Dimension::number), 4),
               "full non-decreasing knots, both ends included", required},
              {"control_points", array(point(), 2), "plain (not weighted) control points", required},
              {"weights", array(quantity(Dimension::number, positive()), 2),
               "one per control point; 1 when omitted"}});
  const Shape arc =
      object({{"center", point(), "centre of the circle", required},
              {"start", point(), "start point", required},
              {"end", point(), "end point", required},
              {"normal", vector(Dimension::number),
               "the arc turns by the right hand about it; a whole circle where start and end are one point",
               required}});
  return object(
      {{"file", any_text(),
        std::string(cad_formats) +
            " file, which may be packed (.stpZ, .zip, .gz), relative to the case file"},
       {"curve", either(any_text(), integer(from(1))),
        "name or index (from 1) as `nurbeam inspect` prints them", false, "file"},
       {"chain", boolean(), "also the tangent-continuous curves connected to `curve`", false, "curve"},
       {"part", any_text(),
        "only curves of this part (STEP), group (IGES) or block (DXF): its name, or the end of its path",
        false, "file"},
       {"layer", any_text(), "only curves of this layer (STEP, DXF) or level (IGES)", false, "file"},
       {"colour", any_text(), "only curves of this colour, \"#rrggbb\"", false, "file"},
       {"near", point(), "the chain of curves nearest to this point", false, "file"},
       {"longest", boolean(), "the longest chain of curves", false, "file"},
       {"chains", choice({"all"}), "every chain becomes a beam: \"name 1\", \"name 2\", ...", false, "file"},
       {"gap", quantity(Dimension::length, not_negative()),
        "ends of curves up to this far apart meet; the file's own resolution when omitted", false, "file"},
       {"nurbs", nurbs, "an inline NURBS curve"},
       {"polyline", array(point(), 2), "straight pieces through these points"},
       {"arc", arc, "a circular arc"}},
      {{{"file", "nurbs", "polyline", "arc"}, required}, {{"curve", "near", "longest", "chains"}, false}});
}

Shape section() {
  const Shape profile =
      object({{"file", any_text(),
               std::string(cad_formats) + " file with an outline and its holes, relative to the case file",
               required},
              {"in_plane", choice({"y", "x"}),
               "the profile's axis that lies in the plane of a planar model; y when omitted"}});
  const Shape size = quantity(Dimension::length, plausible(1e-9, 1e4));
  const Shape i_section = object({{"width", size, "of the flanges", required},
                                  {"height", size, "from outside to outside", required},
                                  {"flange", size, "thickness of the flanges", required},
                                  {"web", size, "thickness of the web", required}});
  const Shape rope = object(
      {{"diameter", size, "over all", required},
       {"metallic_area", quantity(Dimension::area, plausible(1e-18, 1e8)), "of all wires together", required},
       {"wires", integer({.lower = 1, .upper = 10000}),
        "how many, each of which bends by itself; 114 (6 x 19) when omitted"},
       {"second_moment", quantity(Dimension::second_moment, plausible(1e-36, 1e16)),
        "where it is known better than from the wires"}});
  return object(
      {{"radius", quantity(Dimension::length, plausible(1e-9, 1e4)), "radius of a round section"},
       {"bore", quantity(Dimension::length, not_negative()), "inner radius of a pipe; 0 when omitted", false,
        "radius"},
       {"rectangle", sides(),
        "[width, height] of a rectangle; the height lies in the plane of a planar model, and "
        "along the section's y axis"},
       {"i_section", i_section, "of an I, upright along the section's y axis"},
       {"rope", rope, "wire rope"},
       {"area", quantity(Dimension::area, plausible(1e-18, 1e8)), "cross-section area"},
       {"second_moment", quantity(Dimension::second_moment, plausible(1e-36, 1e16)), "second moment of area",
        false, "area"},
       {"second_moments", array(quantity(Dimension::second_moment, plausible(1e-36, 1e16)), 2),
        "[I_x, I_y] about the section's own axes, of a beam with torsion; y is where the orientation points",
        false, "area"},
       {"product", quantity(Dimension::second_moment), "I_xy, the integral of x y; 0 when omitted", false,
        "second_moments"},
       {"torsion_constant", quantity(Dimension::second_moment, plausible(1e-36, 1e16)),
        "St Venant's; when omitted that of the profile, or I_x + I_y of a round section"},
       {"extreme_fibre", quantity(Dimension::length, plausible(1e-9, 1e4)),
        "greatest distance of the section from its axis of bending; without it no stress is given", false,
        "area"},
       {"profile", profile, "section drawn in a CAD file; all curves of the file together"},
       {"from", choice({"cad"}), "the section of the pipe in the CAD file whose centre line is the axis"}},
      {{{"radius", "rectangle", "i_section", "rope", "area", "profile", "from"}, required},
       {{"second_moment", "second_moments"}, false}});
}

Shape orientation() {
  return object(
      {{"up", vector(Dimension::number), "the section's y axis points up this way everywhere"},
       {"start", vector(Dimension::number),
        "it does at the start, and from there sections do not twist; z, or x where the beam starts along z, when "
        "nothing is said"},
       {"frenet", boolean(), "it points to the centre of curvature everywhere"},
       {"twist", table_over_length(Dimension::angle, {.lower = -1e6, .upper = 1e6}),
        "turned about the axis besides: [s, angle], smooth between rows, constant outside"}},
      {{{"up", "start", "frenet"}, false}});
}

Shape elements() {
  return object(
      {{"count", integer(element_count()),
        "number of elements of the beam; 20 when nothing is said, or as many as there are segments"},
       {"max_length", quantity(Dimension::length, positive()), "greatest element length"},
       {"per_segment", integer(element_count()),
        "elements per cubic segment of the axis, cut at the supports"},
       {"tolerance",
        quantity(Dimension::number,
                 {.lower = 1e-9, .upper = 0.1, .reason = "less is round-off, more no longer a measure"}),
        "as many elements as the beam needs for this error of positions, over its length, estimated from the static "
        "state in which bodies are held where they start"},
       {"grading", quantity(Dimension::length),
        "how much longer each element is than the one before it in its segment; negative: shorter", false,
        "per_segment"}},
      {{{"count", "max_length", "per_segment", "tolerance"}, false}});
}

Range temperature_range() { return {.lower = -1e4, .upper = 1e4, .reason = "a difference in kelvin"}; }

Shape initial() {
  const Shape velocity = object(
      {{"translation", vector(Dimension::speed, plausible(-1e9, 1e9)), "of the whole beam"},
       {"rotation", vector(Dimension::angular_speed, plausible(-1e9, 1e9)),
        "angular velocity of the whole beam"},
       {"about", point(), "a point of the axis of the rotation; the origin when omitted", false, "rotation"},
       {"along", quantity(Dimension::speed, plausible(-1e9, 1e9)),
        "of the material along the drawn axis, towards its end"}});
  return object(
      {{"velocity", velocity, "the sum of its parts, as far as supports and joints let it", required}});
}

Shape beam() {
  const Shape material = object(
      {{"name", choice(standard_material_names()),
        "a standard material, which gives what is not given beside it"},
       {"density", quantity(Dimension::density, plausible(1e-3, 1e6)),
        "mass per volume; needed without `name`"},
       {"youngs_modulus", quantity(Dimension::pressure, plausible(1, 1e16)),
        "Young's modulus, of a rope the effective one; needed without `name`"},
       {"damping", quantity(Dimension::time, plausible(0, 1e9)),
        "time c of the stress c E d(strain)/dt; 0 when omitted"},
       {"mass_damping", quantity(Dimension::rate, plausible(0, 1e9)),
        "rate alpha of the force -alpha density area v on the velocity v; 0 when omitted"},
       {"stiffness_damping", quantity(Dimension::time, plausible(0, 1e9)),
        "time beta of Rayleigh's damping: as `damping`, and beta times the stiffness that tension gives, which damps "
        "taut strings too; 0 when omitted"},
       {"thermal_expansion", quantity(Dimension::thermal_expansion, plausible(-1e-2, 1e-2)),
        "strain per kelvin of the beam's `temperature`"},
       {"shear_modulus", quantity(Dimension::pressure, plausible(1, 1e16)), "of beams with torsion"},
       {"poissons_ratio", quantity(Dimension::number, {.lower = -0.99, .upper = 0.5}),
        "gives the shear modulus; 0.3 when neither is given"}},
      {{{"shear_modulus", "poissons_ratio"}, false}});
  return object(
      {{"name", name(), "name of the beam", required},
       {"axis", axis(), "the beam's axis as drawn", required},
       {"rigid", boolean(),
        "a guide: the axis stays as drawn, without elements, mass or strain, and takes neither section nor material; "
        "false when omitted"},
       {"section", section(), "cross-section; needed unless the beam is `rigid`"},
       {"material", either(choice(standard_material_names()), material),
        "a standard material by its name, or its numbers; needed unless the beam is `rigid`"},
       {"elements", elements(), "how the axis is divided"},
       {"element", choice({"ale-rancf", "ale-ancf"}),
        "rational elements, or all weights 1; ale-rancf when omitted"},
       {"weights", choice({"material", "constant"}),
        "whether weights follow the material or stay with the element, as the paper's; material when "
        "omitted"},
       {"merge", choice({"default", "paper", "ones"}),
        "for comparison, with constant weights: the paper's weights of merged elements (Eqs. 31-38), or "
        "ones; "
        "the nodes keep their velocities then"},
       {"metric", choice({"reference", "none"}),
        "metric of the material coordinate; none: the subdivision paper's elements, for comparison, with "
        "spatial "
        "curvature and no sliding bodies; reference when omitted"},
       {"torsion", boolean(),
        "the beam bends about its section's own axes and twists, in space; when omitted true with `orientation` or "
        "`second_moments`, and, where `stress_free` does not say \"straight\", where the axis is curved in space, "
        "where a drawn profile in space does not bend alike in all directions and where a support, joint, load or body "
        "needs its sections"},
       {"orientation", orientation(), "how the sections of a beam with torsion are drawn"},
       {"stress_free", choice({"as-drawn", "straight", "as-drawn-without-torsion"}),
        "the unstressed shape; when omitted as-drawn in planar models and with torsion, else straight"},
       {"curvature", choice({"material", "spatial"}),
        "curvature measure; spatial: the papers'; material when omitted"},
       {"axial_strain", choice({"ends-and-mean", "pointwise"}),
        "the axial strain that carries: the quadratic with its values at the element's ends and its mean, or that at "
        "every point, as in the papers, which locks in slender beams; when omitted ends-and-mean, but pointwise with "
        "constant weights, without metric and with form virtual-work"},
       {"tension", quantity(Dimension::force, plausible(-1e12, 1e12)),
        "axial force that the beam has as drawn; negative, of a beam that bends: a thrust; 0 when omitted"},
       {"unstressed_length", quantity(Dimension::length, positive()),
        "length of the beam when it is free, if it is not drawn so: the drawing is then its place and, scaled, its "
        "unstressed shape; the drawn length when omitted"},
       {"temperature",
        either(quantity(Dimension::temperature, temperature_range()),
               table(Dimension::temperature, temperature_range())),
        "how much warmer it is than when it has its unstressed length, or that over time; needs "
        "material.thermal_expansion"},
       {"initial", initial(), "how it moves at time 0; at rest when omitted"},
       {"form", choice({"variational", "virtual-work"}),
        "form of the forces on moving elements; virtual-work: the paper's, for comparison, which drifts; "
        "variational when omitted"},
       {"closed", boolean(), "true: a ring, whose end is its start; else a closed axis is open at its seam"},
       {"corners", choice({"error", "smooth", "rigid", "hinge"}),
        "what a corner of the axis is; smooth: rounded, if small; rigid: kept, with its angle; error when "
        "omitted"},
       {"smooth_up_to", quantity(Dimension::angle, {.lower = 0, .upper = 45, .open = true}),
        "greatest corner that is rounded, whatever greater ones are; when omitted 5 with smooth, "
        "else none",
        false, "corners"},
       {"approximation_tolerance", quantity(Dimension::length, positive()),
        "greatest deviation of the cubics from an axis of degree above 3; 1e-6 m, and of its "
        "length, when omitted"}},
      {{{"tension", "unstressed_length"}, false}});
}

Shape analysis() {
  const Shape integrator = object(
      {{"type", choice({"generalized-alpha", "radau", "ida", "rk4"}),
        "radau: Radau IIA of order five, for adaptive or long steps; ida: SUNDIALS' BDF of variable order, slow "
        "on stiff beams without damping; rk4: explicit, fixed `step`, no sliding bodies; generalized-alpha when "
        "omitted"},
       {"rho_infinity", quantity(Dimension::number, {.lower = 0, .upper = 1}),
        "spectral radius of generalized-alpha at infinite frequency; 0.8 when omitted"}});
  const Shape length_control =
      object({{"min", quantity(Dimension::number, {.lower = 0, .upper = 1, .open = true}),
               "a shorter element is merged; 0.1 when omitted (the paper's: 0.5)"},
              {"max", quantity(Dimension::number, {.lower = 1, .open = true}),
               "a longer element is split; 1.15 when omitted (the paper's: 1.5)"}});
  const Shape modes = object(
      {{"count", integer({.lower = 1, .upper = 1000}), "how many, from the lowest on; 10 when omitted"},
       {"about", choice({"equilibrium", "drawn"}),
        "the state: in equilibrium under all loads, for buckling under gravity; or as drawn, without loads; "
        "equilibrium when omitted"},
       {"bodies", choice({"held", "free"}),
        "sliding bodies are held at their `at`, or slide without friction, about where they rest; held when "
        "omitted"}});
  return object(
      {{"type", choice({"dynamic", "static", "modes", "buckling"}),
        "motion, equilibrium, natural frequencies, or the factors of the loads under which it "
        "buckles; dynamic when omitted"},
       {"modes", modes, "of modes and buckling"},
       {"initial", choice({"as-drawn", "equilibrium"}),
        "state at time 0; equilibrium: statics first, sliding bodies held at their `at`; as-drawn "
        "when omitted"},
       {"end_time", quantity(Dimension::time, plausible(1e-9, 1e9)),
        "end of the motion; a dynamic analysis needs it"},
       {"step", quantity(Dimension::time, time_step()),
        "fixed step; with ida how often length control looks"},
       {"tolerance",
        quantity(Dimension::number,
                 {.lower = 1e-14, .upper = 1, .reason = "less is round-off, more no accuracy"}),
        "local error of adaptive steps; 1e-4 when nothing is said, 1e-8 with ida"},
       {"load_steps",
        either(integer({.lower = 1, .upper = 10000}), array(quantity(Dimension::number, not_negative()), 1)),
        "of a static analysis: the state under each of these factors of the loads (weight is always there "
        "in full), increasing, or under so many equal steps up to 1; tables over time are read at the "
        "factor, and a force that moves is there in full where it is at that time; when omitted one state under the "
        "full loads, at the time 0, or 1 where a table or a moving force is read"},
       {"integrator", integrator, "time integrator"},
       {"length_control", length_control,
        "when elements beside a sliding body change, in standard element lengths"}},
      {{{"step", "tolerance"}, false}});
}

Shape output() {
  const Shape cad = object(
      {{"formats",
        array(choice({"step", "iges", "dxf", "brep", "step-solid", "step-section-lines", "step-source"}), 1),
        "file formats; step when omitted"},
       {"times", either(choice({"all"}), array(quantity(Dimension::time, not_negative()))),
        "times to write (of a static analysis its load factors), or all stored frames as a numbered sequence; the end time when omitted"},
       {"unit", choice({"mm", "m", "inch", "in"}), "length unit of the files; mm when omitted"},
       {"schema", choice({"ap214", "ap242"}), "application protocol of STEP files; ap214 when omitted"},
       {"parameter", choice({"free", "material"}),
        "parameter of the curves: free for the fewest control points, or reference arc length; free "
        "when omitted"}});
  return object(
      {{"every", quantity(Dimension::time, time_step()),
        "time between stored frames; a hundredth of `end_time` when omitted, but no less than `step`"},
       {"cad", cad, "deformed axes as CAD files"},
       {"probes", short_array(probe_fields().shape()), "points whose motion is stored"},
       {"paraview", boolean(), "a series of ParaView files, frames.pvd; false when omitted"},
       {"report", boolean(), "report.html; true when omitted"}});
}

Shape air() {
  return object({{"density", quantity(Dimension::density, plausible(0, 1e4)), "mass per volume", required},
                 {"wind", vector(Dimension::speed, plausible(-1e3, 1e3)),
                  "velocity of the air, everywhere alike; still when omitted"}});
}

}  // namespace

bool Range::contains(double value) const {
  return open ? value > lower && value < upper : value >= lower && value <= upper;
}

std::string Range::rule() const {
  std::ostringstream rule;
  if (lower == upper)
    rule << lower;
  else if (std::isfinite(lower) && std::isfinite(upper))
    rule << "between " << lower << " and " << upper << (open ? " (both excluded)" : "");
  else if (std::isfinite(lower))
    rule << (open ? "greater than " : "at least ") << lower;
  else
    rule << (open ? "less than " : "at most ") << upper;
  return rule.str();
}

const Shape& case_keys() {
  static const Shape shape =
      object({{"$schema", any_text(), "for editors; ignored"},
              {"nurbeam", integer({.lower = 1, .upper = 1, .reason = "this version reads format 1"}),
               "version of the case-file format", required},
              {"name", any_text(), "title of the case; the file's name when omitted"},
              {"gravity", vector(Dimension::acceleration, plausible(-1e6, 1e6)),
               "acceleration of gravity; [0, 0, -9.81] when omitted"},
              {"air", air(), "what drags on bodies with a `drag_area`; none when omitted"},
              {"beams", array(beam(), 1), "the beams", required},
              {"bodies", array(body_fields().shape()),
               "point masses: each slides on a beam or on several that cross, or hangs on connectors"},
              {"loads", short_array(load_fields().shape()), "forces and moments"},
              {"supports", array(support_fields().shape()), "where beams are held"},
              {"sliding_joints", array(sliding_joint_fields().shape()), "which body slides on which beam"},
              {"eyelets", array(eyelet_fields().shape()), "fixed rings that beams run through"},
              {"stops", array(stop_fields().shape()), "what sliding bodies come up against"},
              {"joints", array(beam_joint_fields().shape()), "which beams are joined to each other"},
              {"connectors", short_array(connector_fields().shape()),
               "springs, ropes and rods between bodies, beams and points"},
              {"analysis", analysis(), "what to compute", required},
              {"output", output(), "what to store"}});
  return shape;
}

}  // namespace nurbeam
