#include "eval/studies/study.h"

namespace glovebench::eval {

reports::StudyResult run_figure9(const StudyContext&) {
  return {"fig9", "Figure 9: sub-sampling", {}, {}};
}

}  // namespace glovebench::eval
