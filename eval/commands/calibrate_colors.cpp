#include <fmt/format.h>

#include <algorithm>

#include "core/base/whole_file.h"
#include "core/calibration/color_report.h"
#include "eval/commands/flags.h"
#include "eval/sources/source.h"
#include "render/pictures.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

struct CalibrateColors {
  CommonFlags common;
  SourceFlags from;
  std::string seeds;    ///< file; empty: the tracker's own table
  std::string report;   ///< *.json; empty: none
  std::string picture;  ///< *.png; empty: none
  std::string space = "yuv";
  int frame_count = 120;  ///< taken at most

  void run() {
    require_writable_files(
        {{"--output", common.output}, {"--report", report, ".json"}, {"--picture", picture, ".png"}});
    const calibration::ColorSeeds begin = seeds_to_begin_with();
    TrackSource source = open_source(from, common.quiet);
    calibration::ColorSamples samples(calibration::SampleConfig{
        .volume = common.tracker_config().volume, .registration = common.tracker_config().registration});
    const std::vector<calibration::VolumeView> views = take_frames(source, samples);
    const calibration::GloveColorFit fit = fit_glove_colors(samples, begin, from.source);
    const ColorTable table = build_color_table(samples, fit, *from_name<ColorSpace>(space));
    const calibration::ColorSeparation separation = separate_colors(samples, fit, table);
    table.save(common.output);
    if (!report.empty())
      write_file(report, reports::format_json(color_report_json(samples, fit, separation, from.source)));
    if (!picture.empty()) render::write_png(picture, color_picture(views, samples, fit, table));
    if (common.quiet) return;
    fmt::print("{}: a color table of {} frames\n\n{}", common.output, samples.frames(),
               color_report_markdown(samples, fit, separation));
  }

  calibration::ColorSeeds seeds_to_begin_with() const {
    if (!seeds.empty()) return calibration::load_seeds(seeds);
    return calibration::seeds_of_table(*common.workbench().color_table(), "the tracker's own color table");
  }

  /// Adds frames to `samples`; returns some for the picture.
  std::vector<calibration::VolumeView> take_frames(TrackSource& source, calibration::ColorSamples& samples) const {
    constexpr int kViews = 4;
    const int taken = source.frame_count > 0 ? std::min(frame_count, source.frame_count) : frame_count;
    std::vector<calibration::VolumeView> views;
    take_spread(source, frame_count, "looking at colors", common.quiet, [&](const DeviceFrame& frame) {
      if (static_cast<int>(views.size()) * std::max(1, taken / kViews) <= samples.frames() &&
          static_cast<int>(views.size()) < kViews)
        views.push_back(view_volume(frame, source.device->calibration(), samples.config()));
      samples.add_frame(frame, source.device->calibration());
    });
    return views;
  }
};

}  // namespace

void add_calibrate_colors(Command calibrate) {
  const Command command = calibrate.subcommand(
      "colors",
      "Make a color table of a recording of the glove, without labels: the light and the glove's colors are found "
      "from where the tracker's own table has them (core/calibration/README.md).");
  const auto state = std::make_shared<CalibrateColors>();
  state->from.add(command, "every patch of the glove is seen");
  state->common.add_output(command, "color table to write, for `track --colors`").required();
  command.option("--report", state->report, "separability and warnings to write (*.json)");
  command.option("--picture", state->picture,
                 "to check by eye (*.png): frames, labels, the colors in the UV plane");
  command.option("--seeds", state->seeds,
                 "where to begin, for a glove with other colors: a color table, or a JSON list of the ten colors "
                 "[the tracker's own table]");
  command.option("--space", state->space, "axes of the table").one_of(all_names<ColorSpace>());
  command.option("--frames", state->frame_count, "frames to take, spread over the recording").in(1, 10'000);
  command.option("--config", state->common.config_file,
                 "JSON file with the fields to change; the working volume is what matters here");
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
