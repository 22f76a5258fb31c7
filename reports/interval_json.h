#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "reports/json_reader.h"
#include "reports/statistics.h"

namespace glovebench::reports {

/// An interval as every report writes it; null for none.
nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval);
/// Reads it back; throws Error unless both ends lie in min..max.
std::optional<ConfidenceInterval> read_interval(const JsonReader& json, double min, double max);

}  // namespace glovebench::reports
