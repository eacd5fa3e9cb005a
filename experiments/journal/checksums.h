// Checksums of what the journal holds. SQLite keeps none of its rows: when bits of the file were
// flipped, one flip in twenty went unnoticed, and a campaign could end with another answer.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/journal/database.h"

namespace talus::journal {

// To be called within the transaction that has changed them. A trial is its row with its point and
// metrics; the campaign is its row with the parameters and all of its experiments. Events have
// none: people look them up, and nothing is made of them.
void SealTrial(Database& database, std::int64_t trial);
void SealCampaign(Database& database);
void SealAll(Database& database);

// What does not match its checksum, in words; empty when all does.
std::string BrokenSeal(Database& database);

}  // namespace talus::journal
