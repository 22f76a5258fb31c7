#pragma once

#include "core/database/look_up.h"

namespace glovebench {

/// `look_up`, fast. A first stage by small images adds up the rows of `FieldRows` over all entries at once; one by
/// large images adds up rows of cell minima, which bounds every distance from below, and computes distances only
/// where the bound is under the last one kept. Later stages stop adding up an entry as soon as it is too far.
RecycledVector<Match> look_up_fast(const Database& database, const TinyImages& query, const Cascade& cascade,
                                   LookUpTrace* trace);

}  // namespace glovebench
