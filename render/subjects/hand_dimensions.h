#pragma once

#include <array>
#include <cstdint>

namespace glovebench::render {

/// The bare hand of one adult. Arrays are thumb, index, middle, ring, little.
///
/// Units: m. Sources:
/// - length and breadth: Gordon et al. (2014), "2012 Anthropometric Survey of U.S. Army Personnel: Methods and
///   Summary Statistics", NATICK/TR-15/007, summary statistics of "Hand Length" and "Hand Breadth", rounded to mm;
/// - segments and pulp: Buryanov and Kotiuk (2010), "Proportions of Hand Segments", Int. J. Morphol. 28(3):755-758,
///   Table I (radiographs of 66 adults);
/// - girths, wrist and webs: Greiner (1991), "Hand Anthropometry of U.S. Army Personnel", NATICK/TR-92/011, means
/// of
///   men.
struct HandDimensions {
  bool woman = false;
  double length = 0;   ///< wrist crease to middle fingertip
  double breadth = 0;  ///< across the heads of the metacarpals
  /// From joint to joint. Thumb: metacarpal, proximal, distal; others: proximal, intermediate, distal. The distal
  /// ones end with the bone.
  std::array<std::array<double, 3>, 5> segments{};
  std::array<double, 5> pulp{};          ///< from the end of the distal bone to the fingertip
  std::array<double, 5> middle_girth{};  ///< circumference at the PIP joint; thumb: at the IP joint
  std::array<double, 4> distal_girth{};  ///< circumference at the DIP joint, index to little
  double wrist_breadth = 0;
  double wrist_girth = 0;
};

/// Mean and standard deviation of a published dimension, mm.
struct Published {
  double mean_mm = 0;
  double sd_mm = 0;
};
Published published_length(bool woman);
Published published_breadth(bool woman);
/// `segment` 0 to 2 as in HandDimensions::segments, 3 the pulp; men and women together.
Published published_segment(int finger, int segment);

/// Draws a man's or a woman's hand. Breadth is correlated with length (0.6); segments are proportional to length
/// and girths to breadth, each with its own spread of 4 and 3%. Normal draws end at two standard deviations.
HandDimensions draw_dimensions(uint64_t seed);

}  // namespace glovebench::render
