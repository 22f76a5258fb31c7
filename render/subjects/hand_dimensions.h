#pragma once

#include <array>
#include <cstdint>

namespace glovebench::render {

/// An adult's bare hand, m, thumb to little. Sources: Gordon et al. (2014), NATICK/TR-15/007 (length, breadth);
/// Buryanov and Kotiuk (2010), Int. J. Morphol. 28(3):755-758, Table I (segments, pulp); Greiner (1991),
/// NATICK/TR-92/011, men (girths, wrist, webs).
struct HandDimensions {
  bool woman = false;
  double length = 0;   ///< wrist crease to middle fingertip
  double breadth = 0;  ///< across the metacarpal heads
  /// Thumb metacarpal, proximal, distal; others proximal, intermediate, distal (to the bone's end).
  std::array<std::array<double, 3>, 5> segments{};
  std::array<double, 5> pulp{};          ///< end of the distal bone to fingertip
  std::array<double, 5> middle_girth{};  ///< at the PIP (thumb: IP) joint
  std::array<double, 4> distal_girth{};  ///< at the DIP joint, index to little
  double wrist_breadth = 0;
  double wrist_girth = 0;
};

struct Published {
  double mean_mm = 0;
  double sd_mm = 0;
};
Published published_length(bool woman);
Published published_breadth(bool woman);
/// `segment`: 0..2 as in HandDimensions, 3: pulp.
Published published_segment(int finger, int segment);

/// Segments vary around the drawn length, girths around the breadth.
HandDimensions draw_dimensions(uint64_t seed);

}  // namespace glovebench::render
