#include "eval/studies/study.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace glovebench::eval {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"fig7", "Figure 7: tiny images", run_figure7},
      {"fig8", "Figure 8: matching cascades", run_figure8},
      {"fig9", "Figure 9: sub-sampling", run_figure9},
      {"ablations", "What the paper asserts, one change at a time", run_ablations},
      {"monocular", "Without depth", run_monocular},
  };
  return all;
}

const Study& study(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Study& study : studies()) {
    if (study.name == name) return study;
    known.push_back(study.name);
  }
  throw Error("study", "name", std::string(name), fmt::format("one of {}", fmt::join(known, ", ")));
}

}  // namespace glovebench::eval
