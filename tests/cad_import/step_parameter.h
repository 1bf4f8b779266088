#pragma once
#include <gtest/gtest.h>

#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <string>

namespace nurbeam {

/// A parameter of OpenCASCADE's STEP translator while this lives. It belongs to the process: a test that left
/// it changed would change the files of those after it.
class StepParameter {
 public:
  StepParameter(const char* name, const char* value) : name_(name) {
    STEPControl_Controller::Init();
    before_ = Interface_Static::CVal(name);
    EXPECT_TRUE(Interface_Static::SetCVal(name, value));
  }
  ~StepParameter() { Interface_Static::SetCVal(name_, before_.c_str()); }
  StepParameter(const StepParameter&) = delete;
  StepParameter& operator=(const StepParameter&) = delete;

 private:
  const char* name_;
  std::string before_;
};

}  // namespace nurbeam
