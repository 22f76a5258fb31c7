#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace glovebench::reports {

/// Spreads objects and arrays over lines, except arrays of plain values. Equal values give equal bytes. Numbers
/// must be finite.
std::string format_json(const nlohmann::ordered_json& json);

/// To 1e-6, without minus zero.
/// Throws: std::logic_error unless finite.
double rounded(double value);
nlohmann::ordered_json rounded_or_null(const std::optional<double>& value);

/// U+FFFD replaces bytes that are not UTF-8.
std::string valid_utf8(const std::string& text);

}  // namespace glovebench::reports
