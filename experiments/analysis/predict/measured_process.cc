#include "experiments/analysis/predict/measured_process.h"

#include "base/json/json_reader.h"
#include "base/text/counted.h"
#include "experiments/campaign/spec/possible_numbers.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/photos/experiment.h"

namespace talus::analysis {
namespace {

// An experiment of a spec without its name and its rig.
struct MeasuredFile {
  imaging::ExperimentOptions images;
  campaign::MeasuredNumbers numbers;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    imaging::ExperimentOptions::Visit(self.images, visit);
    campaign::MeasuredNumbers::Visit(self.numbers, visit);
  }
  void Validate(base::Problems& problems) const {
    problems.Require(images.HasImages() || !campaign::ScalarsOf(numbers).empty(), "",
                     "has no data: give photos, runs or a map, or numbers with their errors such "
                     "as \"angle\": {\"value\": \"38 deg\", \"sd\": \"1 deg\"}");
    if (images.HasImages()) images.Validate(problems);
    campaign::RequirePossible(numbers, "", problems);
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

}  // namespace

MeasuredProcess ReadMeasured(const std::filesystem::path& path, const PredictedCase& predicted) {
  MeasuredProcess measured;
  if (std::filesystem::is_directory(path) || path.extension() == ".png") {
    measured.profile = imaging::ReadProfile(path);
  } else {
    const base::JsonFile file = base::ReadJsonFile(path);
    const auto read = base::LoadOptions<MeasuredFile>(file);
    measured.numbers = campaign::ScalarsOf(read.numbers);
    base::Problems problems(path.string(), file.places);
    RequireMeasuredBy(predicted, measured.numbers, problems);
    problems.ThrowIfAny();
    if (read.images.HasImages()) measured.profile = imaging::MeasureExperiment(read.images).aehp;
  }
  if (measured.profile && !predicted.scene_text.empty()) {
    throw base::ConfigError(path.string() +
                            ": is an image, and a scene has none to compare it with; give a case "
                            "of a bulk test");
  }
  const auto& camera = predicted.rig_case.rig.camera;
  const int num_pictures = camera ? camera->num_pictures() : 1;
  if (measured.profile && measured.profile->frame.num_pictures() != num_pictures) {
    throw base::ConfigError(path.string() + ": shows " +
                            base::Counted(measured.profile->frame.num_pictures(), "picture") +
                            " where the case takes " + std::to_string(num_pictures) +
                            " (rig.camera.times): give a picture for each time");
  }
  return measured;
}

}  // namespace talus::analysis
