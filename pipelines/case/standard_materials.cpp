#include "pipelines/case/standard_materials.h"

namespace nurbeam {

const std::vector<StandardMaterial>& standard_materials() {
  static const std::vector<StandardMaterial> table = {
      {"steel", 7850, 210e9, 0.3, 12e-6},         {"stainless-steel", 7900, 200e9, 0.3, 16e-6},
      {"aluminium", 2700, 70e9, 0.3, 23e-6},      {"copper", 8960, 120e9, 0.34, 17e-6},
      {"brass", 8500, 100e9, 0.35, 19e-6},        {"titanium", 4510, 105e9, 0.37, 8.6e-6},
      {"concrete", 2500, 33e9, 0.2, 10e-6},       {"polyamide", 1140, 2.7e9, 0.39, 80e-6},
      {"polyethylene", 950, 1.0e9, 0.42, 180e-6},
  };
  return table;
}

std::vector<std::string> standard_material_names() {
  std::vector<std::string> names;
  for (const StandardMaterial& material : standard_materials()) names.emplace_back(material.name);
  return names;
}

const StandardMaterial* standard_material(const std::string& name) {
  for (const StandardMaterial& material : standard_materials())
    if (material.name == name) return &material;
  return nullptr;
}

}  // namespace nurbeam
