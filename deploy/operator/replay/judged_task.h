// SPDX-License-Identifier: Apache-2.0
// One task, stepped again at each recorded step by what that step saw, and judged by what it
// published then. One thread.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "deploy/operator/replay/fed_board.h"
#include "deploy/operator/replay/judged_output.h"
#include "deploy/operator/replay/stepped_task.h"

namespace lodesman::cli {

class JudgedTask {
 public:
  // A task about which there is doubt is judged again once it has agreed for so long, and so often.
  static constexpr Duration kAgreedFor = std::chrono::seconds{10};
  static constexpr std::uint64_t kAgreedOften = 10;

  // `place`: of the task in kStepInputsInfo. Options, change and log must outlive it.
  JudgedTask(std::size_t place, const ReplayOptions& options, const TunablesChange& change,
             const PublicationLog& log);

  // What was found of it in a segment before this one.
  void go_on_from(TaskVerdict before) { verdict_ = std::move(before); }
  // `places`: by the recording's number of a channel its place in the log; the log's size where it
  // is not there.
  void advance(Time until, const std::vector<std::uint64_t>& places);
  // No more is recorded.
  void finish();

  [[nodiscard]] const TaskVerdict& verdict() const noexcept { return verdict_; }
  [[nodiscard]] std::optional<Time> first_step() const noexcept { return first_step_; }
  [[nodiscard]] Time last_step() const noexcept { return last_step_; }

 private:
  void step(const Recorded& recorded, const StepInputs& inputs,
            const std::vector<std::uint64_t>& places, bool ends);
  void make(Time at, const StepInputs& inputs, const std::vector<std::uint64_t>& places);
  // The place in the log of input `i`; empty where the recording has it otherwise than this build.
  [[nodiscard]] std::optional<std::uint64_t> place_of(
      const StepInputs& inputs, std::size_t i, const std::vector<std::uint64_t>& places) const;
  void feed(const StepInputs& inputs, const std::vector<std::uint64_t>& places);
  void judge(Time stepped, bool ends);
  [[nodiscard]] bool may_lack_its_ping(const StepOutput& output) const noexcept;
  void judge_in_doubt(Time stepped, std::uint64_t decisions, bool agrees);
  void doubt(Doubt why) noexcept;

  std::uint64_t inputs_channel_;
  std::uint64_t pings_channel_;
  std::vector<std::uint64_t> decisions_;       // by their places
  std::vector<std::uint64_t> input_places_{};  // what this build's task reads
  const ReplayOptions& options_;
  const TunablesChange& change_;
  const PublicationLog& log_;
  std::unique_ptr<FedBoard> board_;
  RecordedSonar sonar_;
  std::unique_ptr<Task> task_;
  std::vector<std::unique_ptr<JudgedOutput>> outputs_;
  std::uint64_t taken_ = 0;       // the last record of a step that was looked at
  std::uint64_t step_ = 0;        // the number of that step
  std::optional<Doubt> doubted_;  // nothing: what the task remembers is what it remembered
  std::optional<Time> agrees_since_;
  std::uint64_t agreed_ = 0;
  std::optional<Time> first_step_;
  Time last_step_{};
  TaskVerdict verdict_;
};

}  // namespace lodesman::cli
