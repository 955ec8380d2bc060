// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/ping_player.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "drivers/delta_t/scan.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

constexpr Duration kUsualRepetition = std::chrono::milliseconds{100};

[[nodiscard]] bool is_recording(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return ending == ".83B" || ending == ".83P";
}

[[nodiscard]] std::vector<std::filesystem::path> recordings_in(
    const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry{directory, error}, end; !error && entry != end;
       entry.increment(error)) {
    std::error_code not_told;
    if (is_recording(entry->path()) && entry->is_regular_file(not_told)) {
      files.push_back(entry->path());
    }
  }
  if (error) {
    throw StartupError("\"" + directory.string() + "\" cannot be read: " + error.message());
  }
  if (files.empty()) {
    throw StartupError("\"" + directory.string() + "\" holds no .83B and no .83P file");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

PingPlayer::PingPlayer(const std::filesystem::path& directory, delta_t::BeamSign beam_sign)
    : beam_sign_{beam_sign} {
  for (const std::filesystem::path& file : recordings_in(directory)) {
    read(file);
  }
}

void PingPlayer::read(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > kMost_bytes - bytes_.size()) {
    throw StartupError("\"" + file.string() + "\": the recordings are larger than 1 GiB together");
  }
  const std::size_t begin = bytes_.size();
  bytes_.resize(begin + (error ? 0U : static_cast<std::size_t>(size)));
  std::ifstream stream{file, std::ios::binary};
  std::vector<char> piece(1U << 20U);
  std::size_t at = begin;
  while (stream && at < bytes_.size()) {
    const std::size_t wanted = std::min(piece.size(), bytes_.size() - at);
    stream.read(piece.data(), static_cast<std::streamsize>(wanted));
    const auto count = static_cast<std::size_t>(stream.gcount());
    std::transform(piece.begin(), piece.begin() + stream.gcount(),
                   bytes_.begin() + static_cast<std::ptrdiff_t>(at),
                   [](char c) { return static_cast<std::uint8_t>(c); });
    at += count;
  }
  bytes_.resize(at);
  index(file, begin);
}

void PingPlayer::index(const std::filesystem::path& file, std::size_t begin) {
  std::size_t at = begin;
  while (at < bytes_.size()) {
    const delta_t::Found found = delta_t::look_at_front(std::span{bytes_}.subspan(at));
    if (const auto* record = std::get_if<delta_t::Record>(&found.what)) {
      add(record->header, at, found.size);
    } else if (at == begin) {
      break;
    } else {
      skipped_bytes_ += found.size;
    }
    at += found.size;
  }
  if (at == begin) {
    throw StartupError("\"" + file.string() + "\" does not begin with an 83B or 83P record");
  }
}

void PingPlayer::add(const delta_t::Header& header, std::size_t at, std::size_t size) {
  const std::optional<Duration> written = delta_t::written_at(header);
  Duration step = written && written_ ? *written - *written_ : Duration::zero();
  if (step <= Duration::zero() || step > kLongestGap) {
    const Duration repetition = from_seconds(header.repetition_s);
    step = repetition > Duration::zero() ? repetition : kUsualRepetition;
  }
  written_ = written ? written : written_;
  entries_.push_back({at, size, entries_.empty() ? Duration::zero() : entries_.back().due + step});
}

ReadStatus PingPlayer::poll(Time now, SonarPing& out) noexcept {
  if (!is_playing_) {
    is_playing_ = true;
    begun_ = now;
  }
  std::size_t due = next_;
  while (due < entries_.size() && begun_ + entries_[due].due <= now) {
    ++due;
  }
  if (due == next_) {
    return ReadStatus::kNothingNew;
  }
  const Entry& entry = entries_[due - 1];
  given_ += due - next_;
  next_ = due;
  const auto bytes = std::span{bytes_}.subspan(entry.at, entry.size);
  delta_t::fill_ping(delta_t::parse_record(bytes).record, beam_sign_, out);
  out.number = given_;
  out.captured = begun_ + entry.due;
  return ReadStatus::kFresh;
}

}  // namespace lodesman
