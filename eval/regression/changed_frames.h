#pragma once

#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "reports/comparison/comparison.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// Pictures of the most changed frames: what the camera saw, with outlines of the true hand (white), the
/// baseline's (blue) and the candidate's (orange). A panel is left out if its run kept no estimates. A frame has
/// no picture unless its truth is the program's current one and the cameras are the synthetic Kinect's.
std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::RunResult& candidate, const FileSet& baseline_files,
                                              const FileSet& candidate_files);

}  // namespace glovebench::eval
