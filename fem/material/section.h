#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "fem/material/axial_law.h"
#include "fem/material/axial_strain.h"
#include "fem/material/compression.h"
#include "fem/material/curvature_measure.h"
#include "fem/material/free_strain.h"

namespace nurbeam {

/// The numbers of a cross section. Its bending stiffness is equal in all directions, or bending is in one
/// plane.
struct Section {
  double area = 0;                               ///< A [m^2]
  double second_moment = 0;                      ///< I [m^4]
  std::optional<double> torsion_constant = {};   ///< J [m^4], where it is known
  std::optional<double> radius = {}, bore = {};  ///< of a disk or a pipe, outer and inner [m]
  /// Maximum distance of the section from the axis about which bending turns it [m], where it is known.
  std::optional<double> extreme_fibre = {};

  /// The maximum stress of a section under an axial force [N] and a bending moment [N m], with the sign of
  /// the force: N/A + M c/I [Pa].
  std::optional<double> fibre_stress(double axial_force, double bending_moment) const;

  /// A disk, or with a bore a pipe. Throws std::invalid_argument unless 0 <= bore < radius.
  static Section round(double radius, double bore = 0);
};

struct Material {
  double youngs_modulus = 0;                 ///< E [Pa]
  double density = 0;                        ///< rho [kg/m^3]
  double damping = 0;                        ///< c [s]: stress = E (strain + c d(strain)/dt)
  std::optional<double> shear_modulus = {};  ///< G [Pa], where it is known
  double mass_damping = 0;                   ///< alpha [1/s]: force -alpha rho A v on the material velocity
  double stiffness_damping = 0;              ///< beta [s]: adds to c, and beta times the stiffness of tension
};

/// Stiffness of the sections of a beam with torsion about their own axes d1, d2, and their inertia of spin.
struct SectionStiffness {
  double bending_1 = 0, bending_2 = 0;  ///< EI1, EI2 [N m^2]
  double bending_product = 0;           ///< EI12 [N m^2]
  double torsion = 0;                   ///< GJ [N m^2]
  double spin_inertia = 0;              ///< rho (I_x + I_y) [kg m]

  /// Curvatures that couples about d1 and d2 bend the axis to [1/m].
  double curvature_1(double couple) const { return couple / bending_1; }
  double curvature_2(double couple) const { return couple / bending_2; }

  bool operator==(const SectionStiffness&) const = default;
};

/// Plain numbers in SI that the constitutive law needs of a cross section and its material.
struct BeamProperties {
  double axial_stiffness = 0;    ///< EA [N]
  double bending_stiffness = 0;  ///< EI [N m^2]
  double mass_per_length = 0;    ///< rho A [kg/m]
  double damping = 0;            ///< c [s]
  double mass_damping = 0;       ///< alpha [1/s]
  double tension_damping = 0;    ///< beta [s], for the stiffness that tension gives (BeamElement)
  CurvatureMeasure curvature = CurvatureMeasure::material;
  AxialStrain axial_strain = AxialStrain::ends_and_mean;
  AxialLaw law = GreenLaw();
  Compression compression = Compression::full;    ///< buckles: needs AxialStrain::ends_and_mean
  std::optional<SectionStiffness> sections = {};  ///< for a beam with torsion, in space
  FreeStrain free_strain = {};                    ///< needs AxialStrain::ends_and_mean

