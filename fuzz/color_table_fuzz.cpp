#include "core/base/hash.h"
#include "core/segmentation/color_table_file.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

// As a file, and as the first cells of a file whose checksum is right: no mutation finds one.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto read = [](const std::string& bytes) {
    fuzz::expect_value_or_error([&] {
      const ColorTable table = color_table_from_bytes(bytes, "colors.table");
      check(bytes.ends_with(std::string(table.labels().begin(), table.labels().end())), "the cells return");
    });
  };
  read(std::string(fuzz::as_text(data, size)));
  std::string cells(fuzz::as_text(data, size).substr(0, ColorTable::kCells));
  cells.resize(ColorTable::kCells, '\0');
  read("glovebench color table, version 2, yuv\n" + hash_text(cells) + "\n" + cells);
  return 0;
}
