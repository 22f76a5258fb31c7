#pragma once

#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/page.h"

namespace glovebench::eval {

/// The most changed frames of a comparison: what the camera saw, and over it the outlines of the true hand (white),
/// of the baseline's (blue) and of the candidate's (orange). The estimates are read from the folders of the two
/// runs; where one has none (a baseline keeps the results only), its panel is left out. Frames of trajectories that
/// are not the program's own, or have changed since, have no picture.
/// `inputs` are the candidate's.
std::vector<reports::Picture> picture_changes(const reports::Comparison& comparison,
                                              const reports::InputHashes& inputs,
                                              const std::string& baseline_folder,
                                              const std::string& candidate_folder);

}  // namespace glovebench::eval
