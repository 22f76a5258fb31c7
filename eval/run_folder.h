#pragma once

#include <optional>
#include <string>

#include "eval/replay.h"

namespace glovebench::eval {

/// The folder of a run while the run goes on. It is marked as unfinished, so that no reader takes what lies in it
/// for a whole; finished replays are kept in it, so that the same run, started again after a crash or a kill, goes
/// on where it was and writes the same bytes; and it is locked, so that two runs do not write into it at once.
///
/// Under FOLDER/.unfinished/: `lock` (held with flock while the run lives), one file for each finished replay.
class RunFolder {
 public:
  /// Throws Error if another run holds the folder or it cannot be written.
  explicit RunFolder(const std::string& folder);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// What an earlier, interrupted run stored under this key; empty if there is nothing, or nothing whole.
  std::optional<std::vector<TrackedReplay>> load(const std::string& key) const;
  void store(const std::string& key, const std::vector<TrackedReplay>& replay) const;

  /// The report is written: what was kept goes, and the mark with it.
  void finish();

 private:
  std::string folder_;
  int lock_ = -1;
};

/// Names a replay by all that its outcome hangs on: this program (the hash of its file), configuration, truth,
/// frames, noise, seed, subject, the hashes of databases, hand models and color table.
std::string replay_key(Workbench& workbench, const Replay& replay, const TrackerConfig& config);

/// Throws reports::Incomparable if the folder of results is one of an unfinished run.
void require_finished(const std::string& folder);

}  // namespace glovebench::eval
