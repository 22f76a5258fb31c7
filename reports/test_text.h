#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace glovebench::reports {

/// The message of the exception that `action` throws; "no error" if it throws none.
template <typename Exception = Error, typename Action>
std::string thrown_by(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "no error";
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace glovebench::reports
