#pragma once
#include <filesystem>

namespace nurbeam::test {

/// Where the checkout lies that is tested. Only places.cpp knows: what is compiled of the others serves every
/// checkout.
std::filesystem::path source_directory();
/// The programs under test, of this build.
std::filesystem::path nurbeam_program();
std::filesystem::path misbehaving_program();

}  // namespace nurbeam::test
