// SPDX-License-Identifier: Apache-2.0
// The files of a recording, one after another: begun with the first publication, followed by
// another one when it is large or old enough, ended where the disk is nearly full or fails, and
// gone on with in a new one when there is room again. What could not be written is a gap in the
// next file. One thread, which is handed the time; it allocates and writes.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mid_level/recording/recording.h"

namespace lodesman {

struct SeriesOptions {
  std::filesystem::path first;          // name.mcap; then name-2.mcap, name-3.mcap, ...
  std::uint64_t rotate_bytes = 0;       // a file ends once it is so large; 0: never
  Duration rotate_after{};              // or so old; 0: never
  std::uint64_t free_floor_bytes = 0;   // nothing is written where less is free
  Duration chunk_span{};                // a chunk is closed, and on the disk, after so long
  std::vector<std::string> said_again;  // channels whose last publication begins each later file
  // Brings RecordingNotes::about up to date before each file; may be empty.
  std::function<void(std::map<std::string, std::string>&)> renew_about = {};
};

enum class SeriesState : std::uint8_t {
  kWaiting,    // for a first publication: there is no file
  kRecording,  // there is one
  kNoRoom,     // there is none, and what comes is counted as gaps
};

class FileSeries {
 public:
  // Makes a file; throws StartupError where that cannot be.
  using MakeFile = std::function<std::unique_ptr<RecordFile>(const std::filesystem::path&)>;
  // Bytes that are free where the files go.
  using FreeBytes = std::function<std::uint64_t()>;

  FileSeries(SeriesOptions options, RecordingNotes notes, MakeFile make_file, FreeBytes free_bytes);
  FileSeries(const FileSeries&) = delete;
  FileSeries& operator=(const FileSeries&) = delete;
  ~FileSeries();  // closes what is open

  void add(const Publication& publication, std::span<const std::byte> raw, Time now);
  void add(const Gap& gap, Time now);
  // To be called some ten times a second, whether there is news or not.
  void tick(Time now);
  // Ends the file, if there is one; the next publication begins another.
  void close();
  // The same, for what another blackboard publishes: of this one nothing is said again, and gaps
  // that no file could take are counted in news().
  void begin_anew();

  [[nodiscard]] SeriesState state() const noexcept { return state_; }
  // The files that were closed and have their own name.
  [[nodiscard]] const std::vector<std::filesystem::path>& closed() const noexcept {
    return closed_;
  }
  [[nodiscard]] std::uint64_t recorded() const noexcept { return recorded_; }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  // Whether something could not be written, or a file not closed.
  [[nodiscard]] bool has_failed() const noexcept { return !failure_.empty(); }
  // What was the first of it, for people; empty where nothing was.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  // What has happened since the last call, a line each, for people.
  [[nodiscard]] std::vector<std::string> news();

 private:
  struct Said {
    Publication publication;
    std::vector<std::byte> raw;
  };

  [[nodiscard]] bool is_open(Time now);
  void open(Time now);
  void stop(const std::string& why, Duration pause, Time now);
  void look_for_faults(Time now);
  void tend(Time now);
  void fail(const std::string& what);
  void miss(const Gap& gap);
  void miss_what_was_lost();
  void remember(const Publication& publication, std::span<const std::byte> raw);
  void begin_with_what_is_known(Time now);
  [[nodiscard]] std::filesystem::path next_name();

  SeriesOptions options_;
  RecordingNotes notes_;
  MakeFile make_file_;
  FreeBytes free_bytes_;
  SeriesState state_ = SeriesState::kWaiting;
  std::unique_ptr<Recording> recording_;
  std::filesystem::path name_;
  std::vector<std::filesystem::path> closed_;
  unsigned number_ = 0;
  Time opened_{};
  Time chunk_began_{};
  Time looked_at_room_{};
  Time try_again_{};
  std::vector<bool> is_said_again_;          // by channel
  std::vector<std::optional<Gap>> missing_;  // by channel, to be told in the next file
  std::vector<std::optional<Said>> said_;    // by channel, those of said_again
  std::uint64_t recorded_ = 0;
  std::uint64_t lost_ = 0;
  std::string failure_;
  std::vector<std::string> news_;
};

// Bytes that this user may still write where `path` lies.
[[nodiscard]] std::uint64_t free_bytes_at(const std::filesystem::path& path);

}  // namespace lodesman
