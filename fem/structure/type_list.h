#pragma once

namespace nurbeam {

/// An ordered list of types.
template <class... Types>
struct TypeList {
  /// Calls visit.template operator()<Type>() for each in turn.
  template <class Visit>
  static void for_each(Visit&& visit) {
    (visit.template operator()<Types>(), ...);
  }
};

}  // namespace nurbeam
