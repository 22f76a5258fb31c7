#pragma once

#include "eval/studies/study.h"

namespace glovebench::eval {

inline StudyOptions quick_options() {
  StudyOptions options;
  options.tracker = profile("paper");
  options.quick = true;
  return options;
}

}  // namespace glovebench::eval
