#include <fmt/core.h>

#include <exception>

#include "core/hand/hand_model.h"

/// Poses the hand of the mesh file in the first argument, by the installed library alone.
int main(int argc, char** argv) try {
  if (argc != 2) {
    fmt::print(stderr, "usage: consumer MESH\n");
    return 2;
  }
  const auto model = glovebench::HandModel::load(argv[1]);
  const auto hand = model.pose(glovebench::Posture::Zero());
  fmt::print("{} vertices, {} triangles\n", hand.vertices.size(), model.triangles().size());
} catch (const std::exception& e) {
  fmt::print(stderr, "consumer: {}\n", e.what());
  return 2;
}
