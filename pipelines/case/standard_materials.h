#pragma once
#include <string>
#include <vector>

namespace nurbeam {

/// The usual numbers of a material at room temperature; a case may give any of them otherwise.
struct StandardMaterial {
  const char* name;
  double density;            ///< [kg/m^3]
  double youngs_modulus;     ///< [Pa]
  double poissons_ratio;     ///< [-]
  double thermal_expansion;  ///< [1/K]
};

/// Structural steel, stainless steel, aluminium and concrete C30/37 as in Eurocodes 3 (1-1, 1-4), 9 and 2;
/// the others as in handbooks of materials.
const std::vector<StandardMaterial>& standard_materials();
std::vector<std::string> standard_material_names();
/// Nothing (null) for a name that is not among them.
const StandardMaterial* standard_material(const std::string& name);

}  // namespace nurbeam
