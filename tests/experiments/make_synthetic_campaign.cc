// make_synthetic_campaign FOLDER TRIALS PARAMETERS finished|running [coarse_design|much_to_say]: a
// campaign to test with.
#include <iostream>
#include <string>

#include "tests/experiments/synthetic_campaign.h"
#include "tests/experiments/synthetic_journal.h"

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::cerr << "make_synthetic_campaign FOLDER TRIALS PARAMETERS finished|running "
                 "[coarse_design|much_to_say]\n";
    return 2;
  }
  using namespace talus::test;
  const std::string more = argc == 6 ? argv[5] : "";
  const SyntheticOptions options{.num_trials = std::stoi(argv[2]),
                                 .num_parameters = std::stoi(argv[3]),
                                 .concluded = std::string(argv[4]) == "finished",
                                 .coarse_design = more == "coarse_design",
                                 .much_to_say = more == "much_to_say"};
  WriteSyntheticJournal(MakeSyntheticCampaign(options), argv[1]);
  return 0;
}
