#include "eval/studies/study.h"

namespace glovebench::eval {

reports::StudyResult run_figure8(const StudyContext&) {
  return {"fig8", "Figure 8: matching cascades", {}, {}};
}

}  // namespace glovebench::eval
