#pragma once

#include "core/database/database_cache.h"
#include "core/test_folder.h"
#include "render/label_renderer.h"
#include "render/test_hand.h"

namespace glovebench {

inline Posture power_posture() {
  Posture posture = Posture::Zero();
  for (const int finger : {kIndexMcpFlexion, kMiddleMcpFlexion, kRingMcpFlexion, kLittleMcpFlexion}) {
    posture[finger] = 1.0;
    posture[finger + 1] = 1.2;
    posture[finger + 2] = 0.7;
  }
  posture[kThumbCmcFlexion] = 0.5;
  posture[kThumbMcpFlexion] = 0.6;
  return posture;
}

inline PostureSet test_postures() { return {"DB_test", {"open", "power"}, {Posture::Zero(), power_posture()}}; }

inline const Database& test_database(DatabaseMemory memory = DatabaseMemory::normal) {
  const auto get = [](DatabaseMemory which) {
    DatabaseCache cache;
    cache.folder = shared_test_folder();
    cache.renderers = render::label_renderer_factory();
    cache.source_hash = render::database_source_hash();
    cache.threads = 2;
    cache.memory = which;
    return cache.get(test_postures(), render::test_hand(), ViewConfig{}, kTinySizes);
  };
  if (memory == DatabaseMemory::low) {
    static const Database low = get(DatabaseMemory::low);
    return low;
  }
  static const Database normal = get(DatabaseMemory::normal);
  return normal;
}

inline LabelImage entry_image(const Database& database, int size, int entry) {
  return database.labels(size, entry);
}

}  // namespace glovebench
