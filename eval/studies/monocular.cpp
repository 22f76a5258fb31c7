#include "eval/studies/study.h"

namespace glovebench::eval {

reports::StudyResult run_monocular(const StudyContext&) {
  return {"monocular", "Without depth", {}, {}};
}

}  // namespace glovebench::eval
