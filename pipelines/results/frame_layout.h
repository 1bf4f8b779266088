#pragma once
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "fem/structure/measure.h"
#include "pipelines/results/netcdf_file.h"

/// What the writer and the reader of stored frames share; the layout stands in frame_store.h.
namespace nurbeam {

using Type = NetcdfFile::Type;
using Doubles = std::vector<double>;
using Integers = std::vector<int>;

inline constexpr std::size_t sample_count = 4;

struct EnergyPart {
  const char* name;
  double EnergyRecord::*value;
};
inline constexpr EnergyPart energy_parts[] = {{"kinetic", &EnergyRecord::kinetic},
                                              {"gravity", &EnergyRecord::gravity},
                                              {"axial", &EnergyRecord::axial},
                                              {"bending", &EnergyRecord::bending},
                                              {"dissipated", &EnergyRecord::dissipated},
                                              {"total", &EnergyRecord::total},
                                              {"input", &EnergyRecord::input}};

/// What is known besides where SnapshotNames::friction says that bodies have friction: variables body_NAME,
/// columns NAME.NAME.
struct BodyPart {
  const char* name;
  const char* unit;
  const char* long_name;
  double BodyRecord::*value;
};
inline constexpr BodyPart friction_parts[] = {
    {"friction_force", "N", "friction along the beam on the body, positive towards the beam's end",
     &BodyRecord::friction_force},
    {"stuck", "1", "1 where the body sticks to the beam, 0 where it slides", &BodyRecord::stuck},
    {"drive_force", "N", "force along the beam of the drive that prescribes the place of the body",
     &BodyRecord::drive_force}};

inline std::span<const BodyPart> known_body_parts(const SnapshotNames& names) {
  return names.friction ? std::span<const BodyPart>(friction_parts) : std::span<const BodyPart>();
}

/// A name of SnapshotNames::measures as the name of an object and a quantity.
inline std::pair<std::string, std::string> parts_of_measure(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

/// The unit of a quantity of SnapshotNames::measures.
inline const char* unit_of_measure(const std::string& quantity) {
  for (const RingQuantity& of : ring_quantities)
    if (quantity == of.name) return of.unit;
  for (const TurnQuantity& of : turn_quantities)
    if (quantity == of.name) return of.unit;
  return "m";
}

/// What a connector does: variables connector_NAME, columns NAME.COLUMN.
struct ConnectorPart {
  const char* name;
  const char* unit;
  const char* long_name;
  double ConnectorRecord::*value;
};
inline constexpr ConnectorPart connector_parts[] = {
    {"force", "N", "force that pulls the ends of the connector together", &ConnectorRecord::force},
    {"length", "m", "distance of its ends, or its part along the connector's direction",
     &ConnectorRecord::length}};

struct ConnectorPlace {
  const char* name;
  const char* long_name;
  Eigen::Vector3d ConnectorRecord::*value;
};
inline constexpr ConnectorPlace connector_places[] = {
    {"from_position", "position of the end that its \"from\" names", &ConnectorRecord::from},
    {"to_position", "position of the end that its \"to\" names", &ConnectorRecord::to}};

/// What a probe knows of its section: variables probe_NAME, columns NAME.COLUMN.
struct SectionPart {
  const char* name;
  const char* column;
  const char* unit;
  const char* long_name;
  double SectionRecord::*value;
};
inline constexpr SectionPart section_parts[] = {
    {"axial_force", "axial_force", "N", "elastic axial force, tension positive", &SectionRecord::axial_force},
    {"bending_moment", "moment", "N m", "bending moment, signed in a planar model",
     &SectionRecord::bending_moment},
    {"torque", "torque", "N m", "torque about the tangent, of a beam with torsion", &SectionRecord::torque},
    {"shear_force", "shear_force", "N", "shear force, signed in a planar model", &SectionRecord::shear_force},
    {"stress", "stress", "Pa", "stress of the fibre where it is largest", &SectionRecord::stress}};

/// An extreme value along a beam: variables beam_NAME and, its place, beam_NAME_s; columns NAME.COLUMN.
struct BeamExtreme {
  const char* name;
  const char* column;
  const char* unit;
  const char* long_name;
  Extreme BeamRecord::*value;
  bool least;  ///< of a run the least counts, else the largest magnitude
};
inline constexpr BeamExtreme beam_extremes[] = {
    {"axial_force_min", "axial_force.min", "N", "least axial force along the beam",
     &BeamRecord::axial_force_min, true},
    {"axial_force_max", "axial_force.max", "N", "greatest axial force along the beam",
     &BeamRecord::axial_force_max, false},
    {"moment_max", "moment.max", "N m", "bending moment of the largest magnitude", &BeamRecord::moment_max,
     false},
    {"shear_force_max", "shear_force.max", "N", "shear force of the largest magnitude",
     &BeamRecord::shear_force_max, false},
    {"stress_max", "stress.max", "Pa", "fibre stress of the largest magnitude", &BeamRecord::stress_max,
     false},
    {"displacement_max", "displacement.max", "m", "largest displacement of the axis from the drawing",
     &BeamRecord::displacement_max, false}};

/// What is known besides where SnapshotNames::sections says that beams have torsion; columns stand behind all
/// others.
inline constexpr SectionPart own_axes_parts[] = {
    {"moment_1", "moment_1", "N m", "bending moment about the section's own x axis, d1",
     &SectionRecord::moment_1},
    {"moment_2", "moment_2", "N m", "bending moment about the section's own y axis, d2",
     &SectionRecord::moment_2},
    {"twist", "twist", "rad", "twist of the section since the drawing, against the start of its beam",
     &SectionRecord::twist},
    {"von_mises", "von_mises", "Pa", "von Mises stress of the section where it is largest",
     &SectionRecord::von_mises}};
inline constexpr BeamExtreme own_axes_extremes[] = {
    {"torque_max", "torque.max", "N m", "torque of the largest magnitude", &BeamRecord::torque_max, false},
    {"twist_max", "twist.max", "rad", "twist since the drawing of the largest magnitude",
     &BeamRecord::twist_max, false},
    {"von_mises_max", "von_mises.max", "Pa", "largest von Mises stress", &BeamRecord::von_mises_max, false}};

struct ElementField {
  const char* name;
  const char* unit;
  const char* long_name;
  double ElementRecord::*value;
};
inline constexpr ElementField element_fields[] = {
    {"element_s_start", "m", "reference arc length at the element's start", &ElementRecord::s_start},
    {"element_s_end", "m", "reference arc length at the element's end", &ElementRecord::s_end},
    {"axial_mismatch", "1", "largest difference of the pointwise from the assumed axial strain",
     &ElementRecord::axial_mismatch}};

struct SampledField {
  const char* name;
  const char* unit;
  const char* long_name;
  Eigen::Vector4d ElementRecord::*values;
};
inline constexpr SampledField sampled_fields[] = {
    {"strain", "1", "Green's axial strain that carries", &ElementRecord::strain},
    {"curvature", "m-1", "curvature, signed in a planar model", &ElementRecord::curvature},
    {"axial_force", "N", "elastic axial force, tension positive", &ElementRecord::axial_force},
    {"bending_moment", "N m", "bending moment, signed in a planar model", &ElementRecord::bending_moment},
    {"torque", "N m", "torque about the tangent, of a beam with torsion", &ElementRecord::torque},
    {"shear_force", "N", "shear force, signed in a planar model", &ElementRecord::shear_force},
    {"stress", "Pa", "stress of the fibre where it is largest; missing where the section does not say",
     &ElementRecord::stress}};

inline constexpr SampledField own_axes_fields[] = {
    {"moment_1", "N m", "bending moment about the section's own x axis, d1", &ElementRecord::moment_1},
    {"moment_2", "N m", "bending moment about the section's own y axis, d2", &ElementRecord::moment_2},
    {"twist", "rad", "twist of the section since the drawing, against the start of its beam",
     &ElementRecord::twist},
    {"von_mises", "Pa",
     "von Mises stress of the section where it is largest; missing where the section does not say",
     &ElementRecord::von_mises}};

struct SampledVector {
  const char* name;
  const char* unit;
  const char* long_name;
  Eigen::Matrix<double, 3, 4> ElementRecord::*values;
};
inline constexpr SampledVector section_axes[] = {
    {"section_d1", "1", "the section's own x axis", &ElementRecord::d1},
    {"section_d2", "1", "the section's own y axis", &ElementRecord::d2}};

/// A list, and where beams have torsion the other one behind it.
template <class Part, std::size_t N, std::size_t M>
std::vector<Part> with_own_axes(const Part (&always)[N], const Part (&own_axes)[M], bool sections) {
  std::vector<Part> parts(std::begin(always), std::end(always));
  if (sections) parts.insert(parts.end(), std::begin(own_axes), std::end(own_axes));
  return parts;
}

/// How many rows along each of the dimensions that grow.
struct StoredRows {
  std::size_t frames = 0, elements = 0, nodes = 0, steps = 0;

  StoredRows& operator+=(const StoredRows& other) {
    frames += other.frames;
    elements += other.elements;
    nodes += other.nodes;
    steps += other.steps;
    return *this;
  }
};

/// With those that were handed over before the record.
inline std::size_t element_count(const BeamRecord& beam) { return beam.handed_over + beam.elements.size(); }

inline StoredRows rows_of(const Snapshot& frame) {
  StoredRows rows{.frames = 1, .steps = frame.steps.size()};
  for (const BeamRecord& beam : frame.beams) {
    rows.elements += element_count(beam);
    rows.nodes += beam.node_s.size();
  }
  return rows;
}

/// Files hold the fill value where there is no number.
inline double filled(double value) { return std::isnan(value) ? NetcdfFile::fill : value; }
inline double unfilled(double value) {
  return value == NetcdfFile::fill ? std::numeric_limits<double>::quiet_NaN() : value;
}

template <class Array>
void append(Doubles& values, const Array& array) {
  values.insert(values.end(), array.data(), array.data() + array.size());
}

template <class Visit>
void for_each_element(std::span<const Snapshot> frames, Visit visit) {
  for (const Snapshot& frame : frames)
    for (const BeamRecord& beam : frame.beams)
      for (const ElementRecord& element : beam.elements) visit(element);
}

template <class Visit>
void for_each_element(std::vector<Snapshot>& frames, Visit visit) {
  for (Snapshot& frame : frames)
    for (BeamRecord& beam : frame.beams)
      for (ElementRecord& element : beam.elements) visit(element);
}

inline std::size_t sum(Integers::const_iterator first, Integers::const_iterator last) {
  return std::accumulate(first, last, std::size_t{0});
}

}  // namespace nurbeam
