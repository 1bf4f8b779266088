#pragma once
#include <utility>
#include <variant>

#include "fem/material/force_over_stretch.h"
#include "fem/material/green_law.h"
#include "fem/material/hooke_law.h"

namespace nurbeam {

/// The axial laws: a new one is a file, with `operator()(EA, strain, free)`, and a place in this list.
/// `strain` is the Green strain less the free one; the law is asked for doubles and for numbers side by side.
using AxialLaw = std::variant<GreenLaw, HookeLaw, ForceOverStretch>;

/// Energy, force and stiffness of a beam's law at a strain.
template <class T>
NURBEAM_WITHIN AxialPoint<T> axial_point(const AxialLaw& law, double EA, const T& strain, double free) {
  AxialPoint<T> point;
  const auto ask = [&]<std::size_t i>() {
    const auto* own = std::get_if<i>(&law);
    if (own) point = (*own)(EA, strain, free);
    return own != nullptr;
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) { (ask.template operator()<i>() || ...); }
  (std::make_index_sequence<std::variant_size_v<AxialLaw>>());
  return point;
}

/// The engineering strain of a free beam under a force [N]; `EA` per its own length [N].
inline double stretch_under(const AxialLaw& law, double EA, double force) {
  const auto* rows = std::get_if<ForceOverStretch>(&law);
  return rows ? rows->rows().stretch(force) : force / EA;
}

}  // namespace nurbeam
