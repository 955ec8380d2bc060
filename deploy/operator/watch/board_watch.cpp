// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/watch/board_watch.h"

#include <memory>
#include <type_traits>

#include "mid_level/runtime/health_watch.h"

namespace lodesman::cli {

BoardWatch::BoardWatch(const Blackboard& board) : chain_{board} {
  for_each_channel(board, [&]<class C>(const ChannelInfo& info, const C& channel) {
    using Value = typename C::Value;
    if constexpr (std::is_same_v<Value, TaskHealth>) {
      tasks_.push_back({info, Reader<TaskHealth>{channel}, std::nullopt});
    } else if constexpr (std::is_same_v<Value, DeviceHealth>) {
      device_readers_.emplace_back(channel);
      devices_.emplace_back();
    } else if constexpr (!std::is_same_v<Value, StepInputs>) {  // those are for recordings
      // Shared only because a std::function must be copyable.
      const auto reader = std::make_shared<Reader<Value>>(channel);
      (void)reader->latest();
      channels_.push_back({info,
                           [reader](ChannelSeen& seen) {
                             while (reader->next() != nullptr) {
                             }
                             if (const auto* newest = reader->latest(); newest != nullptr) {
                               seen.sequence = newest->sequence;
                               seen.stamp = newest->stamp;
                             }
                             seen.missed = reader->missed();
                             seen.refused = reader->refused();
                           },
                           0,
                           {},
                           0,
                           0,
                           {}});
    }
  });
}

void BoardWatch::poll(Time now) {
  now_ = now;
  chain_.poll();
  for (ChannelSeen& seen : channels_) {
    seen.drain(seen);
    seen.looks.push_back({now, seen.sequence});
    while (now - seen.looks.front().at > kRateWindow) {
      seen.looks.pop_front();
    }
  }
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    if (const auto* newest = device_readers_[i].latest(); newest != nullptr) {
      devices_[i] = *newest;
    }
  }
  for (TaskSeen& seen : tasks_) {
    if (const auto* newest = seen.reader.latest(); newest != nullptr) {
      seen.newest = *newest;
    }
  }
}

BoardState BoardWatch::state() const {
  BoardState state;
  for (const ChannelSeen& seen : channels_) {
    state.channels.push_back(row_of(seen));
  }
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    state.devices.push_back(row_of(devices_[i], i));
  }
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    state.tasks.push_back(row_of(tasks_[i], i));
  }
  state.chain = chain_.newest();
  return state;
}

ChannelRow BoardWatch::row_of(const ChannelSeen& seen) const {
  ChannelRow row;
  row.name = seen.info.name;
  row.writer = seen.info.writer;
  row.writer_task = seen.info.writer_task;
  row.max_age_s = to_seconds(seen.info.max_age);
  row.publications = seen.sequence;
  row.missed = seen.missed;
  row.refused = seen.refused;
  if (seen.looks.size() > 1 && seen.looks.back().at > seen.looks.front().at) {
    const auto& [from, first] = seen.looks.front();
    const auto& [to, last] = seen.looks.back();
    row.rate_hz = static_cast<double>(last - first) / to_seconds(to - from);
  }
  if (seen.sequence > 0) {
    row.age_s = to_seconds(now_ - seen.stamp);
  }
  const bool limited = seen.info.max_age > Duration::zero();
  row.stale = limited && (seen.sequence == 0 || now_ - seen.stamp > seen.info.max_age);
  return row;
}

DeviceRow BoardWatch::row_of(const std::optional<Stamped<DeviceHealth>>& newest,
                             std::size_t device) const {
  DeviceRow row;
  row.device = static_cast<DeviceId>(device);
  row.wrong = !newest || now_ - newest->stamp > max_age::kDeviceHealth;
  if (newest) {
    const DeviceStatus status = newest->value.status;
    row.health = newest->value;
    row.for_s = to_seconds(now_ - newest->value.since);
    row.wrong |= status != DeviceStatus::kWorking && status != DeviceStatus::kAbsent;
  }
  return row;
}

TaskRow BoardWatch::row_of(const TaskSeen& seen, std::size_t task) const {
  TaskRow row;
  row.name = seen.info.name;
  row.process = seen.info.writer;
  row.period_s = to_seconds(kTaskTable[task].period);
  if (seen.newest) {
    row.health = seen.newest->value;
    row.age_s = to_seconds(now_ - seen.newest->stamp);
    row.silent = now_ - seen.newest->stamp > silence_limit(kTaskTable[task].period);
  }
  return row;
}

}  // namespace lodesman::cli
