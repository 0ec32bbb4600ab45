#include "recordings/sqlite_database.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <cctype>
#include <system_error>
#include <utility>

namespace handway::device {
namespace {

/// A path as a URI that never creates files beside it.
std::string uri_of(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '_' || c == '-') {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", byte);
    }
  }
  std::error_code error;
  const bool is_open_elsewhere = std::filesystem::exists(file.string() + "-wal", error);
  return uri + (is_open_elsewhere ? "?mode=ro" : "?immutable=1");
}

/// Ends queries of databases that are made to take forever.
int count_steps(void* steps) {
  constexpr std::int64_t kMostCalls = 2'000'000;  // of a thousand instructions
  return ++*static_cast<std::int64_t*>(steps) > kMostCalls ? 1 : 0;
}

}  // namespace

SqliteDatabase::SqliteDatabase(std::filesystem::path file)
    : file_(std::move(file)), opened_(nullptr, sqlite3_close_v2) {
  constexpr int kLargestValue = 64 << 20;  // bytes
  sqlite3* opened = nullptr;
  const int result = sqlite3_open_v2(uri_of(file_).c_str(), &opened,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  opened_.reset(opened);
  if (result != SQLITE_OK) {
    fail();
  }
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kLargestValue);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
}

void SqliteDatabase::fail() const {
  throw geometric::InputError(
      {file_.string(), "", opened_ ? sqlite3_errmsg(opened_.get()) : "a file that can't be opened",
       "a database of SQLite", "Copy the file again."});
}

bool SqliteDatabase::has_table(const std::string& name) const {
  Rows rows(*this, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?1");
  rows.bind(1, name);
  return rows.next();
}

SqliteDatabase::Rows::Rows(const SqliteDatabase& database, const std::string& query)
    : database_(database), statement_(nullptr, sqlite3_finalize) {
  sqlite3_stmt* statement = nullptr;
  const int result =
      sqlite3_prepare_v2(database.opened_.get(), query.c_str(), -1, &statement, nullptr);
  statement_.reset(statement);
  if (result != SQLITE_OK) {
    database.fail();
  }
}

void SqliteDatabase::Rows::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter, value);
}

void SqliteDatabase::Rows::bind(int parameter, const std::string& value) {
  sqlite3_bind_text(statement_.get(), parameter, value.data(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
}

bool SqliteDatabase::Rows::next() {
  constexpr int kInstructions = 1000;
  std::int64_t steps = 0;
  sqlite3_progress_handler(database_.opened_.get(), kInstructions, count_steps, &steps);
  const int result = sqlite3_step(statement_.get());
  sqlite3_progress_handler(database_.opened_.get(), 0, nullptr, nullptr);
  if (result != SQLITE_ROW && result != SQLITE_DONE) {
    database_.fail();
  }
  return result == SQLITE_ROW;
}

std::int64_t SqliteDatabase::Rows::whole(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string_view SqliteDatabase::Rows::bytes(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr
             ? std::string_view()
             : std::string_view(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace handway::device
