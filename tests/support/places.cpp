#include "tests/support/places.h"

namespace nurbeam::test {

std::filesystem::path source_directory() { return NURBEAM_SOURCE_DIR; }
std::filesystem::path nurbeam_program() { return NURBEAM_EXECUTABLE; }
std::filesystem::path misbehaving_program() { return MISBEHAVING_PROGRAM; }

}  // namespace nurbeam::test
