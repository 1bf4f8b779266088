#pragma once
#include "pipelines/case/parts/grip.h"

namespace nurbeam {

/// A turn about an axis.
struct CaseTurn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double angle = 0;                           ///< [degrees]
  std::optional<Eigen::Vector3d> about = {};  ///< a point of the axis [m]; the centre of mass when empty
};

/// A part of a body that spins in it at constant speed.
struct CaseRotor {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double inertia = 0;  ///< about the axis [kg m^2]
  double speed = 0;    ///< [rad/s]
};

struct CaseBody {
  std::string name;
  double mass = 0;          ///< [kg]
  double roll_inertia = 0;  ///< of one that follows a section [kg m^2]
  double drag_area = 0;     ///< C_d A [m^2]
  std::string path = {};
  std::string fastened_to;                       ///< the beam to which it is fastened; empty: none
  Place fastened_at = {};                        ///< where on it
  std::optional<Eigen::Vector3d> position = {};  ///< of one that no sliding joint places [m]
  std::optional<Eigen::Vector3d> velocity = {};  ///< likewise; at rest when empty [m/s]

  // Of a rigid body.
  std::optional<Eigen::Matrix3d> inertia = {};                       ///< along `axes` [kg m^2]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();                ///< columns, as drawn
  std::vector<std::pair<std::string, Eigen::Vector3d>> points = {};  ///< as drawn [m]
  CaseTurn turned;                                                   ///< from the drawing to the start
  std::optional<Eigen::Vector3d> angular_velocity = {};              ///< none when empty [rad/s]
  CaseRotor rotor;
  std::string fixed_to;                            ///< the beam that holds it; empty: none
  Place fixed_at = {};                             ///< where on it
  std::string drag_point;                          ///< the point that the air drags at; empty: none
  std::optional<Eigen::Vector3d> drag_place = {};  ///< likewise, as drawn [m]; the centre when empty

  std::string point_of = {};                        ///< of a point: the rigid body
  Eigen::Vector3d drawn = Eigen::Vector3d::Zero();  ///< of a point: where it is drawn [m]
  std::string drawn_on = {};                        ///< of a point on a beam: the beam that says where it is
  Place drawn_at = {};                              ///< where on it
};

inline Fields<CaseTurn> turn_fields() {
  using namespace shapes;
  using T = CaseTurn;
  return {{
      field(&T::axis, "axis", direction(), "the direction that it turns about, by the right hand").needed(),
      field(&T::angle, "angle", quantity(Dimension::angle, plausible(-1e6, 1e6)), "by how much").needed(),
      field(&T::about, "about", point(), "a point of the axis; the centre of mass when omitted"),
  }};
}

inline Fields<CaseRotor> rotor_fields() {
  using namespace shapes;
  using R = CaseRotor;
  return {{
      field(&R::axis, "axis", direction(), "of its spin, in the reference configuration, by the right hand")
          .needed(),
      field(&R::inertia, "inertia", quantity(Dimension::inertia, positive()), "about that axis").needed(),
      field(&R::speed, "speed", quantity(Dimension::angular_speed, plausible(-1e6, 1e6)),
            "of its spin against the body")
          .needed(),
  }};
}

/// Takes the points of a rigid body by their names.
void take_points(const Json& value, CaseBody& body);
/// [Ixx, Iyy, Izz] or with Ixy, Iyz, Ixz behind.
Eigen::Matrix3d inertia_matrix(const std::vector<double>& components);

