#pragma once

#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "reports/comparison/comparison.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// The most changed frames of a comparison: what the camera saw, and over it the outlines of the true hand (white),
/// of the baseline's (blue) and of the candidate's (orange). The estimates are read from the files of the two
/// runs; where one has none (a baseline keeps the results only), its panel is left out. Frames of trajectories that
/// are not the program's own, or have changed since, have no picture.
/// Nor have those of a candidate whose cameras are not the synthetic Kinect's own.
std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::RunResult& candidate, const FileSet& baseline_files,
                                              const FileSet& candidate_files);

}  // namespace glovebench::eval
