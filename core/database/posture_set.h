#pragma once

#include <string>
#include <vector>

#include "core/hand/posture.h"

namespace glovebench {

struct PostureSet {
  std::string name;
  std::vector<std::string> posture_names;
  std::vector<Posture> postures;
};

}  // namespace glovebench