  /// EA where it multiplies a pointwise strain; else 0.
  double pointwise_axial_stiffness() const {
    return axial_strain == AxialStrain::pointwise ? axial_stiffness : 0;
  }
  /// Axial force S_0 in the drawing [N], for a beam whose free strain comes from S_0.
  double drawn_tension() const;
  /// Gives a beam that is drawn as long as it is free the axial force S_0 [N] as drawn. Its law and its EA
  /// then hold for the length that it has when free. Throws std::invalid_argument where S_0 leaves no length.
  void set_drawn_tension(double S_0);
  /// EA of the free beam, per its own length [N].
  double free_axial_stiffness() const;
  /// Whether bending under a tension [N] reaches less far than a length [m]: sqrt(EI/tension) < length.
  bool bends_within(double length, double tension) const {
    return bending_stiffness < length * length * tension;
  }
  /// EA/l of a length [m] of the beam [N/m].
  double stiffness_of_length(double length) const { return axial_stiffness / length; }
  /// EA eps of a small strain [N]
  double force_of_strain(double strain) const { return axial_stiffness * strain; }
  /// EA eps^2/2 of a small strain [J/m].
  double small_strain_energy(double strain) const { return axial_stiffness * strain * strain / 2; }
  /// The least stiffness of bending about the section's axes [N m^2].
  double least_bending_stiffness() const {
    return sections ? std::min(sections->bending_1, sections->bending_2) : bending_stiffness;
  }
  /// The curvature with this energy per length, in the softest direction; 0 where nothing resists bending
  /// [1/m].
  double mean_bend(double energy_per_length) const {
    const double stiffness = least_bending_stiffness();
    return stiffness > 0 ? std::sqrt(2 * std::max(energy_per_length, 0.0) / stiffness) : 0;
  }
  /// The compressive strain at which a length [m] between two nodes buckles; 0 where nothing resists bending.
  double buckling_strain(double length) const {
    return Buckling::load * least_bending_stiffness() / (length * length * axial_stiffness);
  }
  /// Energy of bending a length [m] evenly by an angle [rad], in the direction that is softest [J].
  double bent_energy(double angle, double length) const {
    return least_bending_stiffness() * angle * angle / (2 * length);
  }
  /// The radius of a disk that bends and stretches as easily [m].
  double radius_of_disk() const { return 2 * std::sqrt(least_bending_stiffness() / axial_stiffness); }
  bool resists_bending() const { return least_bending_stiffness() > 0; }
  /// Curvature that a couple bends the axis to, of a beam without sections of its own [1/m].
  double curvature_of(double couple) const { return couple / bending_stiffness; }
  /// T l^2/EI: how a tension [N] compares with the bending of a length [m].
  double tension_number(double tension, double length) const {
    return tension * length * length / least_bending_stiffness();
  }
  bool is_damped() const { return damping > 0 || mass_damping > 0 || tension_damping > 0; }
  /// EI where the axis alone bends: in the plane, and for round sections in space; 0 for a beam with torsion,
  /// whose sections bend about their own axes.
  double axis_bending_stiffness() const { return sections ? 0 : bending_stiffness; }

  /// Properties per drawn length for a beam that is `stretch` times as long as drawn when it is free. The
  /// energy is that of the unstressed beam, whose curvature is the drawn one over `stretch`.
  BeamProperties with_free_stretch(double stretch) const {
    BeamProperties p = *this;
    p.axial_stiffness /= stretch * stretch * stretch;
    p.bending_stiffness /= stretch;
    p.mass_per_length *= stretch;
    if (p.sections) {
      SectionStiffness& own = *p.sections;
      for (double* stiffness : {&own.bending_1, &own.bending_2, &own.bending_product, &own.torsion})
        *stiffness /= stretch;
      own.spin_inertia *= stretch;
    }
    p.free_strain.constant = (stretch * stretch - 1) / 2;
    return p;
  }

  /// Properties of a beam that bends that many times as easily about all axes.
  BeamProperties with_softer_bending(double times) const {
    BeamProperties p = *this;
    p.bending_stiffness /= times;
    if (p.sections)
      for (double* stiffness : {&p.sections->bending_1, &p.sections->bending_2, &p.sections->bending_product})
        *stiffness /= times;
    return p;
  }

  BeamProperties without_bending() const {
    BeamProperties p = *this;
    p.bending_stiffness = 0;
    return p;
  }

  bool operator==(const BeamProperties&) const = default;

  BeamProperties() = default;
  BeamProperties(double EA, double EI, double rho_A, double c = 0,
                 CurvatureMeasure measure = CurvatureMeasure::material)
      : axial_stiffness(EA), bending_stiffness(EI), mass_per_length(rho_A), damping(c), curvature(measure) {}
  BeamProperties(const Section& section, const Material& material,
                 CurvatureMeasure measure = CurvatureMeasure::material)
      : BeamProperties(material.youngs_modulus * section.area,
                       material.youngs_modulus * section.second_moment, material.density * section.area,
                       material.damping + material.stiffness_damping, measure) {
    mass_damping = material.mass_damping;
    tension_damping = material.stiffness_damping;
  }
};

}  // namespace nurbeam
