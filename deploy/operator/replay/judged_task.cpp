// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/judged_task.h"

#include <algorithm>
#include <utility>

#include "mid_level/blackboard/channel_places.h"
#include "mid_level/recording/raw_codec.h"

namespace lodesman::cli {

JudgedTask::JudgedTask(std::size_t place, const ReplayOptions& options,
                       const TunablesChange& change, const PublicationLog& log)
    : options_{options}, change_{change}, log_{log}, board_{std::make_unique<FedBoard>(change)} {
  verdict_.task = kStepInputsInfo[place].task;
  inputs_channel_ = place_named(**board_, kStepInputsInfo[place].channel);
  pings_channel_ = place_named(**board_, "sonar_ping");
  for (const char* name : decisions_of(verdict_.task)) {
    decisions_.push_back(place_named(**board_, name));
  }
  task_ = make_task(verdict_.task, **board_, options_, sonar_);
  for (const ChannelLook<>* input : task_->inputs()) {
    input_places_.push_back(lodesman::place_of(**board_, *input));
  }
  task_.reset();
}

void JudgedTask::advance(Time until, const std::vector<std::uint64_t>& places) {
  const ChannelLog& steps = log_[inputs_channel_];
  for (const Recorded* next = steps.after(taken_); next != nullptr && next->stamp <= until;
       next = steps.after(taken_)) {
    if (next->sequence != taken_ + 1 && taken_ != 0) {
      doubt(Doubt::kGap);
    }
    taken_ = next->sequence;
    StepInputs inputs;
    if (decode_raw(next->raw, inputs)) {
      step(*next, inputs, places, until == Time::max());
    } else {
      doubt(Doubt::kGap);
    }
  }
}

void JudgedTask::step(const Recorded& recorded, const StepInputs& inputs,
                      const std::vector<std::uint64_t>& places, bool ends) {
  // A number that begins anew is another program's, even if its beginning is not recorded.
  if (inputs.step == 0 || !task_ || inputs.step <= step_) {
    make(recorded.stamp, inputs, places);
  }
  step_ = inputs.step;
  if (inputs.step == 0) {
    return;
  }
  feed(inputs, places);
  if (!inputs.whole) {
    doubt(Doubt::kTorn);
  }
  if (verdict_.task == TaskId::kDeltaT && !sonar_.prepare(recorded.stamp, log_[pings_channel_])) {
    doubt(Doubt::kGap);
  }
  const auto readers = task_->inputs();
  for (std::size_t i = 0; i < std::min<std::size_t>(readers.size(), inputs.count); ++i) {
    readers[i]->look_up_to(std::min(inputs.inputs[i].sequence, kLastSequence));
  }
  task_->step(recorded.stamp);
  ++verdict_.steps;
  first_step_ = first_step_.value_or(recorded.stamp);
  last_step_ = recorded.stamp;
  judge(recorded.stamp, ends);
}

// As it was made on the boat: on what its channels held then, its own of before too.
void JudgedTask::make(Time at, const StepInputs& inputs, const std::vector<std::uint64_t>& places) {
  task_.reset();
  outputs_.clear();
  board_ = std::make_unique<FedBoard>(change_);
  doubted_.reset();
  if (inputs.step != 0) {
    doubt(Doubt::kBeginning);
  }
  // A first step at the same instant would be its own.
  const Time before = inputs.step == 0 ? at : at - Duration{1};
  std::vector<std::uint64_t> last;
  for (const std::uint64_t channel : decisions_) {
    last.push_back(log_[channel].newest_by(before));
    if (!board_->feed_up_to(channel, last.back(), log_[channel])) {
      doubt(Doubt::kGap);
    }
    board_->release(channel);
  }
  feed(inputs, places);
  sonar_.begin_after(log_[pings_channel_].newest_by(before));
  task_ = make_task(verdict_.task, **board_, options_, sonar_);
  for (std::size_t i = 0; i < decisions_.size(); ++i) {
    if (!log_[decisions_[i]].is_left_out()) {
      outputs_.push_back(JudgedOutput::of(**board_, decisions_[i], last[i]));
    }
  }
}

std::optional<std::uint64_t> JudgedTask::place_of(const StepInputs& inputs, std::size_t i,
                                                  const std::vector<std::uint64_t>& places) const {
  const std::uint64_t channel = inputs.inputs[i].channel;
  const bool is_known =
      i < input_places_.size() && channel < places.size() && places[channel] == input_places_[i];
  return is_known ? std::optional{places[channel]} : std::nullopt;
}

void JudgedTask::feed(const StepInputs& inputs, const std::vector<std::uint64_t>& places) {
  if (inputs.count != input_places_.size()) {
    doubt(Doubt::kForeign);
  }
  for (std::size_t i = 0; i < inputs.count; ++i) {
    if (const auto place = place_of(inputs, i, places); !place) {
      doubt(Doubt::kForeign);
    } else if (!board_->feed_up_to(*place, inputs.inputs[i].sequence, log_[*place])) {
      doubt(Doubt::kGap);
    }
  }
}

void JudgedTask::judge(Time stepped, bool ends) {
  StepOutput output;
  for (const auto& each : outputs_) {
    each->judge(stepped, log_[each->channel()], ends, output);
  }
  verdict_.not_judged[static_cast<std::size_t>(Doubt::kNoStep)] += output.outside;
  verdict_.not_judged[static_cast<std::size_t>(Doubt::kLost)] += output.missing;
  if (ends && may_lack_its_ping(output)) {
    doubt(Doubt::kGap);
  }
  std::uint64_t decisions = output.recorded;
  for (const Difference& difference : output.differences) {
    decisions += difference.kind == DifferenceKind::kPublished ? 1U : 0U;
  }
  if (doubted_) {
    judge_in_doubt(stepped, decisions, output.differences.empty());
    return;
  }
  verdict_.judged += decisions;
  verdict_.judged_from = verdict_.judged_from.value_or(stepped);
  verdict_.differing += output.differences.size();
  for (Difference& difference : output.differences) {
    if (verdict_.differences.size() < TaskVerdict::kMostTold) {
      difference.task = verdict_.task;
      verdict_.differences.push_back(std::move(difference));
    }
  }
}

// A recorder that ends looks at one channel after the other: it may have what the task made of a
// ping and not the ping.
bool JudgedTask::may_lack_its_ping(const StepOutput& output) const noexcept {
  return verdict_.task == TaskId::kDeltaT && !sonar_.has_more(log_[pings_channel_]) &&
         std::any_of(output.differences.begin(), output.differences.end(),
                     [](const Difference& difference) {
                       return difference.kind == DifferenceKind::kNotPublished;
                     });
}

void JudgedTask::judge_in_doubt(Time stepped, std::uint64_t decisions, bool agrees) {
  verdict_.not_judged[static_cast<std::size_t>(*doubted_)] += decisions;
  if (!agrees) {
    agrees_since_.reset();
    return;
  }
  if (!agrees_since_) {
    agrees_since_ = stepped;
    agreed_ = 0;
  }
  agreed_ += decisions;
  if (stepped - *agrees_since_ >= kAgreedFor && agreed_ >= kAgreedOften) {
    doubted_.reset();
  }
}

void JudgedTask::doubt(Doubt why) noexcept {
  doubted_ = doubted_.value_or(why);
  agrees_since_.reset();
}

void JudgedTask::finish() {
  if (!task_) {
    for (const std::uint64_t channel : decisions_) {
      verdict_.not_judged[static_cast<std::size_t>(Doubt::kNoStep)] += log_[channel].count();
    }
  }
  for (const auto& each : outputs_) {
    verdict_.not_judged[static_cast<std::size_t>(Doubt::kNoStep)] +=
        each->left(log_[each->channel()]);
  }
}

}  // namespace lodesman::cli
