// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/file_series.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

constexpr Duration kRoomPeriod = std::chrono::seconds{1};
constexpr Duration kErrorPause = std::chrono::seconds{10};  // before a disk that failed is tried
// More than the floor, or a file would begin and end with each message that another program writes.
constexpr std::uint64_t kRoomToGoOn_bytes = std::uint64_t{64} << 20;

[[nodiscard]] std::string too_little(std::uint64_t free_bytes) {
  return "only " + std::to_string(free_bytes >> 20) + " MiB are free";
}

}  // namespace

std::uint64_t free_bytes_at(const std::filesystem::path& path) {
  struct statvfs about {};
  const std::string directory = path.has_parent_path() ? path.parent_path().string() : ".";
  return statvfs(directory.c_str(), &about) == 0
             ? static_cast<std::uint64_t>(about.f_bavail) * about.f_frsize
             : 0;
}

FileSeries::FileSeries(SeriesOptions options, RecordingNotes notes, MakeFile make_file,
                       FreeBytes free_bytes)
    : options_{std::move(options)},
      notes_{std::move(notes)},
      make_file_{std::move(make_file)},
      free_bytes_{std::move(free_bytes)} {
  for (const RawChannel& channel : raw_channels()) {
    is_said_again_.push_back(
        std::count(options_.said_again.begin(), options_.said_again.end(), channel.name) > 0);
  }
  missing_.resize(is_said_again_.size());
  said_.resize(is_said_again_.size());
}

FileSeries::~FileSeries() { close(); }

std::filesystem::path FileSeries::next_name() {
  std::error_code error;
  const auto is_there = [&](const std::filesystem::path& path) {
    return std::filesystem::exists(std::filesystem::symlink_status(path, error));
  };
  for (;;) {
    ++number_;
    std::filesystem::path name = options_.first;
    if (number_ > 1) {
      name.replace_filename(options_.first.stem().string() + "-" + std::to_string(number_) +
                            options_.first.extension().string());
    }
    if (!is_there(name) && !is_there(DiskFile::part_of(name))) {
      return name;
    }
  }
}

void FileSeries::open(Time now) {
  name_ = next_name();
  notes_.about["part"] = std::to_string(number_);
  if (options_.renew_about) {
    options_.renew_about(notes_.about);
  }
  try {
    recording_ = std::make_unique<Recording>(make_file_(name_), notes_, now);
  } catch (const StartupError& error) {
    stop(error.what(), kErrorPause, now);
    return;
  }
  state_ = SeriesState::kRecording;
  opened_ = now;
  chunk_began_ = now;
  looked_at_room_ = now;
  news_.push_back("recording to " + name_.string());
  begin_with_what_is_known(now);
}

void FileSeries::begin_with_what_is_known(Time now) {
  for (const auto& said : said_) {
    if (said) {
      recording_->add_again(said->publication, said->raw);
    }
  }
  for (auto& gap : missing_) {
    if (gap) {
      recording_->add(*gap, now);
      gap.reset();
    }
  }
}

bool FileSeries::is_open(Time now) {
  if (state_ == SeriesState::kWaiting) {
    const std::uint64_t free = free_bytes_();
    if (free < options_.free_floor_bytes) {
      stop(too_little(free), kRoomPeriod, now);
    } else {
      open(now);
    }
  }
  return state_ == SeriesState::kRecording;
}

void FileSeries::add(const Publication& publication, std::span<const std::byte> raw, Time now) {
  if (is_open(now)) {
    ++recorded_;
    recording_->add(publication, raw);
    look_for_faults(now);
  } else {
    miss({publication.channel, GapCause::kNotWritten, publication.sequence, publication.sequence});
  }
  remember(publication, raw);
}

void FileSeries::add(const Gap& gap, Time now) {
  if (is_open(now)) {
    lost_ += gap.last - gap.first + 1;
    recording_->add(gap, now);
    look_for_faults(now);
  } else {
    miss(gap);
  }
}

