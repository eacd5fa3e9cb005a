#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/trials/measure/measure_request.h"
#include "imaging/formats/images/profile_file.h"

namespace talus::app {
namespace {

constexpr int kUsualViews = 16;

// The flags as they are typed; lengths and angles carry their units.
struct MeasureFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string plate_diameter;
  std::string scale;
  std::string pattern;
  std::string frame;
  std::string tilt;
  std::string pixel_size;
  std::string like;
  std::string length_unit;
  std::string powder = "auto";
  std::optional<double> threshold{};
  std::optional<int> views{};
  std::string diameter;  // of a drum
  std::string circle_diameter;
  std::string turning;
  bool drum = false;
  bool map = false;
  bool allow_missing_views = false;
  bool choose_mass = false;
};

// What the input is, by the flags; each kind leaves some flags without an effect.
enum InputKind : unsigned { kPhotos = 1, kMap = 2, kDrum = 4, kSpheres = 8 };

struct InputKindText {
  InputKind kind;
  const char* text;
};

InputKindText InputKindOf(const MeasureFlags& flags) {
  if (!flags.like.empty()) return {kSpheres, "has no effect on spheres"};
  if (flags.drum) return {kDrum, "has no effect on a drum"};
  if (flags.map) return {kMap, "has no effect on a map"};
  return {kPhotos, "has no effect on photographs of a heap"};
}

void RefuseIdleFlags(const MeasureFlags& flags) {
  const auto refuse = [](bool given, const char* flag, const char* why) {
    if (given) throw base::ConfigError(std::string(flag) + ": " + why + "; leave it out");
  };
  refuse(!flags.tilt.empty() && flags.frame.empty(), "--tilt", "is of a plate given by --frame");
  struct Use {
    const char* flag;
    bool given;
    unsigned kinds;  // on which it has an effect
  };
  const Use uses[] = {{"--scale", !flags.scale.empty(), kPhotos},
                      {"--pixel-size", !flags.pixel_size.empty(), kPhotos},
                      {"--tilt", !flags.tilt.empty(), kPhotos},
                      {"--threshold", flags.threshold.has_value(), kPhotos},
                      {"--powder", flags.powder != "auto", kPhotos},
                      {"--choose-mass", flags.choose_mass, kPhotos},
                      {"--map", flags.map, kMap},
                      {"--drum", flags.drum, kDrum},
                      {"--plate-diameter", !flags.plate_diameter.empty(), kPhotos | kMap},
                      {"--frame", !flags.frame.empty(), kPhotos | kMap},
                      {"--pattern", !flags.pattern.empty(), kPhotos},
                      {"--allow-missing-views", flags.allow_missing_views, kPhotos},
                      {"--views", flags.views.has_value(), kSpheres},
                      {"--length-unit", !flags.length_unit.empty(), kSpheres}};
  const auto [kind, why] = InputKindOf(flags);
  for (const Use& use : uses) refuse(use.given && (use.kinds & kind) == 0, use.flag, why);
}

// A bare number would be in m or rad, which nobody means here.
double WithItsUnit(const std::string& flag, const std::string& text, base::Dimension dimension) {
  if (base::IsBareNumber(text)) {
    const char* const unit = dimension == base::Dimension::kAngle ? "deg" : "mm";
    throw base::ConfigError(flag + ": " + text + " has no unit; write " + text + unit + " for " +
                            text + " " + unit);
  }
  return FlagQuantity(flag, text, dimension);
}

// What only one kind of test has stands with it alone.
std::optional<imaging::DrumPhotos> Drum(const MeasureFlags& flags) {
  if (!flags.drum) {
    if (flags.diameter.empty() && flags.circle_diameter.empty() && flags.turning.empty()) {
      return std::nullopt;
    }
    throw base::ConfigError(
        "--diameter, --circle-diameter and --turning are of a drum; add --drum");
  }
  if (flags.diameter.empty()) {
    throw base::ConfigError("--diameter is missing; give the drum's with its unit: 84mm");
  }
  imaging::DrumPhotos options{
      .photos = {},
      .diameter = WithItsUnit("--diameter", flags.diameter, base::Dimension::kLength)};
  if (!flags.circle_diameter.empty()) {
    options.circle_diameter =
        WithItsUnit("--circle-diameter", flags.circle_diameter, base::Dimension::kLength);
  }
  options.turning = base::EnumNamed<imaging::Turning>(flags.turning);
  return options;
}

imaging::ExperimentOptions Experiment(const MeasureFlags& flags) {
  using base::Dimension;
  imaging::ExperimentOptions options;
  if (!flags.plate_diameter.empty()) {
    options.plate_diameter =
        WithItsUnit("--plate-diameter", flags.plate_diameter, Dimension::kLength);
  }
  options.pattern = flags.pattern;
  if (!flags.frame.empty()) {
    options.frame = imaging::ReadFrame(flags.frame);
    if (flags.plate_diameter.empty()) options.plate_diameter = options.frame->plate_diameter;
  }
  if (!flags.tilt.empty()) options.tilt = WithItsUnit("--tilt", flags.tilt, Dimension::kAngle);
  if (!flags.pixel_size.empty()) {
    options.pixel_size = WithItsUnit("--pixel-size", flags.pixel_size, Dimension::kLength);
  }
  options.threshold = flags.threshold;
  options.powder = base::EnumNamed<imaging::PowderLook>(flags.powder).value_or(options.powder);
  options.allow_missing_views = flags.allow_missing_views;
  options.scale = flags.scale;
  if (options.plate_diameter == 0 && flags.like.empty() && flags.scale.empty() && !flags.drum) {
    throw base::ConfigError(
        "--plate-diameter is missing; give it with its unit: 10mm; or, of a heap on a table "
        "without a "
        "plate, two points in pixels and the length between them: --scale "
        "\"104,310-884,312=30mm\"");
  }
  return options;
}

// Files of spheres are measured in the frame of an experiment, and no other input is.
void CheckSpheres(const MeasureFlags& flags) {
  if (!flags.like.empty()) return;
  for (const std::filesystem::path input : flags.inputs) {
    const std::string kind = input.extension().string();
    if (kind != ".vtp" && kind != ".vtk" && kind != ".vtu" && kind != ".csv") continue;
    throw base::ConfigError(
        input.string() +
        ": holds spheres, no image; they are drawn as a photographed heap was: add --like DIR, the "
        "folder that `talus measure PHOTOS --out DIR` has written, or its profile with the frame");
  }
}

void Measure(const MeasureFlags& flags) {
  CheckSpheres(flags);
  trials::MeasureRequest request{.inputs = {flags.inputs.begin(), flags.inputs.end()},
                                 .out = flags.out,
                                 .experiment = Experiment(flags),
                                 .drum = Drum(flags),
                                 .is_map = flags.map,
                                 .like = flags.like,
                                 .num_views = flags.views.value_or(kUsualViews),
                                 .length_unit = std::nullopt};
  RefuseIdleFlags(flags);
  if (!flags.length_unit.empty()) {
    request.length_unit =
        FlagQuantity("--length-unit", "1 " + flags.length_unit, base::Dimension::kLength);
  }
  if (!flags.like.empty()) {
    trials::MeasureSpheres(request, std::cout);
  } else if (request.drum) {
    trials::MeasureDrums(request, std::cout);
  } else if (flags.choose_mass) {
    trials::MeasureMasses(request, std::cout);
  } else {
    trials::MeasurePhotos(request, std::cout);
  }
}

void AddPhotoFlags(CLI::App& verb, MeasureFlags& flags) {
  verb.add_option("--plate-diameter", flags.plate_diameter,
                  "diameter of the plate with its unit, such as 10mm");
  verb.add_option(
      "--scale", flags.scale,
      "of a heap on a table without a plate: two points in pixels and the length between "
      "them, such as \"104,310-884,312=30mm\"");
  verb.add_option(
      "--pattern", flags.pattern,
      "file names in a folder: {run}, {view}, *, such as {run}/{view}.jpg; default: what fits");
  verb.add_flag("--map", flags.map, "the input is a grey average map, black = powder");
  verb.add_option("--frame", flags.frame,
                  "JSON file with the plate's place, instead of finding it (see docs/imaging.md)");
  verb.add_option("--tilt", flags.tilt,
                  "with --frame: tilt of the plate, such as 0.5deg; > 0 where its right "
                  "end is lower");
  verb.add_option("--pixel-size", flags.pixel_size, "of the profiles, such as 50um");
  verb.add_option("--threshold", flags.threshold,
                  "darker than this share of the background is powder, in (0, 1)");
  verb.add_option("--powder", flags.powder,
                  "before its background: dark (lit from behind), bright (lit from the front)")
      ->check(CLI::IsMember(base::NamesOf<imaging::PowderLook>()))
      ->capture_default_str();
  verb.add_flag("--allow-missing-views", flags.allow_missing_views,
                "go on without views that are missing or unusable, and say which");
}

void AddDrumFlags(CLI::App& verb, MeasureFlags& flags) {
  verb.add_flag("--drum", flags.drum,
                "photographs of a turning drum, a series or its average: angle, fill, map");
  verb.add_option("--diameter", flags.diameter,
                  "with --drum: of the drum inside, such as 84mm; of the circle that is seen, too, "
                  "where there is no --circle-diameter");
  verb.add_option("--circle-diameter", flags.circle_diameter,
                  "with --drum: of the ring's outside, where that is the circle that is seen");
  verb.add_option("--turning", flags.turning,
                  "with --drum: as the camera sees it; default: read from the picture")
      ->check(CLI::IsMember(base::NamesOf<imaging::Turning>()));
}

}  // namespace

void AddMeasureCommand(CLI::App& app) {
  auto flags = std::make_shared<MeasureFlags>();
  CLI::App* const verb = app.add_subcommand(
      "measure", "Photographs, maps or spheres to profiles, NEBP and angles of repose");
  verb->add_option("input", flags->inputs,
                   "a folder of photographs, photographs one by one, a map, folders by mass, or "
                   "files of spheres")
      ->required();
  verb->add_option("--out", flags->out, "folder for images, tables and overlays");
  AddPhotoFlags(*verb, *flags);
  AddDrumFlags(*verb, *flags);
  verb->add_flag("--choose-mass", flags->choose_mass,
                 "folders named by mass and day (1.5g_day1): NEBP table, plot and choice");
  verb->add_option("--like", flags->like,
                   "the inputs are spheres: project and compare them like this AEHP, the folder "
                   "that --out wrote");
  verb->add_option("--views", flags->views, "views of spheres over 180 degrees")
      ->default_str(std::to_string(kUsualViews));
  verb->add_option("--length-unit", flags->length_unit, "unit of a sphere file, such as mm");
  verb->callback([flags] { Measure(*flags); });
}

}  // namespace talus::app
