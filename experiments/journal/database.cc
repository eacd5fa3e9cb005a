#include "experiments/journal/database.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "base/not_known.h"

namespace talus::journal {
namespace {

// SQLite's words, and the system's: "disk I/O error" may be a full disk.
std::string ReasonOf(sqlite3* database) {
  const std::string reason = sqlite3_errmsg(database);
  const int code = sqlite3_errcode(database);
  const int system = sqlite3_system_errno(database);
  // A log that cannot be made beside it: by then the system's word is another.
  if (code == SQLITE_CANTOPEN) {
    return reason +
           "; is the disk full, the folder read-only, or the path longer than some 500 bytes?";
  }
  return system == 0 || code != SQLITE_IOERR ? reason : reason + " (" + std::strerror(system) + ")";
}

[[noreturn]] void Fail(sqlite3* database, const std::string& doing) {
  const char* file = sqlite3_db_filename(database, "main");
  const std::string place = file != nullptr && *file != '\0' ? std::string(file) + ": " : "";
  const int code = sqlite3_errcode(database);
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED || code == SQLITE_PROTOCOL) {
    throw base::ConfigError(place + "another program holds it (" + ReasonOf(database) +
                            "); close that, and the same command goes on");
  }
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    // Who only reads is told what repairs it; `talus resume` itself opens it for writing.
    const bool only_reads = sqlite3_db_readonly(database, "main") == 1;
    throw base::Error(place + "is damaged (" + ReasonOf(database) + ")" +
                      (only_reads ? "; `talus resume` repairs it" : ""));
  }
  throw base::Error(place + doing + ": " + ReasonOf(database));
}

// "file:" URI of a path: what has a meaning in a URI is escaped.
std::string Uri(const std::filesystem::path& path, std::string_view query) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      constexpr const char* kDigits = "0123456789ABCDEF";
      const auto byte = static_cast<unsigned char>(c);
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    } else {
      uri += c;
    }
  }
  return uri + std::string(query);
}

// A log-mode database needs a writable folder even to be read, unless nobody can be writing it:
// then it is opened as a file that does not change. What is still in the log would be missed.
bool NeedsImmutable(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) == 0 || std::filesystem::exists(path.string() + "-shm")) {
    return false;
  }
  std::error_code none;
  const auto logged = std::filesystem::file_size(path.string() + "-wal", none);
  return none || logged == 0;
}

}  // namespace

Statement::Statement(sqlite3* database, std::string_view sql) : database_(database) {
  if (sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement_,
                         nullptr) != SQLITE_OK) {
    Fail(database, "a query cannot be prepared");
  }
}

Statement::Statement(Statement&& other) noexcept
    : database_(other.database_), statement_(std::exchange(other.statement_, nullptr)) {}

Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::Check(int code) const {
  if (code != SQLITE_OK) Fail(database_, "a value cannot be stored");
}

void Statement::BindOne(int index, std::int64_t value) {
  Check(sqlite3_bind_int64(statement_, index, value));
}

void Statement::BindOne(int index, double value) {
  Check(std::isfinite(value) ? sqlite3_bind_double(statement_, index, value)
                             : sqlite3_bind_null(statement_, index));
}

void Statement::BindOne(int index, std::string_view value) {
  Check(sqlite3_bind_text64(statement_, index, value.data() == nullptr ? "" : value.data(),
                            value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::BindOne(int index, Blob value) {
  Check(sqlite3_bind_blob64(statement_, index, value.bytes.data(), value.bytes.size(),
                            SQLITE_TRANSIENT));
}

bool Statement::Step() {
  switch (sqlite3_step(statement_)) {
    case SQLITE_ROW:
      return true;
    case SQLITE_DONE:
      return false;
    default:
      Fail(database_, "the journal cannot be read or written");
  }
}

void Statement::Finish() {
  while (Step()) {
  }
}

std::int64_t Statement::Integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::Real(int column) const {
  std::optional<double> value;
  ReadOne(column, value);
  return value.value_or(base::kNotKnown);
}

void Statement::ReadOne(int column, std::optional<double>& value) const {
  value.reset();
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return;
  value = sqlite3_column_double(statement_, column);
}

std::string Statement::Text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return bytes == nullptr ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
}

std::string Statement::Raw(int column) const {
  const int type = sqlite3_column_type(statement_, column);
  std::string bytes;
  if (type == SQLITE_FLOAT) {  // as text it would lose digits
    const double value = sqlite3_column_double(statement_, column);
    bytes.assign(reinterpret_cast<const char*>(&value), sizeof value);
  } else if (type != SQLITE_NULL) {
    bytes = Text(column);
  }
  return std::to_string(type) + '/' + std::to_string(bytes.size()) + ':' + bytes;
}

int Statement::NumColumns() const { return sqlite3_column_count(statement_); }

Database::Database(const std::filesystem::path& path, Mode mode) {
  int flags = SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  if (mode == Mode::kReadOnly) {
    flags |= SQLITE_OPEN_READONLY;
  } else {
    flags |= SQLITE_OPEN_READWRITE | (mode == Mode::kCreate ? SQLITE_OPEN_CREATE : 0);
  }
  const bool immutable = mode == Mode::kReadOnly && NeedsImmutable(path);
  const std::string uri = Uri(path, immutable ? "?immutable=1" : "");
  if (sqlite3_open_v2(uri.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string reason = ReasonOf(handle_);
    sqlite3_close(std::exchange(handle_, nullptr));
    throw base::Error(path.string() + ": cannot be opened: " + reason);
  }
  sqlite3_busy_timeout(handle_, 10'000);
  try {
    if (mode != Mode::kReadOnly) Execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
    Execute("PRAGMA foreign_keys = ON;");
  } catch (...) {
    sqlite3_close(std::exchange(handle_, nullptr));
    throw;
  }
}

Database::Database(Database&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}

Database& Database::operator=(Database&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

Database::~Database() { sqlite3_close(handle_); }

void Database::Execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    Fail(handle_, "the journal cannot be read or written");
  }
}

std::int64_t Database::Number(std::string_view sql) {
  Statement row = Prepare(sql);
  return row.Step() ? row.Integer(0) : 0;
}

std::string Database::Damage() {
  try {
    Statement check = Prepare("PRAGMA quick_check(1)");
    const std::string answer = check.Step() ? check.Text(0) : "no answer";
    return answer == "ok" ? "" : answer;
  } catch (const base::ConfigError&) {
    throw;  // held by another program, which is no damage
  } catch (const base::Error& error) {
    return error.what();
  }
}

Transaction::Transaction(Database& database, base::Outlives outlives)
    : database_(database), outlives_(outlives) {
  if (outlives_ == base::Outlives::kProgram) database_.Execute("PRAGMA synchronous = NORMAL");
  database_.Execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (done_) return;
  try {
    database_.Execute("ROLLBACK");
  } catch (const base::Error&) {
    // SQLite has rolled back already, as it does when the disk is full; the first error stands.
  }
  try {
    SyncFully();
  } catch (const base::Error&) {
    // A database that takes no pragma takes no commit either.
  }
}

void Transaction::SyncFully() {
  if (outlives_ == base::Outlives::kProgram) database_.Execute("PRAGMA synchronous = FULL");
}

void Transaction::Commit() {
  database_.Execute("COMMIT");
  done_ = true;
  SyncFully();
}

}  // namespace talus::journal
