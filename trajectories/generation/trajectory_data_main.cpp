// glovebench_trajectory_data FOLDER: writes the generated files of the data folder anew and prints a table of the
// movements' properties.
#include <cstdio>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "trajectories/generation/data_files.h"

int main(int argc, char** argv) {
  namespace trajectories = glovebench::trajectories;
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s DATA_FOLDER\n", argv[0]);
    return 2;
  }
  try {
    const std::string folder = argv[1];
    for (const auto& [path, content] : trajectories::generate_data_files(folder))
      glovebench::write_file(folder + "/" + path, content);
    std::fputs(trajectories::source_properties_table(folder).c_str(), stdout);
  } catch (const glovebench::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
