#pragma once
#include <type_traits>

/// NURBEAM_HOOK(name): names_NAME<T>, whether the class T has a member of that name, whatever its kind and
/// parameters. A class that inherits the name twice cannot say which it means.
#define NURBEAM_HOOK(name)                             \
  struct OtherMember_##name {                          \
    int name;                                          \
  };                                                   \
  template <class T>                                   \
  struct TwoMembers_##name : T, OtherMember_##name {}; \
  template <class T>                                   \
  inline constexpr bool names_##name = !requires {     \
    &TwoMembers_##name<T>::name;                       \
  }

namespace nurbeam::hooks {

// Names that forces and constraints share.
NURBEAM_HOOK(work);
NURBEAM_HOOK(on_body);
NURBEAM_HOOK(connector);

}  // namespace nurbeam::hooks

namespace nurbeam {

/// Whether a class keeps its word on one hook: it is there as it is asked for, or there is nothing of that
/// name.
consteval bool keeps_word(bool offered, bool named, bool fits) { return offered ? named && fits : !named; }

/// What the class of a force or a constraint says that it offers.
template <class T>
inline constexpr auto offers_of = std::remove_cvref_t<T>::offers;

}  // namespace nurbeam
