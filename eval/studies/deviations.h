#pragma once

#include <span>
#include <string_view>

#include "eval/studies/study.h"

namespace glovebench::eval {

/// Something that the tracker or the experiment does in another way than the paper says, or that the paper leaves
/// open.
struct Deviation {
  std::string_view name;                    ///< at most 14 letters, for a terminal
  std::string_view paper;                   ///< its words and their section
  std::string_view ours;                    ///< of profile `paper`
  std::string_view instead;                 ///< what `change` does; without it, why nothing is measured
  void (*change)(RunSpec& spec) = nullptr;  ///< to the paper's words; null: not measured
};
/// In the order of the tracker's stages, then of the experiments.
std::span<const Deviation> deviations();

/// Table "deviations". `runs`: each spec with the setting "" (profile `paper`) and the name of each measured
/// deviation, by trajectory.
reports::Table deviations_table(const Runs& runs);

}  // namespace glovebench::eval