void FileSeries::miss(const Gap& gap) {
  lost_ += gap.last - gap.first + 1;
  auto& missing = missing_[gap.channel];
  if (missing) {
    missing->first = std::min(missing->first, gap.first);
    missing->last = std::max(missing->last, gap.last);
  } else {
    missing = gap;
  }
}

void FileSeries::remember(const Publication& publication, std::span<const std::byte> raw) {
  if (is_said_again_[publication.channel]) {
    said_[publication.channel] = Said{publication, {raw.begin(), raw.end()}};
  }
}

void FileSeries::fail(const std::string& what) {
  news_.push_back(what);
  failure_ = failure_.empty() ? what : failure_;
}

void FileSeries::stop(const std::string& why, Duration pause, Time now) {
  fail("recording stops: " + why);
  close();
  state_ = SeriesState::kNoRoom;
  try_again_ = now + pause;
}

void FileSeries::look_for_faults(Time now) {
  if (state_ != SeriesState::kRecording || recording_->fault() == 0) {
    return;
  }
  stop(name_.string() + ": " + std::generic_category().message(recording_->fault()), kErrorPause,
       now);
}

void FileSeries::miss_what_was_lost() {
  for (const Gap& gap : recording_->lost()) {
    miss(gap);
    recorded_ -= std::min(recorded_, gap.last - gap.first + 1);
  }
  for (const Gap& gap : recording_->untold_gaps()) {
    lost_ -= gap.last - gap.first + 1;  // they are counted already
    miss(gap);
  }
}

void FileSeries::close() {
  if (state_ != SeriesState::kRecording) {
    return;
  }
  state_ = SeriesState::kWaiting;
  const bool was_told = recording_->fault() != 0;
  const int failed = recording_->finish();
  const int fault = recording_->fault();
  if (fault != 0) {
    miss_what_was_lost();
  }
  if (failed != 0) {
    fail(name_.string() + " could not be closed: " + std::generic_category().message(failed));
  } else {
    if (fault != 0 && !was_told) {
      fail(name_.string() + " lacks its end: " + std::generic_category().message(fault));
    }
    closed_.push_back(name_);
    news_.push_back("closed " + name_.string());
  }
  recording_.reset();
}

void FileSeries::begin_anew() {
  close();
  said_.assign(said_.size(), std::nullopt);
  std::uint64_t untold = 0;
  for (auto& gap : missing_) {
    untold += gap ? gap->last - gap->first + 1 : 0;
    gap.reset();
  }
  if (untold > 0) {
    fail(std::to_string(untold) + " publications of the blackboard before are told in no file");
  }
}

void FileSeries::tick(Time now) {
  switch (state_) {
    case SeriesState::kWaiting: break;
    case SeriesState::kRecording: tend(now); break;
    case SeriesState::kNoRoom:
      if (now >= try_again_) {
        try_again_ = now + kRoomPeriod;
        if (free_bytes_() >= options_.free_floor_bytes + kRoomToGoOn_bytes) {
          state_ = SeriesState::kWaiting;
        }
      }
      break;
  }
}

void FileSeries::tend(Time now) {
  if (options_.chunk_span > Duration{} && now - chunk_began_ >= options_.chunk_span) {
    chunk_began_ = now;
    recording_->close_chunk();
    recording_->sync();
    look_for_faults(now);
  }
  if (state_ == SeriesState::kRecording && now - looked_at_room_ >= kRoomPeriod) {
    looked_at_room_ = now;
    if (const std::uint64_t free = free_bytes_(); free < options_.free_floor_bytes) {
      stop(too_little(free), kRoomPeriod, now);
    }
  }
  const bool is_large =
      options_.rotate_bytes > 0 && recording_ && recording_->size_bytes() >= options_.rotate_bytes;
  if (is_large || (options_.rotate_after > Duration{} && now - opened_ >= options_.rotate_after)) {
    close();
  }
}

std::vector<std::string> FileSeries::news() { return std::exchange(news_, {}); }

}  // namespace lodesman
