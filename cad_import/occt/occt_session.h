#pragma once

/// What every use of OpenCASCADE's translators begins with.
namespace nurbeam {

/// No signal handlers, and nothing printed.
void be_silent();
/// The STEP and the IGES translator, in millimetres.
void start_step();
void start_iges();

}  // namespace nurbeam
