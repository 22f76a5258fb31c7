#pragma once

#include <string>
#include <string_view>

#include "core/segmentation/color_table.h"

namespace glovebench {

/// The table of what a file of ColorTable::save holds; `where` names it in messages. Throws Error naming the field
/// that is wrong.
ColorTable color_table_from_bytes(std::string_view bytes, const std::string& where);

}  // namespace glovebench
