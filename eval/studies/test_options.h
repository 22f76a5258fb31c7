#pragma once

#include "eval/studies/study.h"

namespace glovebench::eval {

/// Of the tests that run a study.
inline StudyOptions quick_options() {
  StudyOptions options;
  options.tracker = profile("paper");
  options.quick = true;
  return options;
}

}  // namespace glovebench::eval
