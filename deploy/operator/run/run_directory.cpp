// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/run_directory.h"

#include <fmt/chrono.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <vector>

#include "deploy/operator/report/output_file.h"
#include "mid_level/base/startup_error.h"
#include "mid_level/base/utc.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

constexpr std::array kRunFiles{"config.toml",
                               "scenario.toml",
                               "result.json",
                               "trajectory.csv",
                               "plans.jsonl",
                               "world.png",
                               "inoffensive_distance.png",
                               "heading.png",
                               "thrust.png",
                               "mission.mcap"};
constexpr const char* kViews = "sonar";
constexpr const char* kNoClock = "no-clock";

[[noreturn]] void refuse(const fs::path& directory, const std::string& reason) {
  throw StartupError("--out: " + directory.string() + ": " + reason);
}

void make_parents(const fs::path& directory) {
  std::error_code error;
  if (directory.has_parent_path()) {
    fs::create_directories(directory.parent_path(), error);
  }
  if (error) {
    refuse(directory, error.message());
  }
}

// False where something of that name is there already.
[[nodiscard]] bool make_exclusively(const fs::path& directory) {
  if (mkdir(directory.c_str(), 0777) == 0) {
    return true;
  }
  if (errno != EEXIST) {
    refuse(directory, std::generic_category().message(errno));
  }
  return false;
}

// 000000.jpg, or what a run that was killed left of one.
[[nodiscard]] bool is_view(const fs::path& file) {
  fs::path name = file.filename();
  if (name.extension() == ".part") {
    name = name.stem();
  }
  const std::string number = name.stem().string();
  return name.extension() == ".jpg" && !number.empty() &&
         std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void clear(const fs::path& directory) {
  std::vector<fs::path> old;
  for (const char* name : kRunFiles) {
    old.push_back(directory / name);
    old.push_back(unfinished(directory / name));
  }
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{directory / kViews, error}) {
    if (is_view(entry.path())) {
      old.push_back(entry.path());
    }
  }
  for (const fs::path& file : old) {
    fs::remove(file, error);
    if (error) {
      refuse(file, error.message());
    }
  }
  fs::remove(directory / kViews, error);  // unless something of somebody else's is in it
}

}  // namespace

bool holds_a_run(const fs::path& directory) {
  const auto is_there = [&](const fs::path& name) {
    std::error_code error;
    return fs::exists(fs::symlink_status(directory / name, error));
  };
  return is_there(kViews) || std::any_of(kRunFiles.begin(), kRunFiles.end(), [&](const char* name) {
           return is_there(name) || is_there(unfinished(name));
         });
}

fs::path make_new_directory(const fs::path& name) {
  make_parents(name);
  fs::path directory = name;
  for (int i = 2; !make_exclusively(directory); ++i) {
    directory = name;
    directory += "-" + std::to_string(i);
  }
  return directory;
}

std::string run_name(std::int64_t utc_ns, const std::string& scenario) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const auto utc_s = static_cast<std::time_t>(utc_ns / kSecond_ns);
  return (is_plausible_utc(utc_ns) ? fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(utc_s))
                                   : std::string{kNoClock}) +
         "-" + scenario;
}

bool has_no_clock(const fs::path& directory) {
  return directory.filename().string().starts_with(kNoClock);
}

fs::path rename_by_clock(const fs::path& directory, std::int64_t utc_ns,
                         const std::string& scenario) {
  if (!is_plausible_utc(utc_ns)) {
    return directory;
  }
  // Made first, so that the name is this run's alone: a directory may take the place of an empty
  // one.
  std::error_code error;
  fs::path known = make_new_directory(directory.parent_path() / run_name(utc_ns, scenario));
  fs::rename(directory, known, error);
  if (!error) {
    return known;
  }
  fs::remove(known, error);
  return directory;
}

fs::path make_named_directory(const fs::path& name, bool force) {
  // "run/" names the same as "run".
  fs::path directory = name.has_filename() ? name : name.parent_path();
  make_parents(directory);
  if (make_exclusively(directory)) {
    return directory;
  }
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    refuse(directory, "is no directory");
  }
  if (holds_a_run(directory)) {
    if (!force) {
      refuse(directory, "holds a run already; --force writes over it");
    }
    clear(directory);
  }
  return directory;
}

}  // namespace lodesman::cli
