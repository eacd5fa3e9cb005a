// The program `talus`.
#include <malloc.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/text/printable.h"
#include "experiments/app/command_line.h"

namespace {

// A reader that goes away (`talus status DIR | head`, Ctrl-C on `talus calibrate … | tee log`) must
// not end the program without a word, nor a file that grows past what `ulimit -f` allows: the write
// fails, and is told of. A handler instead of SIG_IGN: the programs we start begin with the default
// again.
void LetWritesFail() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &action, nullptr);
}

// Standard output holds the answer; where it cannot be written, a full disk say, there is none. A
// reader that has gone away wants no more.
void RequireAnswerWritten() {
  struct stat output {};
  if (std::cout.flush() || fstat(STDOUT_FILENO, &output) != 0 || S_ISFIFO(output.st_mode) ||
      S_ISSOCK(output.st_mode)) {
    return;
  }
  throw talus::base::Error("standard output cannot be written; is its disk full?");
}

// Between two loops OpenMP's threads (base/parallel_for.h) spin beside trials that need the cores,
// unless the environment forbids it. The library reads that before main does, hence the new start.
void WaitAsleep(char** argv) {
  if (getenv("OMP_WAIT_POLICY") != nullptr || getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown || setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
  execv(self.c_str(), argv);  // returns only if it fails; then the threads spin
}

// A surrogate makes and drops matrices of some megabytes all the time. What is handed back to the
// system for each of them must be cleared by it again, which takes a third of a short campaign.
void KeepMemory() {
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);  // the most that the library takes
  mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
}

// "Could not convert: --views = x" of CLI11, told as we would. Only numbers can fail to be read.
void RefuseUnreadable(const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ConversionError*>(&error) == nullptr) return;
  const std::string what = error.what();
  const std::size_t name = what.find("--");
  if (name == std::string::npos) return;
  throw talus::base::ConfigError(what.substr(name) + ": must be a number, not too large");
}

// CLI11 takes the next flag for the value of "--scale=".
void RefuseEmptyValues(std::span<char*> arguments) {
  for (const std::string argument : arguments) {
    if (argument == "--") return;  // what follows is another program's
    if (argument.starts_with("--") && argument.ends_with("=")) {
      throw talus::base::ConfigError("talus: " + argument + " has no value; give one after the =");
    }
  }
}

int Run(int argc, char** argv) {
  RefuseEmptyValues({argv, static_cast<std::size_t>(argc)});
  CLI::App app("calibrates discrete element models of powders from photographs of heaps", "talus");
  talus::app::DescribeCommandLine(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string suggestion =
        error.get_exit_code() == 0
            ? std::string()
            : talus::app::Suggestion(
                  app, std::span(argv + 1, static_cast<std::size_t>(std::max(argc - 1, 0))));
    if (!suggestion.empty()) throw talus::base::ConfigError("talus: " + suggestion);
    RefuseUnreadable(error);
    return app.exit(error) == 0 ? talus::base::kExitDone : talus::base::kExitBadInput;
  }
  return talus::base::kExitDone;
}

// What libraries throw, told as we would.
std::string InWords(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return "there is not enough memory for this";
  }
  if (const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    return files->path1().string() + ": " + files->code().message();
  }
  return "a library failed in a way that talus does not expect; please report this with the input "
         "(" +
         std::string(error.what()) + ")";
}

}  // namespace

int main(int argc, char** argv) {
  WaitAsleep(argv);
  KeepMemory();
  LetWritesFail();
  // Names, logs and messages of others are shown, never obeyed.
  const talus::base::PrintableStream output(std::cout);
  const talus::base::PrintableStream errors(std::cerr);
  try {
    const int status = Run(argc, argv);
    RequireAnswerWritten();
    return status;
  } catch (const talus::base::ConfigError& error) {
    std::cerr << error.what() << '\n';
    return talus::base::kExitBadInput;
  } catch (const talus::base::Interrupted& error) {
    std::cerr << "talus: " << error.what() << '\n';
    return talus::base::kExitInterrupted;
  } catch (const talus::base::Error& error) {
    std::cerr << "talus: " << error.what() << '\n';
    return talus::base::kExitFailed;
  } catch (const std::exception& error) {
    std::cerr << "talus: " << InWords(error) << '\n';
    return talus::base::kExitFailed;
  }
}
