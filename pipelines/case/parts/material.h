#pragma once
#include "fem/material/compression.h"
#include "pipelines/case/fields.h"
#include "pipelines/case/force_laws.h"
#include "pipelines/case/standard_materials.h"

namespace nurbeam {

struct CaseMaterial {
  double density = 0;                            ///< [kg/m^3]
  double youngs_modulus = 0;                     ///< [Pa]
  double damping = 0;                            ///< [s], theory c
  std::optional<double> shear_modulus = {};      ///< [Pa]
  std::optional<double> poissons_ratio = {};     ///< one of them at most
  std::optional<double> thermal_expansion = {};  ///< [1/K]
  double mass_damping = 0;                       ///< [1/s], alpha
  double stiffness_damping = 0;                  ///< [s], beta
  std::optional<AxialLaw> law = {};              ///< Green's law when nothing is said
  Compression compression = Compression::full;
  std::string name = {};  ///< of a standard material whose numbers it has
};

inline Fields<CaseMaterial> material_fields() {
  using namespace shapes;
  using M = CaseMaterial;
  return {
      {
          field(&M::name, "name", choice(standard_material_names()),
                "a standard material, which gives what is not given beside it"),
          field(&M::density, "density", quantity(Dimension::density, plausible(1e-3, 1e6)),
                "mass per volume; needed without `name`"),
          field(&M::youngs_modulus, "youngs_modulus", quantity(Dimension::pressure, plausible(1, 1e16)),
                "Young's modulus, of a rope the effective one; needed without `name`"),
          field(&M::damping, "damping", quantity(Dimension::time, plausible(0, 1e9)),
                "time c of the stress c E d(strain)/dt")
              .otherwise("0"),
          field(&M::mass_damping, "mass_damping", quantity(Dimension::rate, plausible(0, 1e9)),
                "rate alpha of the force -alpha density area v on the velocity v")
              .otherwise("0"),
          field(
              &M::stiffness_damping, "stiffness_damping", quantity(Dimension::time, plausible(0, 1e9)),
              "time beta of Rayleigh's damping: as `damping`, and beta times the stiffness that tension gives, "
              "which damps taut strings too")
              .otherwise("0"),
          choice_field(
              &M::compression, "compression",
              {{"full", Compression::full}, {"buckles", Compression::buckles}},
              "the axial force under compression. full: that of the law; buckles: of slack ropes, no "
              "more than 40 EI/l^2 with the length l of an element, as if the rope buckled between two "
              "nodes, and a thousandth of EA beyond")
              .otherwise("full"),
          field(&M::thermal_expansion, "thermal_expansion",
                quantity(Dimension::thermal_expansion, plausible(-1e-2, 1e-2)),
                "strain per kelvin of the beam's `temperature`"),
          field_by<M>(
              "law",
              either(choice({"green", "hooke"}),
                     rows_over("stretch", Dimension::number, Dimension::force, plausible(-1e12, 1e12))),
              "axial force over stretch, where strains are large. green: N = EA (L^3 - L)/2 of the stretched over "
              "the unstressed length L, as in the papers; hooke: N = EA (L - 1); rows [L - 1, N] of force over "
              "stretch, both of which increase: smooth between the rows, straight beyond them; bending and "
              "damping use youngs_modulus; green when omitted",
              [](const Json& json, const std::string& path, M& material, Findings& findings) {
                material.law = axial_law(json, path, findings);
              }),
          field(&M::shear_modulus, "shear_modulus", quantity(Dimension::pressure, plausible(1, 1e16)),
                "of beams with torsion"),
          field(&M::poissons_ratio, "poissons_ratio",
                quantity(Dimension::number, {.lower = -0.99, .upper = 0.5}),
                "gives the shear modulus; 0.3 when neither is given"),
      },
      {{{"shear_modulus", "poissons_ratio"}, false}}};
}

}  // namespace nurbeam
