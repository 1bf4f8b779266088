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

Shape air() {
  return object({{"density", quantity(Dimension::density, plausible(0, 1e4)), "mass per volume", required},
                 {"wind", vector(Dimension::speed, plausible(-1e3, 1e3)),
                  "velocity of the air, everywhere alike; still when omitted"}});
}

Shape attraction() {
  return object({{"mu", quantity(Dimension::number, positive()),
                  "its gravitational parameter, in m^3/s^2: 3.986004e14 for the Earth", required},
                 {"centre", vector(Dimension::length, plausible(-1e12, 1e12)), "where it is", required}});
}

Shape frame() {
  return object(
      {{"rate", vector(Dimension::angular_speed, plausible(-1e6, 1e6)),
        "its angular velocity, constant: centrifugal and Coriolis forces act on all mass", required},
       {"about", point(), "a point of the axis about which it turns; the origin when omitted"},
       {"gravity_gradient",
        object({{"radial", vector(Dimension::number), "away from what is orbited, across the `rate`",
                 required}}),
        "the frame is on a circular orbit, with `about` on the orbit: less is attracted what is farther out; "
        "needs `gravity` [0, 0, 0]"}});
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
  static const Shape shape = object(
      {{"$schema", any_text(), "for editors; ignored"},
       {"nurbeam", integer({.lower = 1, .upper = 1, .reason = "this version reads format 1"}),
        "version of the case-file format", required},
       {"name", any_text(), "title of the case; the file's name when omitted"},
       {"gravity", either(vector(Dimension::acceleration, plausible(-1e6, 1e6)), attraction()),
        "acceleration of gravity, or what attracts towards a point; [0, 0, -9.81] when omitted"},
       {"frame", frame(),
        "the frame of reference of all positions and velocities, if it rotates; at rest when omitted"},
       {"air", air(), "what drags on bodies with a `drag_area`; none when omitted"},
       {"beams", array(beam_fields().shape()), "the beams; rigid bodies move without one too"},
       {"bodies", array(body_fields().shape()),
        "point masses and rigid bodies: they slide on beams, hang on connectors, are joined, or fly freely"},
       {"loads", short_array(load_fields().shape()), "forces and moments"},
       {"supports", array(support_fields().shape()), "supports of beams and bodies"},
       {"sliding_joints", array(sliding_joint_fields().shape()), "which body slides on which beam"},
       {"eyelets", array(eyelet_fields().shape()), "rings and pulleys that beams run through"},
       {"reels", array(reel_fields().shape()), "drums and spools at ends of beams"},
       {"stops", array(stop_fields().shape()), "what sliding bodies come up against"},
       {"joints", array(beam_joint_fields().shape()),
        "which beams are joined to each other, and bodies to what"},
       {"connectors", short_array(connector_fields().shape()),
        "springs, ropes and rods between bodies, beams and points"},
       {"collectors", array(collector_fields().shape()),
        "pantographs: sprung masses that press on a wire and travel along it"},
       {"analysis", analysis_shape(), "what to compute", required},
       {"output", output_shape(), "what to store"}});
  return shape;
}

}  // namespace nurbeam
