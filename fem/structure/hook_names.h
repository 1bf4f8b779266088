#pragma once
#include <type_traits>

/// NURBEAM_HOOK(name) defines names_NAME<T>: whether class T has a member of that name, of any kind and with
/// any parameters. A class that inherits the name twice counts as having it.
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

/// Whether a class keeps its word on one hook. An offered hook must exist with the right signature; a hook
/// that is not offered must not be named at all.
consteval bool keeps_word(bool offered, bool named, bool fits) { return offered ? named && fits : !named; }

/// The hooks that the class of a force or a constraint declares.
template <class T>
inline constexpr auto offers_of = std::remove_cvref_t<T>::offers;

}  // namespace nurbeam
