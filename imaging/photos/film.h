// A film: the images of several times of the same runs, which one camera has taken.
#pragma once

#include <span>

#include "imaging/photos/experiment.h"

namespace talus::imaging {

// What the options say of one of the film's times.
ExperimentOptions OptionsAt(const ExperimentOptions& film, const FilmedPicture& picture);

// One experiment whose profiles are film strips, of the AEHP and run by run; what is measured of
// them is left to be done. Throws ConfigError where the times do not show the same runs in one
// frame.
Experiment JoinedFilm(std::span<const Experiment> pictures);

}  // namespace talus::imaging
