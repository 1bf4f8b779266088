#pragma once
#include "cad_import/files/told_share.h"

/// How the time is shared out that reading a file by OpenCASCADE takes, about.
namespace nurbeam::reading_share {

constexpr PartOfWork text{0, 0.3}, translation{0.3, 0.6}, edges{0.6, 1};

}  // namespace nurbeam::reading_share
