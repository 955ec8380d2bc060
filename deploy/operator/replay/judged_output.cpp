// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/judged_output.h"

#include <type_traits>
#include <utility>

#include "mid_level/recording/raw_codec.h"

namespace lodesman::cli {
namespace {

template <class T>
class OutputOf final : public JudgedOutput {
 public:
  OutputOf(std::uint64_t place, std::string name, Reader<T> reader, std::uint64_t after)
      : place_{place}, name_{std::move(name)}, reader_{std::move(reader)}, taken_{after} {
    // What stood there before the task is not of its steps.
    while (reader_.next() != nullptr) {
    }
  }

  [[nodiscard]] std::uint64_t channel() const noexcept override { return place_; }

  void judge(Time stepped, const ChannelLog& log, bool ends, StepOutput& output) override {
    pass_over_before(stepped, log, output);
    const Stamped<T>* replayed = reader_.next();
    const Recorded* recorded = taken_at(stepped, log, output);
    while (replayed != nullptr || recorded != nullptr) {
      if (recorded == nullptr && misses_next_number(log)) {
        ++output.missing;
        ++taken_;
      } else if (recorded == nullptr && ends && log.after(taken_) == nullptr) {
        ++output.missing;
      } else {
        compare(recorded, replayed, stepped, output);
      }
      replayed = replayed != nullptr ? reader_.next() : nullptr;
      recorded = recorded != nullptr ? taken_at(stepped, log, output) : nullptr;
    }
  }

  [[nodiscard]] std::uint64_t left(const ChannelLog& log) const noexcept override {
    return taken_ != 0 && log.newest() > taken_ ? log.newest() - taken_ : 0;
  }

 private:
  void pass_over_before(Time stepped, const ChannelLog& log, StepOutput& output) {
    for (const Recorded* next = log.after(taken_); next != nullptr && next->stamp < stepped;
         next = log.after(taken_)) {
      note_missing_before(*next, output);
      ++output.outside;
      taken_ = next->sequence;
    }
  }

  [[nodiscard]] const Recorded* taken_at(Time stepped, const ChannelLog& log, StepOutput& output) {
    const Recorded* next = log.after(taken_);
    if (next == nullptr || next->stamp != stepped) {
      return nullptr;
    }
    note_missing_before(*next, output);
    taken_ = next->sequence;
    ++output.recorded;
    return next;
  }

  // Numbers between are in no file.
  void note_missing_before(const Recorded& next, StepOutput& output) const noexcept {
    output.missing += taken_ == 0 ? 0 : next.sequence - taken_ - 1;
  }

  // What is not recorded here may have been published nevertheless: its number is in no file.
  [[nodiscard]] bool misses_next_number(const ChannelLog& log) const noexcept {
    const Recorded* next = log.after(taken_);
    return next != nullptr && next->sequence > taken_ + 1;
  }

  void compare(const Recorded* recorded, const Stamped<T>* replayed, Time stepped,
               StepOutput& output) {
    Difference difference{TaskId::kWorld, name_, recorded != nullptr ? recorded->sequence : 0,
                          stepped};
    if (recorded == nullptr || replayed == nullptr) {
      difference.kind =
          recorded == nullptr ? DifferenceKind::kPublished : DifferenceKind::kNotPublished;
      output.differences.push_back(difference);
    } else if (!decode_raw(recorded->raw, *value_)) {
      --output.recorded;
      ++output.outside;
    } else if (auto field = first_difference(*value_, replayed->value)) {
      difference.field = std::move(*field);
      output.differences.push_back(difference);
    }
  }

  std::uint64_t place_;
  std::string name_;
  Reader<T> reader_;
  std::uint64_t taken_;  // the last recorded number that was looked at
  std::unique_ptr<T> value_ = std::make_unique<T>();
};

}  // namespace

std::unique_ptr<JudgedOutput> JudgedOutput::of(const Blackboard& board, std::uint64_t channel,
                                               std::uint64_t after) {
  std::unique_ptr<JudgedOutput> output;
  std::uint64_t place = 0;
  for_each_channel(board, [&](const ChannelInfo& info, const auto& each) {
    using T = typename std::remove_cvref_t<decltype(each)>::Value;
    if (place++ == channel) {
      output = std::make_unique<OutputOf<T>>(channel, info.name, Reader<T>{each}, after);
    }
  });
  return output;
}

}  // namespace lodesman::cli
