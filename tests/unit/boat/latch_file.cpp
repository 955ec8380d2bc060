// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/latch_file.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/catch.h"

using namespace lodesman;
namespace fs = std::filesystem;

namespace {

struct Directory {
  fs::path path = fs::temp_directory_path() / ("lodesman-latch-" + std::to_string(getpid()));
  Directory() { fs::remove_all(path); }
  ~Directory() { fs::remove_all(path); }
};

ThrustStatus in_state(ThrustState state) {
  ThrustStatus status;
  status.state = state;
  return status;
}

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream{file, std::ios::binary} << text;
}

}  // namespace

TEST_CASE("latch: a stop outlives the power until it is released", "[boat]") {
  const Directory directory;
  const fs::path file = directory.path / "deep" / "boat.latch";
  CHECK(LatchFile{file}.read() == Latch::kClear);
  {
    LatchFile latch{file};
    CHECK_FALSE(latch.follow(in_state(ThrustState::kArmed)));
    CHECK_FALSE(fs::exists(file));  // a boat that was never stopped leaves nothing
    CHECK_FALSE(latch.follow(in_state(ThrustState::kStopped)));
    CHECK(latch.read() == Latch::kStopped);
  }
  LatchFile after{file};
  CHECK(after.read() == Latch::kStopped);
  CHECK_FALSE(after.follow(in_state(ThrustState::kStopped)));
  CHECK_FALSE(after.follow(in_state(ThrustState::kDisarmed)));
  CHECK(after.read() == Latch::kClear);
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("latch: what cannot be read is not taken for clear", "[boat]") {
  const Directory directory;
  const fs::path file = directory.path / "boat.latch";
  for (const char* text : {"", "stop", "clear", "stopped\nmore", "\xff"}) {
    put(file, text);
    CHECK(LatchFile{file}.read() == Latch::kUnreadable);
  }
  fs::remove(file);
  fs::create_directories(file);
  CHECK(LatchFile{file}.read() == Latch::kUnreadable);
  fs::remove(file);
  fs::create_symlink("nowhere", file);
  CHECK(LatchFile{file}.read() == Latch::kUnreadable);
}

TEST_CASE("latch: what cannot be written is said once", "[boat]") {
  const Directory directory;
  put(directory.path / "file", "");
  LatchFile latch{directory.path / "file" / "boat.latch"};
  CHECK(latch.follow(in_state(ThrustState::kStopped)));
  CHECK_FALSE(latch.follow(in_state(ThrustState::kStopped)));
}

TEST_CASE("latch: it lies where the service manager says", "[boat]") {
  setenv("STATE_DIRECTORY", "/var/lib/somewhere", 1);
  CHECK(LatchFile::place_for("pond") == fs::path{"/var/lib/somewhere/pond.latch"});
  unsetenv("STATE_DIRECTORY");
  CHECK(LatchFile::place_for("pond")->filename() == "pond.latch");
}
