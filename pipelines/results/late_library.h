#pragma once

namespace nurbeam {

/// A shared library that is loaded when it is needed, and then stays: for those that few commands need and
/// that take long to load.
class LateLibrary {
 public:
  /// `file`: its name, as the dynamic loader looks for it. Throws std::runtime_error (name and reason).
  explicit LateLibrary(const char* file);
  /// The function of that name, which must have that type (a pointer). Throws std::runtime_error.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(address_of(name));
  }

 private:
  void* address_of(const char* name) const;

  const char* file_;
  void* handle_;
};

}  // namespace nurbeam
