#pragma once

#include <string>

#include "reports/table.h"

namespace glovebench::reports {

/// Unit, meaning, formula, the frames that are averaged, whether it is compared.
Table glossary_table();
/// For a terminal, a paragraph each.
std::string glossary_text(size_t columns);

}  // namespace glovebench::reports
