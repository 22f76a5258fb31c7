#pragma once

#include <string>

#include "reports/table.h"

namespace glovebench::reports {

/// Each metric of the registry: unit, meaning, formula, the frames that are averaged, whether it is compared.
Table glossary_table();
/// The same for a terminal, a paragraph each.
std::string glossary_text(size_t columns);

}  // namespace glovebench::reports
