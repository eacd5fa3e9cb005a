#include "imaging/photos/film.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "base/text/counted.h"
#include "base/text/joined.h"
#include "imaging/heap/film_strip.h"
#include "imaging/heap/metrics.h"

namespace talus::imaging {
namespace {

std::string PlaceOf(std::size_t picture) { return "film[" + std::to_string(picture) + "]: "; }

// "3 runs (01, 02, 04)"
std::string RunsOf(const Experiment& picture) {
  const auto name = [](const MeasuredRun& run) { return run.name; };
  return base::Counted(std::ssize(picture.runs), "run") +
         (picture.runs.empty() ? "" : " (" + base::Joined(picture.runs, ", ", name) + ")");
}

void RequireOneFilm(std::span<const Experiment> pictures) {
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    try {
      RequireSameFrame(pictures[i].aehp.frame, pictures.front().aehp.frame);
    } catch (const base::ConfigError&) {
      throw base::ConfigError(
          PlaceOf(i) +
          "has another size or its plate elsewhere than the first picture: one camera takes a film "
          "and stands still; give all its pictures one size, and the plate's place as \"frame\"");
    }
    const std::string runs = RunsOf(pictures[i]), first = RunsOf(pictures.front());
    if (runs == first) continue;
    throw base::ConfigError(PlaceOf(i) + "is of " + runs + ", the first picture of " + first +
                            ": give the same runs in the same order at each time");
  }
}

// The profiles that `part` picks, side by side.
template <class Part>
Profile Strip(std::span<const Experiment> pictures, const Part& part) {
  std::vector<GrayImage> images;
  for (const Experiment& picture : pictures) images.push_back(part(picture).image);
  return {.image = SideBySide(images),
          .frame = StripOf(pictures.front().aehp.frame, static_cast<int>(pictures.size()))};
}

}  // namespace

ExperimentOptions OptionsAt(const ExperimentOptions& film, const FilmedPicture& picture) {
  ExperimentOptions options = film;
  options.film.reset();
  options.photos = picture.photos;
  options.runs = picture.runs;
  options.map = picture.map;
  return options;
}

Experiment JoinedFilm(std::span<const Experiment> pictures) {
  RequireOneFilm(pictures);
  Experiment film;
  film.aehp = Strip(pictures, [](const Experiment& e) -> const Profile& { return e.aehp; });
  film.photo_pixel = pictures.front().photo_pixel;
  film.runs = pictures.front().runs;
  for (std::size_t run = 0; run < film.runs.size(); ++run) {
    film.runs[run].profile = Strip(
        pictures, [run](const Experiment& e) -> const Profile& { return e.runs[run].profile; });
  }
  // Before a column collapses all are alike: that is judged of the film as a whole.
  const auto is_of_one = [](const PhotoWarning& w) { return w.doubt != PhotoDoubt::kNoNoise; };
  for (const Experiment& picture : pictures) {
    std::ranges::copy_if(picture.warnings, std::back_inserter(film.warnings), is_of_one);
    std::ranges::copy(picture.left_out, std::back_inserter(film.left_out));
  }
  return film;
}

}  // namespace talus::imaging
