#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/tracker/tracker_config.h"
#include "eval/run_store.h"
#include "eval/workbench.h"
#include "reports/study.h"

namespace glovebench::eval {

/// What a reproduction is asked for.
struct StudyOptions {
  TrackerConfig tracker;
  std::vector<uint64_t> seeds = {1};
  bool quick = false;             ///< few frames and queries: to see that everything runs, not to measure
  std::vector<Cascade> cascades;  ///< of Figure 8; empty: the paper's four
};

/// What a study works with. It keeps what it has finished in the store, if there is one.
struct StudyContext {
  Workbench& workbench;
  const StudyOptions& options;
  RunStore* store = nullptr;
};

/// A figure of the paper, or a question about it: runs what it needs and returns tables and measures.
struct Study {
  std::string_view name;   ///< on the command line: "fig8"
  std::string_view title;  ///< "Figure 8: matching cascades"
  reports::StudyResult (*run)(const StudyContext& context);
};
/// In the order in which they are run.
const std::vector<Study>& studies();
/// Throws Error listing the known ones.
const Study& study(std::string_view name);

reports::StudyResult run_figure7(const StudyContext& context);
reports::StudyResult run_figure8(const StudyContext& context);
reports::StudyResult run_figure9(const StudyContext& context);
reports::StudyResult run_ablations(const StudyContext& context);
reports::StudyResult run_monocular(const StudyContext& context);

}  // namespace glovebench::eval
