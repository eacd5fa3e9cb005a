// What is fuzzed: one function for each reader of files that others have written.
//
// Built twice. In the suite tests/fuzz/corpus_test runs each target over its corpus; with
// `cmake --preset fuzz` each becomes a libFuzzer program, fuzz_NAME (tests/fuzz/README.md).
#pragma once

#include <span>
#include <string_view>

namespace talus::fuzz {

struct Target {
  std::string_view name;  // of the folder in tests/fuzz/corpus as well
  // Returns whatever the bytes are. An error that the reader reports is none here; anything else
  // that is thrown, and what a sanitizer sees, is a finding.
  void (*run)(std::string_view bytes);
};

std::span<const Target> ImagingTargets();     // images and files of spheres
std::span<const Target> EngineTargets();      // scenes, size files, checkpoints
std::span<const Target> ExperimentTargets();  // specs, cases, problems, templates, journals, Slurm

// Runs `read`; what base::Error says is for the user.
template <class Read>
void Expect(Read&& read);

}  // namespace talus::fuzz

#include "base/error.h"

template <class Read>
void talus::fuzz::Expect(Read&& read) {
  try {
    read();
  } catch (const base::Error&) {
  }
}
