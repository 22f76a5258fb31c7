#pragma once

#include <mutex>
#include <optional>
#include <string>

namespace glovebench::eval {

/// The folder of a run in progress. After a crash the same command resumes and writes the same bytes.
/// FOLDER/.unfinished/ marks the run, locks it and holds finished parts as KEY.stored (`run_key`, `study_key`).
class RunStore {
 public:
  /// Throws: Error, also if another run holds the folder.
  explicit RunStore(const std::string& folder);
  /// Removes a new mark unless `begin` was called.
  ~RunStore();
  RunStore(const RunStore&) = delete;
  RunStore& operator=(const RunStore&) = delete;

  /// Keeps the mark until `finish`.
  void begin();

  /// A part that this program stored, else empty. Removes useless files, with one message on stderr. Thread-safe.
  std::optional<std::string> load(const std::string& key) const;
  /// Thread-safe.
  /// Throws: Error.
  void save(const std::string& key, const std::string& content) const;

  /// Removes mark and parts.
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
