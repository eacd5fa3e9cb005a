#include "experiments/trials/optimize/optimize_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/files/file_lock.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/number_text.h"
#include "experiments/trials/optimize/optimize_result_json.h"
#include "optimizer/space/point_rows.h"

namespace talus::trials {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* kProblem = "problem.json";
constexpr const char* kRecommendation = "result.json";
constexpr const char* kLog = "evaluations.jsonl";
constexpr const char* kGivenUp = "gave_up";
constexpr const char* kImageChecksum = "image_checksum_xxh3";

std::string ChecksumOf(const std::string& bytes) { return base::Hex(base::Checksum(bytes)); }

base::Descriptor Open(const std::filesystem::path& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) base::ThrowUnwritten(path, errno);
  return base::Descriptor(file);
}

// What must stay the same for the recorded evaluations to count.
json Lasting(json problem) {
  for (const char* key : {"evaluations", "workers", "time_cap", "time_cap_s"}) problem.erase(key);
  // By what was read, not by the name of the file.
  if (problem.contains("target")) problem["target"].erase("profile");
  problem.erase("candidates");
  return problem;
}

// Checksums of the files that the problem names.
json ReadFiles(const OptimizeProblem& problem) {
  json read = json::object();
  if (problem.target && !problem.target->profile.empty()) {
    read["target"] = ChecksumOf(base::ReadFile(problem.target->profile));
  }
  if (!problem.space.candidates.empty()) {
    read["candidates"] = ChecksumOf(base::ReadFile(problem.space.candidates));
  }
  return read;
}

std::vector<double> ToList(const Eigen::VectorXd& point) { return {point.begin(), point.end()}; }

}  // namespace

OptimizeFolder::OptimizeFolder(std::filesystem::path root, const OptimizeProblem& problem,
                               const std::vector<std::string>& command)
    : root_(std::move(root)), problem_(problem) {
  base::MakeOutputFolder(root_);
  lock_ = Open(root_ / "optimize.lock", O_RDWR);
  constexpr std::chrono::milliseconds kPatience{2000};
  constexpr std::chrono::milliseconds kPause{50};
  const base::LockEnd end = base::LockWithin(lock_.get(), kPatience, kPause);
  if (end != base::LockEnd::kTaken) {
    throw base::Error(root_.string() +
                      (end == base::LockEnd::kNone
                           ? base::kNoLocks
                           : ": another process works on this search; end it first, or wait"));
  }
  CheckProblem(command);
  Load();
  std::filesystem::remove(root_ / kRecommendation);  // of a search that had ended, and goes on
  log_ = Open(root_ / kLog, O_WRONLY | O_APPEND);
}

void OptimizeFolder::CheckProblem(const std::vector<std::string>& command) const {
  const std::filesystem::path path = root_ / kProblem;
  const json now = base::ToJson(problem_);
  const json read = ReadFiles(problem_);
  if (std::filesystem::exists(path)) {
    const std::string bytes = base::ReadFile(path);
    const std::optional<std::string> text = base::IfWhole(bytes);
    const json before = json::parse(text.value_or(""), nullptr, false);
    if (!before.is_object() || !before.contains("problem")) {
      throw base::ConfigError(path.string() + ": is damaged; give another folder as --out");
    }
    if (Lasting(before["problem"]) != Lasting(now) || before["read"] != read) {
      throw base::ConfigError(root_.string() +
                              ": holds a search of another problem (see its problem.json); only "
                              "evaluations, workers and time_cap may change. Give another folder "
                              "as --out");
    }
    if (before["command"] != json(command)) {
      throw base::ConfigError(root_.string() + ": holds what another command has answered, " +
                              base::JsonText(before["command"]) +
                              "; give that one, or another folder as --out");
    }
  }
  const json both{{"problem", now}, {"read", read}, {"command", command}};
  base::WriteFileAtomically(path, base::WithChecksum(base::JsonText(both, 2) + "\n"));
}

std::filesystem::path OptimizeFolder::ImagePath(int number) const {
  return root_ / "images" / (base::FileNumber(number) + ".csv");
}

