#include "bench/scale/random_postures.h"

#include <fmt/format.h>

#include "core/base/angles.h"
#include "core/base/random.h"

namespace glovebench::bench {

PostureSet random_postures(int count) {
  PostureSet set{fmt::format("DB_{}_random", count), {}, {}};
  for (int p = 0; p < count; ++p) {
    RandomStream random(1, "scale", p, "posture");
    Posture posture = Posture::Zero();
    for (int angle = kThumbCmcAbduction; angle < kAngleCount; ++angle) {
      const AngleInfo& info = angle_infos()[angle];
      posture[angle] = radians_from_degrees(random.uniform(info.min_deg, info.max_deg));
    }
    set.posture_names.push_back(fmt::format("random_{:05}", p + 1));
    set.postures.push_back(posture);
  }
  return set;
}

}  // namespace glovebench::bench
