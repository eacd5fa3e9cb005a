// Whether the tables are those that kSchema makes. A bit that is turned over in a journal's own
// text of them leaves rows and checksums whole, and a column under another name.
#pragma once

#include <string>

#include "experiments/journal/database.h"

namespace talus::journal {

// "the table metrics is not as it was made"; empty where all are. Comments and spaces do not count.
std::string DamagedTables(Database& database);

}  // namespace talus::journal
