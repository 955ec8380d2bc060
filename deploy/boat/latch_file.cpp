// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/latch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace lodesman {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStopped = "stopped\n";

[[nodiscard]] fs::path from_environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody writes it
  return value != nullptr && value[0] == '/' ? fs::path{value} : fs::path{};
}

[[nodiscard]] fs::path state_directory() {
  if (fs::path named = from_environment("STATE_DIRECTORY"); !named.empty()) {
    return named;
  }
  if (geteuid() == 0) {
    return "/var/lib/lodesman";
  }
  if (fs::path state = from_environment("XDG_STATE_HOME"); !state.empty()) {
    return state / "lodesman";
  }
  const fs::path home = from_environment("HOME");
  return home.empty() ? home : home / ".local/state/lodesman";
}

// Whole and on the disk when it returns true.
[[nodiscard]] bool write_through(const fs::path& file, std::string_view text) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (opened < 0) {
    return false;
  }
  const bool written =
      write(opened, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      fsync(opened) == 0;
  return close(opened) == 0 && written;
}

// A name that was given is on the disk when its directory is.
[[nodiscard]] bool sync_directory(const fs::path& directory) {
  const int opened = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) {
    return false;
  }
  const bool synced = fsync(opened) == 0;
  return close(opened) == 0 && synced;
}

}  // namespace

std::optional<fs::path> LatchFile::place_for(const std::string& segment) {
  const fs::path directory = state_directory();
  return directory.empty() ? std::nullopt : std::optional{directory / (segment + ".latch")};
}

Latch LatchFile::read() const {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file_, error))) {
    const bool absent = !error || error == std::errc::no_such_file_or_directory ||
                        error == std::errc::not_a_directory;
    return absent ? Latch::kClear : Latch::kUnreadable;
  }
  std::ifstream stream{file_, std::ios::binary};
  std::string text(kStopped.size() + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text == kStopped ? Latch::kStopped : Latch::kUnreadable;
}

std::optional<std::string> LatchFile::follow(const ThrustStatus& status) {
  const bool stopped = status.state == ThrustState::kStopped;
  if (written_ == stopped) {
    return std::nullopt;
  }
  if (stopped ? write() : remove()) {
    written_ = stopped;
    complained_ = false;
    return std::nullopt;
  }
  return std::exchange(complained_, true)
             ? std::nullopt
             : std::optional{file_.string() + ": cannot be written: the emergency stop would not " +
                             "outlive the power"};
}

bool LatchFile::remove() const {
  std::error_code error;
  const bool was_there = fs::remove(file_, error);
  return !error && (!was_there || sync_directory(file_.parent_path()));
}

bool LatchFile::write() const {
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  const fs::path beside = file_.string() + ".new";
  if (!write_through(beside, kStopped)) {
    return false;
  }
  fs::rename(beside, file_, error);
  return !error && sync_directory(file_.parent_path());
}

}  // namespace lodesman
