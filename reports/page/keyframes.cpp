#include <fmt/format.h>

#include "reports/page/section.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr int kKeyframes = 6;  // about as many as the paper shows

/// A window on one tile of a sheet: row 0 of a frame is the truth, row 1 the difference. Positions are shares, so
/// only the style sheet sets the size of a tile.
std::string tile(const FrameSheet& sheet, int frame, int row, const std::string& what) {
  const int columns = sheet.columns, rows = 2 * ((sheet.frames + columns - 1) / columns);
  const auto share = [](int place, int count) { return count < 2 ? 0 : 100.0 * place / (count - 1); };
  return fmt::format(
      "<span class=\"frame-tile sheet-{} row-{}\" role=\"img\" aria-label=\"{}\" "
      "style=\"background-position:{:.4f}% {:.4f}%\"></span>",
      sheet.figure, row, what, share(frame % columns, columns), share(2 * (frame / columns) + row, rows));
}

std::string two_tiles(const FrameSheet& sheet, int frame) {
  return tile(sheet, frame, 0, "the true hand") + tile(sheet, frame, 1, "difference of the depth images");
}

std::string color_legend() {
  return fmt::format(
      "<p class=\"depth-legend\">The true hand, and below it the depth of the estimated hand minus that of the "
      "true "
      "one: <span class=\"nowrap\">\u2212{0:.0f} mm (nearer) <span class=\"ramp\"></span> +{0:.0f} mm "
      "(farther)</span> <span class=\"nowrap\"><span class=\"swatch\"></span>only one of the two is "
      "there</span></p>\n",
      kSheetDifferenceMm);
}

}  // namespace

std::string keyframes_html(const FrameSheet& sheet) {
  std::string html = fmt::format("<div class=\"keyframes\" data-figure=\"{}\">\n", sheet.figure);
  const int count = std::min(kKeyframes, sheet.frames);
  for (int i = 0; i < count; ++i) {
    const int frame = count < 2 ? 0 : i * (sheet.frames - 1) / (count - 1);
    html += fmt::format("<button type=\"button\" data-frame=\"{0}\">{1}frame {2}</button>\n", frame,
                        two_tiles(sheet, frame), sheet.first_frame + frame);
  }
  return html + "</div>\n" + color_legend();
}

std::string frame_viewer_html(const FrameSheet& sheet) {
  return fmt::format(
      "<div class=\"frame-viewer\" data-figure=\"{0}\" data-columns=\"{1}\" data-frames=\"{2}\" "
      "data-first-frame=\"{3}\" hidden=\"\">\n{4}\n<label>Frame <output class=\"frame-number\">{3}</output>"
      "<input type=\"range\" min=\"0\" max=\"{5}\" value=\"0\"/></label>\n"
      "<table class=\"frame-numbers\"><thead><tr><th></th><th>glovebench</th><th>paper</th></tr></thead><tbody>"
      "<tr><th>position</th><td></td><td></td></tr><tr><th>posture</th><td></td><td></td></tr>"
      "<tr><th>rotation</th><td></td><td></td></tr></tbody></table>\n</div>\n",
      sheet.figure, sheet.columns, sheet.frames, sheet.first_frame, two_tiles(sheet, 0), sheet.frames - 1);
}

std::string sheet_style(const std::vector<FrameSheet>& sheets) {
  std::string css;
  for (const FrameSheet& sheet : sheets) {
    const int rows = 2 * ((sheet.frames + sheet.columns - 1) / sheet.columns);
    css += fmt::format(
        ".sheet-{} {{ aspect-ratio: {} / {}; background-size: {}% {}%; background-image: url({}); }}\n",
        sheet.figure, sheet.tile_width, sheet.tile_height, 100 * sheet.columns, 100 * rows, data_uri(sheet.image));
  }
  return css;
}

}  // namespace glovebench::reports
