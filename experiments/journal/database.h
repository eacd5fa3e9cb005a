// SQLite, reduced to what the journal needs: statements with bound values, rows, transactions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/field.h"
#include "base/files/file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace talus::journal {

struct Blob {
  std::string_view bytes;
};

// A prepared statement: bind what stands for its question marks, then step through its rows.
class Statement {
 public:
  Statement(sqlite3* database, std::string_view sql);
  Statement(Statement&&) noexcept;
  ~Statement();

  // Values for ?1, ?2, …; a number that is not finite is stored as NULL.
  template <class... Values>
  Statement& Bind(const Values&... values) {
    int index = 0;
    (BindOne(++index, values), ...);
    return *this;
  }
  // The next row; false after the last. Throws base::Error with SQLite's reason.
  bool Step();
  void Finish();  // steps to the end

  // The values of this row's columns from `column` on.
  template <class... Values>
  void Read(int column, Values&... values) const {
    (ReadOne(column++, values), ...);
  }
  std::int64_t Integer(int column) const;
  double Real(int column) const;       // NaN for NULL
  std::string Text(int column) const;  // or a blob
  // The type, the size and every bit of the value, whatever it is.
  std::string Raw(int column) const;
  int NumColumns() const;

 private:
  void BindOne(int index, std::int64_t value);
  void BindOne(int index, int value) { BindOne(index, static_cast<std::int64_t>(value)); }
  void BindOne(int index, double value);
  void BindOne(int index, std::string_view value);
  void BindOne(int index, Blob value);
  void ReadOne(int column, std::int64_t& value) const { value = Integer(column); }
  void ReadOne(int column, int& value) const { value = static_cast<int>(Integer(column)); }
  void ReadOne(int column, double& value) const { value = Real(column); }
  void ReadOne(int column, std::optional<double>& value) const;  // nothing for NULL
  void ReadOne(int column, std::string& value) const { value = Text(column); }
  template <base::NamedEnum Enum>
  void ReadOne(int column, Enum& value) const {
    const auto named = base::EnumNamed<Enum>(Text(column));
    if (!named) {
      throw base::Error("the journal holds \"" + Text(column) + "\", which is not known here");
    }
    value = *named;
  }
  void Check(int code) const;

  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
};

class Database {
 public:
  enum class Mode { kCreate, kReadWrite, kReadOnly };

  // Read-write databases keep a write-ahead log and sync every commit (WAL, synchronous FULL), so
  // that readers never wait and a power cut loses nothing that was committed; see Transaction.
  Database(const std::filesystem::path& path, Mode mode);
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database();

  void Execute(const std::string& sql);  // one or more statements without values or rows
  Statement Prepare(std::string_view sql) { return Statement(handle_, sql); }
  std::int64_t Number(std::string_view sql);  // the first value that it finds; 0 for none

  // Empty when the file is sound, else what is wrong with it.
  std::string Damage();

 private:
  sqlite3* handle_ = nullptr;
};

// Everything until Commit happens, or nothing does. One that outlives only the program is not
// waited for; a power cut takes it back, unless a later one that outlives that has been committed.
class Transaction {
 public:
  explicit Transaction(Database& database, base::Outlives outlives = base::Outlives::kPowerCut);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void Commit();

 private:
  void SyncFully();  // again, as before it

  Database& database_;
  const base::Outlives outlives_;
  bool done_ = false;
};

}  // namespace talus::journal
