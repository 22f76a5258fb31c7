#include "core/tracker/hand_look_up.h"

namespace glovebench {

HandLookUp look_up_hand(const LabelImage& labels, const PinholeCamera& camera, const Database& database,
                        const LookupConfig& config, const StageObserver& observe) {
  HandLookUp found;
  observe(Stage::tiny_images);
  found.square = bounding_square(labels);
  const TinyImages query = make_tiny_images(labels, found.square, config.cascade);

  observe(Stage::look_up);
  found.matches = look_up(database, query, config.cascade, config.implementation);
  if (found.matches.empty()) return found;
  if (found.matches.front().error > config.max_matching_error * config.cascade.back().size) {
    found.status = TrackStatus::poor_match;
    return found;
  }
  found.status = TrackStatus::tracked;
  found.coarse =
      interpolate(database, found.matches, square_ray(found.square, camera), config.interpolation_epsilon);
  return found;
}

}  // namespace glovebench
