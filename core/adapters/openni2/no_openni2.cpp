#include "core/adapters/openni2/oni_player.h"
#include "core/base/error.h"

namespace glovebench {

const bool kHasOpenNi2 = false;

std::unique_ptr<OniPlayer> open_oni(const std::string& path) {
  throw Error(path, "player", "a glovebench that was built without OpenNI2",
              "one that was configured with it (Debian: libopenni2-dev)");
}

}  // namespace glovebench
