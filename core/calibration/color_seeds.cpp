#include "core/calibration/color_seeds.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/calibration/chroma.h"
#include "core/segmentation/color_table.h"

namespace glovebench::calibration {
namespace {

constexpr std::string_view kFormat = "glovebench-glove-colors";
constexpr int kVersion = 1;
constexpr uint64_t kMaxBytes = 1 << 20;

/// The middle of a cell, gamma-coded R, G, B.
Eigen::Array3d rgb_of_cell(size_t cell, ColorSpace space) {
  constexpr size_t side = size_t{1} << ColorTable::kBits;
  constexpr double width = 256.0 / side;
  const auto middle = [](size_t index) { return width * (static_cast<double>(index) + 0.5) - 0.5; };
  const Eigen::Array3d axes = {middle(cell / (side * side)), middle(cell / side % side), middle(cell % side)};
  if (space == ColorSpace::rgb) return axes;
  return axes[0] * rgb_of_chroma(Chroma(axes[1] - 128, axes[2] - 128) / axes[0]);
}

Chroma seed_from(const JsonCursor& color) {
  const JsonItems channels = color.items(3);
  Eigen::Array3d rgb;
  for (int i = 0; i < 3; ++i) rgb[i] = channels[i].number(0, 255);
  if (!(luma_of(rgb) >= 1)) color.fail("black", "a color");
  return chroma_of(rgb);
}

constexpr double kGamma = 2.2;

double score(const ColorSeeds& seeds, const RecordedLight& light, const ChromaDensity& density) {
  // Density of stray samples around an absent color.
  constexpr double kStray = 0.002;
  // Weights of squared logarithms of gain and saturation: lights far from the seeds' are rare.
  constexpr double kRareGain = 2.0, kRareSaturation = 60.0;
  const ColorSeeds seen = relit(seeds, light);
  const double off = std::log(light.saturation);
  double sum = -kRareGain * light.gain.log().square().sum() - kRareSaturation * off * off;
  for (int label = 1; label <= kColorCount; ++label) sum += std::log(kStray + density.at(seen[label]));
  return sum;
}

/// Steps of the logarithms of the gains of red and blue and of the saturation, and how many each way.
struct Search {
  double gain_step;
  int red, blue;
  double saturation_step;
  int saturation;
};

RecordedLight best_light(const ColorSeeds& seeds, const ChromaDensity& density, const RecordedLight& start,
                         const Search& search) {
  RecordedLight best = start;
  double highest = score(seeds, best, density);
  for (int r = -search.red; r <= search.red; ++r) {
    for (int b = -search.blue; b <= search.blue; ++b) {
      for (int s = -search.saturation; s <= search.saturation; ++s) {
        RecordedLight light = start;
        light.gain[0] *= std::exp(r * search.gain_step);
        light.gain[2] *= std::exp(b * search.gain_step);
        light.saturation *= std::exp(s * search.saturation_step);
        const double value = score(seeds, light, density);
        if (value <= highest) continue;
        highest = value;
        best = light;
      }
    }
  }
  return best;
}

}  // namespace

ColorSeeds seeds_of_table(const ColorTable& table, const std::string& where) {
  constexpr double kDark = 40, kBright = 200;  // Y between which a cell's chroma is sharp
  std::array<int, kColorCount + 1> cells{};
  ColorSeeds seeds;
  seeds.fill(Chroma::Zero());
  for (size_t cell = 0; cell < ColorTable::kCells; ++cell) {
    const uint8_t label = table.labels()[cell];
    if (label == 0) continue;
    const Eigen::Array3d rgb = rgb_of_cell(cell, table.space());
    if (luma_of(rgb) < kDark || luma_of(rgb) > kBright) continue;
    seeds[label] += chroma_of(rgb);
    ++cells[label];
  }
  for (int label = 1; label <= kColorCount; ++label) {
    if (cells[label] == 0) throw Error(where, fmt::format("color {}", label), "no cell", "one at least");
    seeds[label] /= cells[label];
  }
  return seeds;
}

ColorSeeds parse_glove_colors(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "colors_rgb"});
  root.expect_format(kFormat, kVersion);
  const JsonItems colors = root["colors_rgb"].items(kColorCount);
  ColorSeeds seeds;
  seeds[0] = Chroma::Zero();
  for (int label = 1; label <= kColorCount; ++label) seeds[label] = seed_from(colors[label - 1]);
  return seeds;
}

ColorSeeds load_seeds(const std::string& path) {
  const std::string content = read_file(path, kMaxBytes);
  if (content.find_first_not_of(" \t\r\n") != std::string::npos &&
      content[content.find_first_not_of(" \t\r\n")] == '{')
    return parse_glove_colors(content, path);
  return seeds_of_table(color_table_from_bytes(content, path), path);
}

ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light) {
  const Eigen::Array3d coded = light.gain.pow(1 / kGamma);
  ColorSeeds seen = seeds;
  for (int label = 1; label <= kColorCount; ++label)
    seen[label] = light.saturation * chroma_of(rgb_of_chroma(seeds[label]) * coded);
  return seen;
}

RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma) {
  const ChromaDensity coarse(samples, min_luma, 0.06), fine(samples, min_luma, 0.025);
  const RecordedLight near = best_light(seeds, coarse, {}, {0.08, 10, 20, 0.05, 3});
  return best_light(seeds, fine, near, {0.02, 6, 6, 0.0125, 6});
}

}  // namespace glovebench::calibration
