// SPDX-License-Identifier: Apache-2.0
// The recorder at work on one blackboard: one thread follows it, and never waits for the other,
// which compresses and writes. Made and ended by the main thread; meanwhile tap, series and `say`
// belong to these two.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "deploy/operator/recorder/publication_queue.h"
#include "mid_level/recording/file_series.h"

namespace lodesman::cli {

class RecorderLoop {
 public:
  // A ring of four pings at 25 Hz lasts 160 ms, one of four device healths at least four of its
  // task's periods of 20 ms: a look every 10 ms misses none of them, and four such looks may be
  // late in a row.
  static constexpr Duration kPollPeriod = std::chrono::milliseconds{10};
  static constexpr Duration kWritePeriod = std::chrono::milliseconds{20};
  // Below every task of the boat: it may hold up none of them. But above what is not real-time at
  // all, which on a busy machine might keep it waiting for longer than the rings last.
  static constexpr int kPollPriority = 1;

  // Whether the series goes on with the blackboard that it had before, if it had one.
  enum class Board : std::uint8_t { kTheSame, kAnother };

  RecorderLoop(BoardTap& tap, Board which, FileSeries& series, std::size_t queue_bytes,
               std::function<void(const std::string&)> say);
  RecorderLoop(const RecorderLoop&) = delete;
  RecorderLoop& operator=(const RecorderLoop&) = delete;
  ~RecorderLoop();  // looks once more, and writes all that was taken

 private:
  void poll(const std::stop_token& stop) noexcept;
  void write(const std::stop_token& stop);
  void write_what_came();

  BoardTap& tap_;
  Board which_;
  FileSeries& series_;
  std::function<void(const std::string&)> say_;
  PublicationQueue queue_;
  std::jthread polling_;
  std::jthread writing_;
};

}  // namespace lodesman::cli
