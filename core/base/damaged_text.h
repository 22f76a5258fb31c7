#pragma once

#include <array>
#include <string>

#include "core/base/random.h"

namespace glovebench {

inline std::string damaged_text(std::string text, RandomStream& random) {
  static const std::array<std::string, 7> kHostile = {"null", "-1", "1e999", "[[[[", "NaN", "18446744073709551615",
                                                      "{}"};
  const size_t place = random.index(text.size());
  const size_t length = 1 + random.index(40);
  const size_t colon = text.find(':', place);
  switch (random.index(6)) {
    case 0:
      text[place] = static_cast<char>(random.index(256));
      break;
    case 1:
      text.erase(place, length);
      break;
    case 2:
      text.insert(place, text.substr(place, length));
      break;
    case 3:
      text.insert(place, std::to_string(random.index(10)));
      break;
    case 4:
      if (colon != std::string::npos)
        text.replace(colon + 1, 1 + random.index(4), kHostile[random.index(kHostile.size())]);
      break;
    default:
      text.resize(place);
  }
  return text;
}

}  // namespace glovebench
