#include <gtest/gtest.h>

#include <sstream>

#include "pipelines/section/cgal_geometry.h"
#include "pipelines/section/section_profile.h"
#include "tests/support/profiles.h"

namespace nurbeam {
namespace {

// This program has without_cgal.cpp in place of CGAL, however the libraries are built.

TEST(WithoutCgal, AllOfAProfileButItsTorsionConstantIsThere) {
  ASSERT_FALSE(has_cgal());
  const ProfileReport report = section_profile(imported({rectangle(0.1, 0.3)}), "profile.step");
  std::ostringstream out;
  print_profile(out, report.value.value());
  EXPECT_NE(out.str().find("I_x 0.000225, I_y 2.5e-05"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("not computed: this build is without CGAL (-DNURBEAM_WITH_CGAL=ON)"),
            std::string::npos)
      << out.str();
}

}  // namespace
}  // namespace nurbeam
