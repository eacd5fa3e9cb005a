#include <algorithm>
#include <array>
#include <map>

#include "imaging/drawing/canvas.h"
#include "imaging/heap/mass_study.h"

namespace talus::imaging {
namespace {

constexpr int kWidth = 760;
constexpr int kHeight = 480;
constexpr Color kChosen{0, 140, 60};
constexpr std::array<Color, 6> kDayColors{{{31, 119, 180},
                                           {255, 127, 14},
                                           {148, 103, 189},
                                           {140, 86, 75},
                                           {227, 119, 194},
                                           {23, 190, 207}}};

PlotAxes MakeAxes(std::span<const MassRun> runs, const MassStudy& study) {
  const double low = study.rows.front().mass * 1e3;  // [g]
  const double high = study.rows.back().mass * 1e3;
  const double margin = std::max(0.12 * (high - low), 0.05 * high);
  double top = 0;
  for (const MassRun& run : runs) top = std::max(top, run.nebp_mm2);
  for (const MassRow& row : study.rows) top = std::max(top, row.mean_mm2 + row.sd_mm2);
  return {.x = {.low = low - margin, .high = high + margin, .from = 80, .to = kWidth - 150},
          .y = {.low = 0, .high = 1.1 * std::max(top, 1e-9), .from = kHeight - 60, .to = 40},
          .x_title = "mass [g]",
          .y_title = "NEBP [mm2]",
          .grid = true};
}

void DrawRow(ColorImage& canvas, const PlotAxes& axes, const MassRow& row, const Color& color) {
  const double x = axes.x.At(row.mass * 1e3);
  const double low = axes.y.At(row.mean_mm2 - row.sd_mm2);
  const double high = axes.y.At(row.mean_mm2 + row.sd_mm2);
  const Stroke stroke{.color = color, .thickness = 2};
  DrawLine(canvas, {x, low}, {x, high}, stroke);
  DrawLine(canvas, {x - 6, low}, {x + 6, low}, stroke);
  DrawLine(canvas, {x - 6, high}, {x + 6, high}, stroke);
  DrawLine(canvas, {x - 10, axes.y.At(row.mean_mm2)}, {x + 10, axes.y.At(row.mean_mm2)}, stroke);
}

}  // namespace

ColorImage DrawMassStudy(std::span<const MassRun> runs, const MassStudy& study) {
  ColorImage canvas = MakeCanvas(kWidth, kHeight);
  const PlotAxes axes = MakeAxes(runs, study);
  DrawAxes(canvas, axes);
  std::map<std::string, std::size_t> days;
  for (const MassRun& run : runs) days.try_emplace(run.day, 0);
  std::size_t number = 0;
  for (auto& [day, index] : days) {
    index = number++;
    const double y = 50 + 20 * static_cast<double>(index);
    DrawDisc(canvas, {kWidth - 130, y}, 4, kDayColors[index % kDayColors.size()]);
    DrawText(canvas, {day, {kWidth - 118, y}, Align::kLeft, 0.45, kBlack});
  }
  for (const MassRow& row : study.rows) {
    const bool chosen = study.chosen == row.mass;
    DrawRow(canvas, axes, row, chosen ? kChosen : kBlack);
    if (!chosen) continue;
    const double x = axes.x.At(row.mass * 1e3);
    DrawText(canvas, {"chosen", {x, axes.y.At(0) - 12}, Align::kCenter, 0.5, kChosen});
  }
  for (const MassRun& run : runs) {  // beside the mean, each day in its own column
    const double x = axes.x.At(run.mass * 1e3) + 14 + 8 * static_cast<double>(days[run.day]);
    DrawDisc(canvas, {x, axes.y.At(run.nebp_mm2)}, 3,
             kDayColors[days[run.day] % kDayColors.size()]);
  }
  return canvas;
}

}  // namespace talus::imaging
