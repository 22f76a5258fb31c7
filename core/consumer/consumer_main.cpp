#include <cstdio>
#include <span>
#include <string>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/hand/posture.h"

/// Prints a fixed number of the named random stream and the hash of a text: both need the library's code.
int main() {
  glovebench::RandomStream stream(1, "consumer", 0, "test");
  const std::string hash = glovebench::hash_text("glovebench");
  std::printf("%d angles, uniform %.6f, hash %s\n", glovebench::kAngleCount, stream.uniform(), hash.c_str());
  return hash.size() == 32 ? 0 : 1;
}
