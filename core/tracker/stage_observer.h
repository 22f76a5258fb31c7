#pragma once

#include <functional>
#include <string_view>

namespace glovebench {

/// Told the name of each stage when it begins ("register", "segment", ...; "" at the end of the frame), so
/// that a caller who has a clock can time them. A stage that is done again in a frame is told again.
using StageObserver = std::function<void(std::string_view stage)>;

}  // namespace glovebench
