// The folder of a search by `talus optimize`: what makes it resume where it was killed.
//
//   problem.json        the problem and the command, as they were read
//   evaluations.jsonl   one line an evaluation, written when it ends
//   images/0007.csv     the image of evaluation 7, where the command returns images
//   result.json         the recommendation, when the search has ended
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "experiments/trials/optimize/evaluator.h"

namespace talus::trials {

// So many failures and no success: the command is wrong, not the parameters.
inline constexpr int kHopeless = 8;

class OptimizeFolder {
 public:
  // Makes the folder, or takes over one of the same problem; `evaluations`, `workers` and
  // `time_cap` may differ. Where it holds no success, and failures for which the search before gave
  // up, they are made again: the command has been mended. Throws base::ConfigError where the
  // problem is another one or files are damaged, and base::Error while another process works in it.
  OptimizeFolder(std::filesystem::path root, const OptimizeProblem& problem,
                 const std::vector<std::string>& command);

  // Evaluation `number`, from 1, if it ended in an earlier run.
  std::optional<Evaluated> Recorded(int number) const;
  int num_recorded() const { return static_cast<int>(recorded_.size()); }
  // The first so many are told at once. Those of the last batch come when it is asked for again,
  // which it is where as many workers ask; others would ask for other points, so they are told,
  // too.
  int NumToTell() const;

  // Safe from several threads. The line is there, complete, when this returns. `asked_after`: how
  // many had been told when it was asked for.
  void Record(int number, const Evaluated& evaluated, int asked_after, int image_width);

  void WriteResult(const std::string& json) const;

  // All evaluations have failed: whoever gives the same command again has mended it.
  void NoteGivenUp() const;

 private:
  struct Asking {
    int after = 0;
    int workers = 0;
  };

  std::filesystem::path ImagePath(int number) const;
  void CheckProblem(const std::vector<std::string>& command) const;
  void Load();
  // Throws where the image of an evaluation is not the one that was answered.
  void CheckImage(int number, const std::string& checksum, int line_number) const;

  std::filesystem::path root_;
  const OptimizeProblem& problem_;
  std::map<int, Evaluated> recorded_;
  std::map<int, Asking> asked_;  // how each of these was asked for
  std::mutex writing_;
  base::Descriptor lock_;
  base::Descriptor log_;
};

}  // namespace talus::trials
