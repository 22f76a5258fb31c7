#include "eval/studies/study.h"

namespace glovebench::eval {

reports::StudyResult run_figure7(const StudyContext&) {
  return {"fig7", "Figure 7: tiny images", {}, {}};
}

}  // namespace glovebench::eval
