#pragma once

#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "reports/comparison/comparison.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// The most changed frames: camera image with outlines of the true hand (white), the baseline's (blue) and the
/// candidate's (orange). Leaves out panels without estimates, and frames unless their truth is the program's
/// current one and the cameras are the synthetic Kinect's.
std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::RunResult& candidate, const FileSet& baseline_files,
                                              const FileSet& candidate_files);

}  // namespace glovebench::eval
