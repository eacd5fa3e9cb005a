// `talus simulate`: what a file holds decides what is done with it.
#pragma once

#include <filesystem>

#include "base/json/json_file.h"
#include "experiments/trials/simulate/run_folder.h"

namespace talus::trials {

struct SimulateOptions {
  RunFolderOptions run;
  std::filesystem::path film{};  // to write of a bulk test; empty: none
};

// One kind of input: a top-level key that only it has, and what runs it. A new kind: a line in the
// list in simulate.cc.
struct InputKind {
  const char* key;
  const char* what;
  void (*run)(base::JsonFile input, const SimulateOptions& options);
};

// Reads the file's kind from its keys and runs it; throws ConfigError for an unknown kind.
void Simulate(const std::filesystem::path& input, const SimulateOptions& options);

}  // namespace talus::trials
