#pragma once

#include <string>

namespace glovebench::bench {

/// Writes a database file in which the postures of another one follow each other so many times: as long as one of
/// that many times the postures, made as fast as a disk writes. Every neighbor is there as many times. Throws
/// Error.
void repeat_database(const std::string& path, int times, const std::string& repeated_path);

}  // namespace glovebench::bench