// A line that a kill has cut off is no evaluation: it is taken away, and made again. One that was
// damaged since would be another answer.
void OptimizeFolder::Load() {
  const std::filesystem::path path = root_ / kLog;
  if (!std::filesystem::exists(path)) return;
  const std::string text = base::ReadFile(path);
  const std::size_t complete = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  int line_number = 0;
  for (std::size_t start = 0; start < complete;) {
    const std::size_t end = text.find('\n', start);
    ++line_number;
    const auto whole = base::IfWhole(text.substr(start, end + 1 - start));
    start = end + 1;
    if (!whole) {
      throw base::ConfigError(path.string() + ":" + std::to_string(line_number) +
                              ": is damaged: it does not match its checksum; take the line away, "
                              "it will be made again");
    }
    const auto line = json::parse(*whole);
    const int number = line["evaluation"].get<int>();
    Evaluated evaluated;
    evaluated.observation.point = optimizer::VectorOf(line["point"].get<std::vector<double>>());
    evaluated.observation.failed = line.contains("failed");
    if (evaluated.observation.failed) {
      evaluated.failure = line["failed"].get<std::string>();
    } else {
      evaluated.observation.value = line.value("value", 0.0);
      if (problem_.target) {
        CheckImage(number, line.value(kImageChecksum, ""), line_number);
        evaluated.observation.field = ReadAnswerImage(ImagePath(number)).field;
      }
    }
    recorded_.insert_or_assign(number, std::move(evaluated));
    asked_[number] = {.after = line.value("asked_after", 0), .workers = line.value("workers", 0)};
  }
  std::size_t kept = complete;
  const bool any = std::ranges::any_of(
      recorded_, [](const auto& known) { return !known.second.observation.failed; });
  // The command was wrong, and has been mended since; what failed says nothing of the parameters,
  // now or when the mended one has succeeded.
  const bool gave_up = std::filesystem::remove(root_ / kGivenUp);
  if (!any && (gave_up || num_recorded() >= kHopeless)) {
    recorded_.clear();
    asked_.clear();
    kept = 0;
  }
  if (kept < text.size()) std::filesystem::resize_file(path, kept);
}

void OptimizeFolder::CheckImage(int number, const std::string& checksum, int line_number) const {
  const std::filesystem::path path = ImagePath(number);
  if (std::filesystem::exists(path) && ChecksumOf(base::ReadFile(path)) == checksum) return;
  throw base::ConfigError(path.string() + ": is damaged or gone; take line " +
                          std::to_string(line_number) + " of " + (root_ / kLog).string() +
                          " away, and its evaluation will be made again");
}

std::optional<Evaluated> OptimizeFolder::Recorded(int number) const {
  const auto found = recorded_.find(number);
  return found == recorded_.end() ? std::nullopt : std::optional(found->second);
}

void OptimizeFolder::NoteGivenUp() const { base::WriteFileAtomically(root_ / kGivenUp, ""); }

int OptimizeFolder::NumToTell() const {
  int complete = 0;
  while (complete < problem_.evaluations && recorded_.contains(complete + 1)) ++complete;
  if (complete == 0 || complete == problem_.evaluations) return complete;
  const Asking& last = asked_.at(complete);
  return last.workers == problem_.workers ? last.after : complete;
}

void OptimizeFolder::Record(int number, const Evaluated& evaluated, int asked_after,
                            int image_width) {
  const optimizer::Observation& observation = evaluated.observation;
  json line{{"evaluation", number},
            {"parameters", NativeParameters(problem_, observation.point)},
            {"point", ToList(observation.point)},
            {"asked_after", asked_after},
            {"workers", problem_.workers}};
  if (observation.failed) {
    line["failed"] = evaluated.failure;
  } else {
    line["value"] = observation.value;
  }
  if (!observation.field.empty()) {
    std::filesystem::create_directories(root_ / "images");
    const std::string image = ToCsv(observation.field, image_width);
    base::WriteFileAtomically(ImagePath(number), image, base::Outlives::kProgram);
    line[kImageChecksum] = ChecksumOf(image);
  }
  const std::string text = base::WithChecksum(base::JsonText(line) + "\n");
  const std::lock_guard guard(writing_);
  const off_t end = ::lseek(log_.get(), 0, SEEK_END);
  const ssize_t written = ::write(log_.get(), text.data(), text.size());
  if (written == static_cast<ssize_t>(text.size())) return;
  const int error = written < 0 ? errno : ENOSPC;  // the disk has filled up within the line
  // No line of another evaluation may follow half of this one.
  [[maybe_unused]] const int shortened = ::ftruncate(log_.get(), end);
  base::ThrowUnwritten(root_ / kLog, error);
}

void OptimizeFolder::WriteResult(const std::string& json) const {
  base::WriteFileAtomically(root_ / kRecommendation, base::WithChecksum(json));
}

}  // namespace talus::trials
