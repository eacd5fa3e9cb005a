#include "imaging/photos/heap_breaks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/median.h"
#include "base/text/number_text.h"
#include "imaging/formats/images/exif.h"

namespace talus::imaging {
namespace {

constexpr std::size_t kFewestViews = 2;  // of a heap

// Neighbours in some order, and how far each is from the one before it.
struct Series {
  std::vector<const MeasuredView*> views;
  std::vector<double> steps;  // one fewer
};

// How far a step must stand out to be one to another heap.
struct Sign {
  double factor = 1;         // times the usual step
  double least = 0;          // in the step's own unit
  bool equal_heaps = false;  // only where each has as many photographs
  std::function<std::string(double step)> text;
};

// The photographs that begin a further heap, as indices of `views`; none where no steps stand out.
std::vector<std::size_t> BreaksIn(const Series& series, const Sign& sign) {
  constexpr double kApart = 1.3;  // the smallest step to another heap / the largest other [-]
  if (series.steps.size() < 2 * kFewestViews - 1) return {};
  const double limit = std::max(sign.least, sign.factor * base::Median(series.steps));
  std::vector<std::size_t> breaks;
  double smallest = std::numeric_limits<double>::infinity();
  double other = 0;
  for (std::size_t i = 0; i < series.steps.size(); ++i) {
    const double step = series.steps[i];
    if (step > limit) {
      breaks.push_back(i + 1);
      smallest = std::min(smallest, step);
    } else {
      other = std::max(other, step);
    }
  }
  if (breaks.empty() || smallest < kApart * other) return {};
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= breaks.size(); ++i) {
    const std::size_t end = i < breaks.size() ? breaks[i] : series.views.size();
    if (end - begin < kFewestViews || (sign.equal_heaps && end - begin != breaks.front())) {
      return {};
    }
    begin = end;
  }
  return breaks;
}

std::optional<PhotoWarning> DoubtBy(const Series& series, const Sign& sign,
                                    const std::string& run) {
  const std::vector<std::size_t> breaks = BreaksIn(series, sign);
  if (breaks.empty()) return std::nullopt;
  const std::size_t first = breaks.front();
  return PhotoWarning{.doubt = PhotoDoubt::kSeveralHeaps,
                      .photo = series.views[first]->photo,
                      .value = static_cast<double>(breaks.size() + 1),
                      .reason = sign.text(series.steps[first - 1]) + " " +
                                series.views[first - 1]->photo.filename().string() + "; the " +
                                std::to_string(series.views.size()) + " photographs of run " + run};
}

// By a number that each view has, in its order; nothing where one has none.
std::optional<Series> Ordered(
    const MeasuredRun& run,
    const std::function<std::optional<std::int64_t>(const MeasuredView&)>& number) {
  std::vector<std::pair<std::int64_t, const MeasuredView*>> views;
  for (const MeasuredView& view : run.views) {
    const auto value = number(view);
    if (!value) return std::nullopt;
    views.emplace_back(*value, &view);
  }
  std::ranges::stable_sort(views, {}, &std::pair<std::int64_t, const MeasuredView*>::first);
  Series series;
  for (std::size_t i = 0; i < views.size(); ++i) {
    series.views.push_back(views[i].second);
    if (i > 0) series.steps.push_back(static_cast<double>(views[i].first - views[i - 1].first));
  }
  return series;
}

// As the views follow each other.
Series Steps(const MeasuredRun& run,
             const std::function<double(const MeasuredView&, const MeasuredView&)>& step) {
  Series series;
  for (const MeasuredView& view : run.views) {
    if (!series.views.empty()) series.steps.push_back(step(*series.views.back(), view));
    series.views.push_back(&view);
  }
  return series;
}

std::optional<std::int64_t> TimeOf(const MeasuredView& view) {
  return view.taken ? view.taken : TimeIn(view.photo.stem().string());
}

// The last number in the file's name.
std::optional<std::int64_t> NumberOf(const MeasuredView& view) {
  constexpr std::size_t kMostDigits = 9;
  const std::string name = view.photo.stem().string();
  const auto end = name.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const auto before = name.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  if (end + 1 - begin > kMostDigits) return std::nullopt;
  return std::stoll(name.substr(begin, end + 1 - begin));
}

std::string TimeText(double seconds) {
  return seconds < 600 ? base::ShortNumber(seconds) + " s"
                       : base::ShortNumber(std::round(seconds / 60)) + " min";
}

Sign TimeSign() {
  return {.factor = 4, .least = 60, .text = [](double step) {
            return "taken " + TimeText(step) + " after";
          }};
}

Sign NumberSign() {
  return {.factor = 1.5, .least = 1.5, .equal_heaps = true, .text = [](double) {
            return std::string("numbers are missing between it and");
          }};
}

Sign PlaceSign() {
  return {.factor = 5, .least = 1, .text = [](double step) {
            return "the plate stands " + base::ShortNumber(step, 2) + " px off from where it is in";
          }};
}

// Neighbouring outlines of one heap differ by its grains; a hundredth of the powder's area is
// noise.
Sign OutlineSign(const MeasuredRun& run) {
  std::vector<double> nebp;
  for (const MeasuredView& view : run.views) nebp.push_back(view.nebp);
  const double usual = base::Median(nebp);
  return {.factor = 1.6, .least = 0.01 * usual, .text = [usual](double step) {
            return "its outline differs by " + base::ShortNumber(100 * step / usual, 2) +
                   " % of the powder's area, more than neighbours do, from";
          }};
}

}  // namespace

std::optional<PhotoWarning> DoubtOfOneHeap(const MeasuredRun& run) {
  if (run.views.size() < 2 * kFewestViews) return std::nullopt;
  if (const auto series = Ordered(run, TimeOf)) {
    if (auto doubt = DoubtBy(*series, TimeSign(), run.name)) return doubt;
  }
  if (const auto series = Ordered(run, NumberOf)) {
    if (auto doubt = DoubtBy(*series, NumberSign(), run.name)) return doubt;
  }
  const Series places = Steps(run, [](const MeasuredView& a, const MeasuredView& b) {
    return std::hypot(a.plate.center_x - b.plate.center_x, a.plate.baseline - b.plate.baseline);
  });
  if (auto doubt = DoubtBy(places, PlaceSign(), run.name)) return doubt;
  const Series outlines =
      Steps(run, [](const MeasuredView&, const MeasuredView& b) { return b.step; });
  return DoubtBy(outlines, OutlineSign(run), run.name);
}

}  // namespace talus::imaging
