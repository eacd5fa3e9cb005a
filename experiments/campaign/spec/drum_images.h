// Photographs of a turning drum as a campaign's images: read as `talus measure --drum` reads them,
// turning as the rig `drum` does, and known only inside the ring.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/problems.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "imaging/photos/experiment.h"

namespace talus::campaign {

bool IsDrum(const std::optional<rigs::RigOptions>& rig);
bool HasFill(const ExperimentSpec& experiment);  // in place of a mass

// Whether its images are photographs of a drum: `photos` a series of one camera, or `map` the
// average of one. A map with a frame is a profile already. The rig is filled in.
bool ShowsDrum(const ExperimentSpec& experiment);

// Adds a problem for each option that a drum's photographs do not take, and for each of theirs that
// other images do not. `place` is the experiment's in its file, empty for the whole file.
void ValidateDrumImages(const ExperimentSpec& experiment, const std::string& place,
                        base::Problems& problems);

// The experiment of a drum or a heap. Throws ConfigError that names the file and what to do.
imaging::Experiment MeasureImages(const ExperimentSpec& experiment);

// How the photographs of heaps are read (imaging::ReadingText); empty for a drum, a map, numbers.
std::string ReadingText(const ExperimentSpec& experiment);

// The same for those that have photographs, each with its name.
std::vector<std::string> ReadingTexts(const std::vector<ExperimentSpec>& experiments);

// The width of drums' images is their rig's, where it is not given.
void SetDrumDiameter(const std::optional<rigs::RigOptions>& rig,
                     imaging::ExperimentOptions& images);
void SetDrumDiameters(CampaignSpec& spec);

// A drum without a mass is as full as its photographs show, which are read, unless its fill is
// searched.
void SetDrumFills(CampaignSpec& spec);

}  // namespace talus::campaign
