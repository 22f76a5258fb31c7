#include "eval/studies/study.h"

namespace glovebench::eval {

reports::StudyResult run_ablations(const StudyContext&) {
  return {"ablations", "What the paper asserts, one change at a time", {}, {}};
}

}  // namespace glovebench::eval
