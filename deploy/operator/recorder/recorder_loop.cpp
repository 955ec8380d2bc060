// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/recorder/recorder_loop.h"

#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/runtime/realtime_rights.h"

namespace lodesman::cli {

RecorderLoop::RecorderLoop(BoardTap& tap, Board which, FileSeries& series, std::size_t queue_bytes,
                           std::function<void(const std::string&)> say)
    : tap_{tap}, which_{which}, series_{series}, say_{std::move(say)}, queue_{queue_bytes} {
  polling_ = std::jthread{[this](const std::stop_token& stop) { poll(stop); }};
  writing_ = std::jthread{[this](const std::stop_token& stop) { write(stop); }};
}

RecorderLoop::~RecorderLoop() {
  // In this order: what the last look takes is still written.
  polling_.request_stop();
  polling_.join();
  writing_.request_stop();
  writing_.join();
  // What found no room for its gap has it now, as the queue is empty; both threads have ended.
  queue_.tell_gaps();
  write_what_came();
}

void RecorderLoop::poll(const std::stop_token& stop) noexcept {
  static_cast<void>(hold_fifo_priority(kPollPriority));
  bool last = false;
  while (!last) {
    last = stop.stop_requested();
    tap_.poll(queue_);
    queue_.tell_gaps();
    if (!last) {
      std::this_thread::sleep_for(kPollPeriod);
    }
  }
}

void RecorderLoop::write(const std::stop_token& stop) {
  if (which_ == Board::kAnother) {
    series_.begin_anew();  // takes as long as the disk, while the other thread looks already
  }
  bool last = false;
  while (!last) {
    last = stop.stop_requested();
    write_what_came();
    series_.tick(SteadyClock{}.now());
    for (const std::string& line : series_.news()) {
      say_(line);
    }
    if (!last) {
      std::this_thread::sleep_for(kWritePeriod);
    }
  }
}

void RecorderLoop::write_what_came() {
  const SteadyClock clock;
  while (const auto entry = queue_.front()) {
    const Time now = clock.now();
    if (entry->gap) {
      series_.add(*entry->gap, now);
    } else {
      series_.add(entry->publication, entry->raw, now);
    }
    queue_.pop();
    // A disk that is slower than the boat for a while is to be synced all the same.
    series_.tick(now);
  }
}

}  // namespace lodesman::cli
