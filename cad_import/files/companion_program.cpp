#include "cad_import/files/companion_program.h"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace nurbeam {

namespace {

// The folder of the shared library that this function is in; of the program, where it is in none.
std::filesystem::path this_library() {
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&this_library), &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  return std::filesystem::canonical(info.dli_fname, ignored).parent_path();
}

}  // namespace

std::filesystem::path CompanionProgram::find() const {
  namespace fs = std::filesystem;
  std::vector<fs::path> places;
  std::error_code error;
  if (const char* named = std::getenv(variable.c_str())) {
    if (fs::is_regular_file(named, error)) return named;
    throw std::runtime_error("the environment variable " + variable + " names " + named +
                             ", which is no file; name the program " + name + ", which " + purpose +
                             ", or unset it");
  }
  for (const fs::path& own : {fs::read_symlink("/proc/self/exe", error).parent_path(), this_library()})
    if (!own.empty())
      for (const std::string& beside : {std::string("."), std::string("../libexec/nurbeam"), "../" + folder,
                                        "../../" + folder, std::string("../../../../libexec/nurbeam")})
        places.push_back(own / beside / name);
  places.push_back(fs::path(NURBEAM_LIBEXEC) / name);
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, error)) return place;
  std::string tried;
  for (const fs::path& place : places)
    tried += (tried.empty() ? "" : ", ") + place.lexically_normal().string();
  throw std::runtime_error("the program " + name + ", which " + purpose + ", is in none of " + tried +
                           "; install it, or name it by the environment variable " + variable);
}

std::filesystem::path cad_program() {
  return CompanionProgram{"nurbeam-cad", "reads and writes CAD files", "NURBEAM_CAD", "cad_import"}.find();
}

std::filesystem::path study_program() {
  return CompanionProgram{"nurbeam-study", "runs studies", "NURBEAM_STUDY", "pipelines"}.find();
}

}  // namespace nurbeam
