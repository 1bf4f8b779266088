#include "cad_import/dxf/drawing_unit.h"

#include <array>
#include <numbers>

namespace nurbeam {
namespace {

constexpr double astronomical_unit = 149'597'870'700.0, light_year = 9'460'730'472'580'800.0;

const std::array<NamedUnit, 24> units{{{"inch", 0.0254},
                                       {"ft", 0.3048},
                                       {"mile", 1609.344},
                                       {"mm", 1e-3},
                                       {"cm", 1e-2},
                                       {"m", 1},
                                       {"km", 1e3},
                                       {"microinch", 2.54e-8},
                                       {"mil", 2.54e-5},
                                       {"yard", 0.9144},
                                       {"angstrom", 1e-10},
                                       {"nm", 1e-9},
                                       {"um", 1e-6},
                                       {"dm", 0.1},
                                       {"dam", 10},
                                       {"hm", 100},
                                       {"Gm", 1e9},
                                       {"au", astronomical_unit},
                                       {"light year", light_year},
                                       {"parsec", astronomical_unit * 648'000 / std::numbers::pi},
                                       {"US survey ft", 1200.0 / 3937},
                                       {"US survey inch", 100.0 / 3937},
                                       {"US survey yard", 3600.0 / 3937},
                                       {"US survey mile", 6'336'000.0 / 3937}}};

}  // namespace

std::optional<NamedUnit> drawing_unit(int insunits) {
  if (insunits < 1 || insunits > static_cast<int>(units.size())) return std::nullopt;
  return units[static_cast<std::size_t>(insunits - 1)];
}

}  // namespace nurbeam
