#include "core/base/fuzz_target.h"
#include "core/base/hash.h"
#include "core/segmentation/color_table.h"

namespace glovebench {

// As a file, and as the first cells of a file whose checksum is right: no mutation finds one.
void color_table_fuzz(std::string_view bytes) {
  const auto read = [](const std::string& file) {
    expect_value_or_error([&] {
      const ColorTable table = color_table_from_bytes(file, "colors.table");
      check(file.ends_with(std::string(table.labels().begin(), table.labels().end())), "the cells return");
    });
  };
  read(std::string(bytes));
  std::string cells(bytes.substr(0, ColorTable::kCells));
  cells.resize(ColorTable::kCells, '\0');
  read("glovebench color table, version 2, yuv\n" + hash_text(cells) + "\n" + cells);
}

}  // namespace glovebench
