#pragma once

#include <span>
#include <string_view>

#include "eval/studies/study.h"

namespace glovebench::eval {

/// A difference from the paper, or a point that it leaves open.
struct Deviation {
  std::string_view name;                    ///< at most 14 letters
  std::string_view paper;                   ///< its words and their section
  std::string_view ours;                    ///< of profile `paper`
  std::string_view instead;                 ///< what `change` does, or why nothing is measured
  void (*change)(RunSpec& spec) = nullptr;  ///< null: not measured
};
/// In the order of the tracker's stages, then of the experiments.
std::span<const Deviation> deviations();

/// `runs`: by trajectory, with the setting "" (profile `paper`) and the name of each measured deviation.
reports::Table deviations_table(const Runs& runs);

}  // namespace glovebench::eval
