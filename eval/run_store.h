#pragma once

#include <mutex>
#include <optional>
#include <string>

namespace glovebench::eval {

/// The folder of a run in progress. After a crash the same command resumes and writes the same bytes.
/// FOLDER/.unfinished/ marks the run. It holds a lock and finished parts with program hash, key and checksum.
class RunStore {
 public:
  /// Throws: Error if another run holds the folder or it cannot be written.
  explicit RunStore(const std::string& folder);
  /// Removes a new mark unless `begin` was called.
  ~RunStore();
  RunStore(const RunStore&) = delete;
  RunStore& operator=(const RunStore&) = delete;

  /// Keeps the mark until `finish`.
  void begin();

  /// A part that this program stored, else empty. Removes useless files and says so once on stderr. Thread-safe.
  std::optional<std::string> load(const std::string& key) const;
  /// Thread-safe.
  /// Throws: Error if it cannot be written.
  void save(const std::string& key, const std::string& content) const;

  /// Removes mark and parts at once.
  /// Throws: Error.
  void finish();

 private:
  void lock();
  bool put_mark_away();

  std::string folder_;
  std::string mark_;
  bool keep_mark_ = false;
  int lock_ = -1;
  mutable std::once_flag told_;
};

/// Throws: reports::Incomparable for an unfinished run, Error if unknown.
void require_finished(const std::string& folder);

}  // namespace glovebench::eval
