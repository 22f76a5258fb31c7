#pragma once

#include <mutex>
#include <optional>
#include <string>

namespace glovebench::eval {

/// The folder of a run while the run goes on. It is marked as unfinished, so that no reader takes what lies in it
/// for a whole; finished parts are kept in it, so that the same run, started again after a crash or a kill, goes
/// on where it was and writes the same bytes; and it is locked, so that two runs do not write into it at once.
///
/// FOLDER/.unfinished/ is the mark. It holds `lock` (held with flock while the run lives) and one file for each
/// finished part: a line with the hash of the program that made it, its key and a checksum, then its content.
class RunStore {
 public:
  /// Locks and marks. Throws Error if another run holds the folder or it cannot be written.
  explicit RunStore(const std::string& folder);
  /// Without `begin`, a mark that was not there before goes again.
  ~RunStore();
  RunStore(const RunStore&) = delete;
  RunStore& operator=(const RunStore&) = delete;

  /// What was asked for can be done, and the work begins: from here on the mark stays until `finish`.
  void begin();

  /// What an earlier, interrupted run of this program stored under this key; empty if there is nothing, or nothing
  /// whole: then it is removed, and standard error says so once. Thread-safe.
  std::optional<std::string> load(const std::string& key) const;
  /// Thread-safe. Throws Error if there is no room.
  void save(const std::string& key, const std::string& content) const;

  /// The report is written: the mark goes, in one step, and what was kept with it.
  void finish();

 private:
  void lock();
  bool put_mark_away();

  std::string folder_;
  std::string mark_;
  bool keep_mark_ = false;
  int lock_ = -1;
  mutable std::once_flag told_;  ///< that something stored is of no use
};

/// Throws reports::Incomparable if the folder of results is one of an unfinished run, Error if that cannot be told.
void require_finished(const std::string& folder);

}  // namespace glovebench::eval
