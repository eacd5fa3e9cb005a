// Names of the files that talus itself writes into the folder of a run or trial, whatever engine
// simulates it.
#pragma once

#include <array>
#include <string_view>

namespace talus::rigs {

inline constexpr const char* kCaseFile = "case.json";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kLogFile = "log.txt";
inline constexpr const char* kTrialFile = "trial.json";  // why there is such a trial
inline constexpr const char* kProfileFile = "profile.png";
inline constexpr const char* kHeapFile = "heap.vtp";          // another engine may leave its own
inline constexpr const char* kCommandFile = ".command.json";  // another engine's, filled, as a list
inline constexpr const char* kCommandDone = ".command_done";  // left when it has ended well
inline constexpr const char* kFailedFile = ".failed";  // left in a case beside a campaign's trials
inline constexpr const char* kTookFile = ".took";  // there, too: core seconds of all its attempts
inline constexpr const char* kGroupFile = ".process_group";
inline constexpr const char* kTaskEndFile = ".slurm_end";  // written when a job's command has ended
inline constexpr const char* kTaskEndPart = ".slurm_end.part";

// What a campaign and its runners put there before and beside the engine.
inline constexpr std::array<std::string_view, 5> kFilesOfCampaign{kLogFile, kTrialFile, kGroupFile,
                                                                  kTaskEndFile, kTaskEndPart};

// What no result of another engine may be called.
inline constexpr std::array<std::string_view, 5> kNeverAResult{kCaseFile, kResultFile, kLogFile,
                                                               kTrialFile, kProfileFile};

}  // namespace talus::rigs
