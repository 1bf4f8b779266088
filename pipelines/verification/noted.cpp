#include "pipelines/verification/noted.h"

namespace nurbeam::verification {

namespace {

// A problem runs on one thread.
thread_local Features found;

}  // namespace

Features take_noted() { return std::exchange(found, {}); }

void note(const Features& features) { found.insert(features.begin(), features.end()); }

}  // namespace nurbeam::verification
