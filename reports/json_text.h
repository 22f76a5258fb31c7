#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace glovebench::reports {

/// Objects and arrays over several lines, arrays of plain values on one: a file that reads well and in which one
/// frame is one line. Equal values give equal bytes. A number that is not finite is a broken invariant.
std::string format_json(const nlohmann::ordered_json& json);

/// The number as reports write it: rounded to 1e-6, without a minus zero. Throws std::logic_error unless finite.
double rounded(double value);
/// null for an empty optional.
nlohmann::ordered_json rounded_or_null(const std::optional<double>& value);

/// The text with U+FFFD for whatever is not UTF-8 in it: a folder's name can hold any bytes, JSON and XML cannot.
std::string valid_utf8(const std::string& text);

}  // namespace glovebench::reports
