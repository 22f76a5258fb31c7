#pragma once

#include <vector>

#include "core/base/file_set.h"
#include "reports/comparison/comparison.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// The most changed frames: camera images with outlines of true hand (white), baseline (blue) and candidate
/// (orange). Skips frames without stored estimates, or with other truths or cameras.
std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::RunResult& candidate, const FileSet& baseline_files,
                                              const FileSet& candidate_files);

}  // namespace glovebench::eval