inline Fields<CaseBody> body_fields() {
  using namespace shapes;
  using B = CaseBody;
  const Range mass{
      .lower = 1e-9,
      .upper = 1e12,
      .reason = "a body without mass has no inertia; what lies outside is most likely in another unit"};
  Shape inertia = array(quantity(Dimension::inertia, plausible(-1e16, 1e16)), 3);
  inertia.most_items = 6;
  return {{
      field(&B::name, "name", name(), "name of the body").needed(),
      field(&B::mass, "mass", quantity(Dimension::mass, mass), "mass").needed(),
      field(&B::roll_inertia, "roll_inertia", quantity(Dimension::inertia, plausible(0, 1e16)),
            "about the beam, of a body that follows its section")
          .otherwise("0"),
      field(&B::drag_area, "drag_area", quantity(Dimension::area, plausible(0, 1e6)),
            "drag coefficient times area, of the drag of the `air`")
          .otherwise("0"),
      field_by<B>("drag_at", either(name(), point()),
                  "where the air drags a rigid body: the name of one of its points, or a point of it in the "
                  "reference configuration; its centre of mass when omitted",
                  [](const Json& json, const std::string& path, B& body, Findings& findings) {
                    CaseGrip grip{.body = body.name};
                    take_place(json, path, grip, findings);
                    body.drag_point = grip.body_point;
                    body.drag_place = grip.body_place;
                  })
          .beside("drag_area"),
      field(
          &B::position, "position", point(),
          "where a body without a sliding joint starts; of a rigid body its centre of mass in the reference "
          "configuration"),
      field_by<B>(
          "inertia", inertia,
          "makes it a rigid body, which rotates: [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] about "
          "its centre of mass, along `axes`; Ixy is the integral of x y; a point mass when omitted",
          [](const Json& json, const std::string& path, B& body, Findings& findings) {
            std::vector<double> components;
            take(json, components);
            if (components.size() != 3 && components.size() != 6)
              findings.error(path, "has " + std::to_string(components.size()) +
                                       " numbers; must be [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Iyz, Ixz]");
            else
              body.inertia = inertia_matrix(components);
          }),
      field_by<B>("axes",
                  object({{"x", direction(), "its x axis", required},
                          {"z", direction(), "its z axis, perpendicular to x", required}}),
                  "body axes of a rigid body, in the reference configuration; the axes of space when omitted",
                  [](const Json& json, const std::string& path, B& body, Findings& findings) {
                    Eigen::Vector3d x = Eigen::Vector3d::Zero(), z = x;
                    if (const Json* value = value_under(json, "x")) take(*value, x);
                    if (const Json* value = value_under(json, "z")) take(*value, z);
                    if (!(x.norm() > 0 && z.norm() > 0) || std::abs(x.dot(z)) > 1e-6 * x.norm() * z.norm()) {
                      findings.error(
                          path, "has an x and a z axis that are not square to each other, or of no length");
                      return;
                    }
                    body.axes.col(0) = x.normalized();
                    body.axes.col(2) = z.normalized();
                    body.axes.col(1) = body.axes.col(2).cross(body.axes.col(0));
                  })
          .beside("inertia"),
      field_by<B>("points", map(point()),
                  "points of a rigid body by their names, in the reference configuration",
                  [](const Json& json, const std::string&, B& body, Findings&) { take_points(json, body); })
          .beside("inertia"),
      object_field(&B::turned, "turned", turn_fields(),
                   "rotates a rigid body with its points from the reference configuration to its start")
          .beside("inertia"),
      field(&B::angular_velocity, "angular_velocity", vector(Dimension::angular_speed, plausible(-1e6, 1e6)),
            "of a rigid body at the start, along the axes of space; none when omitted")
          .beside("inertia"),
      object_field(&B::rotor, "rotor", rotor_fields(),
                   "a part of a rigid body that rotates in it at a constant speed")
          .beside("inertia"),
      field_by<B>(
          "fastened",
          object({{"beam", name(), "the beam", required}, {"at", place(), "position on it", required}}),
          "a weight fastened to a position of a beam, as at a rope's end",
          [](const Json& json, const std::string&, B& body, Findings&) {
            if (const Json* beam = value_under(json, "beam")) take(*beam, body.fastened_to);
            if (const Json* at = value_under(json, "at")) take(*at, body.fastened_at);
          }),
      field_by<B>(
          "fixed_to",
          object({{"beam", name(), "the beam", required}, {"at", place(), "position on it", required}}),
          "holds a rigid body at a position of a beam with torsion, its attitude too, as a disc on a shaft; its "
          "centre of mass is there where `position` does not say",
          [](const Json& json, const std::string&, B& body, Findings&) {
            if (const Json* beam = value_under(json, "beam")) take(*beam, body.fixed_to);
            if (const Json* at = value_under(json, "at")) take(*at, body.fixed_at);
          })
          .beside("inertia"),
      field(&B::velocity, "velocity", vector(Dimension::speed, plausible(-1e9, 1e9)),
            "how fast it starts; at rest when omitted")
          .beside("position"),
  }};
}

}  // namespace nurbeam
