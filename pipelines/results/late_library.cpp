#include "pipelines/results/late_library.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace nurbeam {

LateLibrary::LateLibrary(const char* file) : file_(file), handle_(dlopen(file, RTLD_LAZY | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(std::string("the library cannot be loaded: ") + dlerror());
}

void* LateLibrary::address_of(const char* name) const {
  void* address = dlsym(handle_, name);
  if (!address) throw std::runtime_error(std::string(file_) + " has no function " + name);
  return address;
}

}  // namespace nurbeam
