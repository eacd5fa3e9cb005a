#include "experiments/analysis/report/charts/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <span>

#include "base/text/markup.h"
#include "base/text/num_characters.h"
#include "base/text/number_text.h"
#include "experiments/analysis/report/views/answer_words.h"

namespace talus::analysis {
namespace {

// [px]
constexpr double kLeastLeft = 72;
constexpr double kRight = 18;
constexpr double kBottom = 56;
constexpr double kPlotWidth = 550;
constexpr double kPlotHeight = 340;
constexpr double kLegendLine = 20;

constexpr const char* kFont = "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\"";

std::string Attribute(double x) { return base::ShortNumber(x, 6); }

std::string Pixel(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", x);
  return text;
}

std::string LineStyle(const SvgStyle& style) {
  return " fill=\"none\" stroke=\"" + style.color + "\" stroke-width=\"" + Attribute(style.width) +
         "\"" + (style.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

std::string Words(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + Pixel(x) + "\" y=\"" + Pixel(y) + "\" text-anchor=\"" + anchor + "\">" +
         base::MarkupText(text) + "</text>\n";
}

// "0.2", "10⁻⁶", as the page's own charts (format.js).
std::string TickText(double tick, int digits) {
  const double power = std::log10(std::abs(tick));
  const bool is_far = power < -3 - 1e-9 || power > 4 + 1e-9;
  char scientific[32];
  std::snprintf(scientific, sizeof scientific, "%.0e", tick);
  const bool is_power = std::abs(power - std::round(power)) < 1e-9;
  const std::string text =
      WithPowers(is_far && is_power ? scientific : base::ShortNumber(tick, digits));
  return text.starts_with("1 × ") ? text.substr(std::string_view("1 × ").size()) : text;
}

// About five round values, and at most 20: of an axis that is no longer than the rounding of its
// ends, k + 1 is k.
std::vector<double> EvenTicks(const SvgAxis& axis) {
  constexpr int kMost = 20;
  const double rough = (axis.high - axis.low) / 5;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double factor = rough / power;
  const double round = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  const double step = axis.whole ? std::max(round, 1.0) : round;
  if (!(step > 0)) return {axis.low};
  const double first = std::ceil(axis.low / step - 1e-9);
  std::vector<double> ticks;
  for (int k = 0; k < kMost; ++k) {
    const double tick = (first + k) * step + 0.0;  // no "-0"
    if (tick > axis.high + 1e-9 * step || (k > 0 && tick == ticks.back())) break;
    ticks.push_back(tick);
  }
  return ticks;
}

// The digits of every power of ten that a logarithmic axis holds.
std::vector<double> DecadeTicks(const SvgAxis& axis, std::span<const double> digits) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  for (int power = first; power <= last; ++power) {
    for (const double digit : digits) {
      const double tick = digit * std::pow(10.0, power);
      if (tick < axis.low * (1 - 1e-9) || tick > axis.high * (1 + 1e-9)) continue;
      ticks.push_back(tick);
    }
  }
  return ticks;
}

// The powers of ten on a logarithmic axis; where fewer than two fit, 1, 2 and 5 of each; where
// fewer than two of these do, and on a linear axis, round values.
std::vector<double> TicksOf(const SvgAxis& axis) {
  if (!axis.log) return EvenTicks(axis);
  constexpr double kDigits[] = {1, 2, 5};
  for (const std::size_t count : {std::size_t{1}, std::size(kDigits)}) {
    std::vector<double> ticks = DecadeTicks(axis, std::span(kDigits).first(count));
    if (ticks.size() > 1) return ticks;
  }
  return EvenTicks(axis);
}

double Share(const SvgAxis& axis, double value) {
  if (axis.log) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

std::string StarPath(double x, double y, double radius) {
  std::string path;
  for (int k = 0; k < 10; ++k) {
    const double angle = (k / 5.0 - 0.5) * std::numbers::pi;
    const double r = k % 2 == 0 ? radius : 0.4 * radius;
    path += (k == 0 ? "M" : "L") + Pixel(x + r * std::cos(angle)) + " " +
            Pixel(y + r * std::sin(angle));
  }
  return "<path d=\"" + path + "Z\" fill=\"" + kStar + "\" stroke=\"#fff\"/>\n";
}

struct Tick {
  double at = 0;
  std::string text{};
};

// Ticks with as many digits as tell them apart.
std::vector<Tick> LabelledTicks(const SvgAxis& axis) {
  constexpr int kFewest = 4;
  constexpr int kMost = 12;
  std::vector<Tick> ticks;
  for (int digits = kFewest; digits <= kMost; ++digits) {
    ticks.clear();
    for (const double tick : TicksOf(axis)) ticks.push_back({tick, TickText(tick, digits)});
    // As numbers: a power of ten is written otherwise than a neighbour that is rounded to it.
    const auto rounded = [&](const Tick& tick) { return base::ShortNumber(tick.at, digits); };
    if (std::ranges::adjacent_find(ticks, {}, rounded) == ticks.end()) break;
  }
  return ticks;
}

// Room for the ticks of the upright axis and its title beside them [px].
double LeftOf(const SvgAxis& axis) {
  constexpr double kCharacter = 8;
  constexpr double kTitle = 34;
  double widest = 0;
  for (const Tick& tick : LabelledTicks(axis)) {
    widest = std::max(widest, kCharacter * static_cast<double>(base::NumCharacters(tick.text)));
  }
  return std::max(kLeastLeft, kTitle + widest);
}

}  // namespace

SvgChart::SvgChart(SvgAxis x, SvgAxis y, bool equal_scale)
    : x_(std::move(x)), y_(std::move(y)), plot_height_(kPlotHeight), left_(LeftOf(y_)) {
  if (equal_scale) plot_height_ = kPlotWidth * (y_.high - y_.low) / (x_.high - x_.low);
}

double SvgChart::PixelX(double x) const { return kPlotWidth * Share(x_, x); }
double SvgChart::PixelY(double y) const { return plot_height_ * (1 - Share(y_, y)); }

bool SvgChart::Inside(const SvgPoint& point) const {
  const double x = Share(x_, point.x);
  const double y = Share(y_, point.y);
  return x >= -1e-9 && x <= 1 + 1e-9 && y >= -1e-9 && y <= 1 + 1e-9;
}

std::string SvgChart::Path(const std::vector<SvgPoint>& points) const {
  std::string path;
  for (const SvgPoint& point : points) {
    path += (path.empty() ? "M" : "L") + Pixel(PixelX(point.x)) + " " + Pixel(PixelY(point.y));
  }
  return path;
}

void SvgChart::Line(const std::vector<SvgPoint>& points, const SvgStyle& style,
                    const std::string& name) {
  body_ += "<path d=\"" + Path(points) + "\"" + LineStyle(style) + "/>\n";
  if (!name.empty()) legend_.push_back({name, "<path d=\"M-9 0H9\"" + LineStyle(style) + "/>"});
}

void SvgChart::Band(const std::vector<SvgPoint>& low, const std::vector<SvgPoint>& high,
                    const SvgStyle& style, const std::string& name) {
  std::vector<SvgPoint> around = low;
  around.insert(around.end(), high.rbegin(), high.rend());
  const std::string fill =
      " fill=\"" + style.color + "\" fill-opacity=\"" + Attribute(style.opacity) + "\"";
  body_ += "<path d=\"" + Path(around) + "Z\"" + fill + "/>\n";
  if (!name.empty()) {
    legend_.push_back({name, "<rect x=\"-9\" y=\"-5\" width=\"18\" height=\"10\"" + fill + "/>"});
  }
}

void SvgChart::Points(const std::vector<SvgPoint>& points, const SvgStyle& style,
                      const std::string& name) {
  const std::string end = "\" r=\"" + Attribute(style.width / 2) + "\" fill=\"" + style.color +
                          "\" fill-opacity=\"" + Attribute(style.opacity) + "\"/>";
  for (const SvgPoint& point : points) {
    if (!Inside(point)) continue;
    body_ +=
        "<circle cx=\"" + Pixel(PixelX(point.x)) + "\" cy=\"" + Pixel(PixelY(point.y)) + end + "\n";
  }
  if (!name.empty()) legend_.push_back({name, "<circle cx=\"0\" cy=\"0" + end});
}

void SvgChart::Star(const SvgPoint& point, const std::string& name) {
  if (Inside(point)) body_ += StarPath(PixelX(point.x), PixelY(point.y), 10);
  if (!name.empty()) legend_.push_back({name, StarPath(0, 0, 7)});
}

void SvgChart::Cell(const SvgBox& box, const std::string& color) {
  const double left = PixelX(box.from.x);
  const double top = PixelY(box.to.y);
  body_ += "<rect x=\"" + Pixel(left) + "\" y=\"" + Pixel(top) + "\" width=\"" +
           Pixel(PixelX(box.to.x) - left + 0.3) + "\" height=\"" +
           Pixel(PixelY(box.from.y) - top + 0.3) + "\" fill=\"" + color + "\"/>\n";
}

std::string SvgChart::AxesText() const {
  const std::string stroke = std::string(" stroke=\"") + kInk + "\"";
  std::string text = "<path d=\"M0 0V" + Pixel(plot_height_) + "H" + Pixel(kPlotWidth) +
                     "\" fill=\"none\"" + stroke + "/>\n";
  for (const auto& [tick, label] : LabelledTicks(x_)) {
    const double x = PixelX(tick);
    text += "<path d=\"M" + Pixel(x) + " " + Pixel(plot_height_) + "v5\"" + stroke + "/>\n" +
            Words(x, plot_height_ + 20, "middle", label);
  }
  for (const auto& [tick, label] : LabelledTicks(y_)) {
    const double y = PixelY(tick);
    text += "<path d=\"M0 " + Pixel(y) + "h-5\"" + stroke + "/>\n" + Words(-9, y + 5, "end", label);
  }
  text += Words(kPlotWidth / 2, plot_height_ + 44, "middle", x_.title);
  return text + "<g transform=\"translate(" + Pixel(16 - left_) + " " + Pixel(plot_height_ / 2) +
         ") rotate(-90)\">" + Words(0, 0, "middle", y_.title) + "</g>\n";
}

std::string SvgChart::LegendText() const {
  std::string text;
  double y = 14;
  for (const Entry& entry : legend_) {
    text += "<g transform=\"translate(" + Pixel(left_ + 12) + " " + Pixel(y) + ")\">" + entry.mark +
            "</g>\n" + Words(left_ + 28, y + 5, "start", entry.name);
    y += kLegendLine;
  }
  return text;
}

std::string SvgChart::Text() const {
  const double top = 14 + kLegendLine * static_cast<double>(legend_.size());
  const std::string height = Pixel(top + plot_height_ + kBottom);
  const std::string width = Pixel(left_ + kPlotWidth + kRight);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
         "\" viewBox=\"0 0 " + width + " " + height + "\" role=\"img\" " + kFont + " fill=\"" +
         kInk + "\">\n<title>" + base::MarkupText(y_.title + " over " + x_.title) +
         "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + LegendText() +
         "<clipPath id=\"plot\"><rect width=\"" + Pixel(kPlotWidth) + "\" height=\"" +
         Pixel(plot_height_) + "\"/></clipPath>\n<g transform=\"translate(" + Pixel(left_) + " " +
         Pixel(top) + ")\">\n<g clip-path=\"url(#plot)\">\n" + body_ + "</g>\n" + AxesText() +
         "</g>\n</svg>\n";
}

}  // namespace talus::analysis
