#include "experiments/analysis/predict/measured_process.h"

#include <algorithm>

#include "base/json/json_reader.h"
#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/spec/experiment_spec.h"
#include "experiments/campaign/spec/possible_numbers.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/formats/images/profile_file.h"

namespace talus::analysis {
namespace {

// What an experiment of a spec has measured; how it was made stands in the case.
struct MeasuredFile {
  campaign::ExperimentSpec experiment;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    campaign::ExperimentSpec::VisitData(self.experiment, visit);
  }
};

void RequireMeasuredBy(const PredictedCase& predicted,
                       const std::vector<campaign::ScalarSpec>& numbers, base::Problems& problems) {
  const bool scene = !predicted.scene_text.empty();
  const rigs::RigEntry& entry = rigs::EntryOf(predicted.rig_case);
  for (const campaign::ScalarSpec& number : numbers) {
    std::string all;
    bool known = false;
    for (const rigs::RigObservable& o : entry.observables) {
      known |= rigs::MetricName(o.observable) == number.metric;
      all += std::string(all.empty() ? "" : ", ") + rigs::InfoOf(o.observable).key;
    }
    problems.Require(!scene, number.key, "is no number of a scene: give a case of a bulk test");
    problems.Require(scene || known, number.key,
                     "is not measured by the rig " + std::string(base::NameOf(entry.kind)) +
                         ", which measures " + all);
  }
}

MeasuredProcess ReadData(const std::filesystem::path& path, const PredictedCase& predicted) {
  const base::JsonFile file = base::ReadJsonFile(path);
  campaign::ExperimentSpec e = base::LoadOptions<MeasuredFile>(file).experiment;
  e.name = "measured";  // the file has none
  e.rig = predicted.rig_case.rig;
  campaign::SetDrumDiameter(e.rig, e.images);
  MeasuredProcess measured{.numbers = campaign::ScalarsOf(e), .profile = {}};
  base::Problems problems(path.string(), file.places);
  e.Validate(problems);
  campaign::ValidateDrumImages(e, "", problems);
  campaign::RequirePossible(e.numbers, "", problems);
  RequireMeasuredBy(predicted, measured.numbers, problems);
  problems.ThrowIfAny();
  if (e.images.HasImages()) measured.profile = campaign::MeasureImages(e).aehp;
  return measured;
}

// That the image shows what the case's camera does.
void RequireComparable(const std::filesystem::path& path, const imaging::Frame& frame,
                       const PredictedCase& predicted) {
  const auto refuse = [&](const std::string& why) {
    throw base::ConfigError(path.string() + ": " + why);
  };
  if (!predicted.scene_text.empty()) {
    refuse("is an image, and a scene has none to compare it with; give a case of a bulk test");
  }
  const rigs::Case& rig_case = predicted.rig_case;
  const auto& camera = rig_case.rig.camera;
  const int num_pictures = camera ? camera->num_pictures() : 1;
  if (frame.num_pictures() != num_pictures) {
    refuse("shows " + base::Counted(frame.num_pictures(), "picture") + " where the case takes " +
           std::to_string(num_pictures) + " (rig.camera.times): give a picture for each time");
  }
  if (!campaign::IsWidthOf(rig_case, frame.plate_diameter)) {
    refuse("is scaled by a width of " + base::ShortNumber(1e3 * frame.plate_diameter) +
           " mm (plate_diameter) where that of the case is " +
           base::ShortNumber(1e3 * rigs::EntryOf(rig_case).width(rig_case)) +
           " mm: one of the two is wrong, or the image is of another test");
  }
}

}  // namespace

MeasuredProcess ReadMeasured(const std::filesystem::path& path, const PredictedCase& predicted) {
  const bool is_profile = std::filesystem::is_directory(path) || path.extension() == ".png";
  MeasuredProcess measured;
  if (!is_profile) {
    measured = ReadData(path, predicted);
  } else {
    measured.profile = imaging::ReadProfile(path);
    const auto& camera = predicted.rig_case.rig.camera;
    const bool is_grey = std::ranges::any_of(measured.profile->image.pixels,
                                             [](int level) { return level != 0 && level != 255; });
    if (camera && camera->shows == rigs::Shown::kAny && is_grey) {
      throw base::ConfigError(path.string() +
                              ": is grey where the case's camera shows powder that any picture "
                              "has: give a JSON file with it as \"map\", and a \"threshold\"");
    }
  }
  if (measured.profile) RequireComparable(path, measured.profile->frame, predicted);
  return measured;
}

}  // namespace talus::analysis
