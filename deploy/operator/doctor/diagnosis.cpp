// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lodesman::cli {
namespace {

[[nodiscard]] std::string mib(std::uint64_t bytes) {
  return fmt::format("{:.0f} MiB", static_cast<double>(bytes) / (1U << 20U));
}

// One line of limits.conf for this user. Root has every right but what its container was denied.
[[nodiscard]] std::string limit_remedy(const MachineFacts& facts, const std::string& item,
                                       const std::string& value, const std::string& capability) {
  if (facts.root) {
    return fmt::format("start the container with --cap-add {}", capability);
  }
  return fmt::format(
      "echo \"$USER - {} {}\" | sudo tee -a /etc/security/limits.d/lodesman.conf; log in again",
      item, value);
}

[[nodiscard]] Finding judge_fifo(const MachineFacts& facts) {
  if (facts.fifo_allowed) {
    return {"sched_fifo", Verdict::kOk,
            fmt::format("real-time priority {} is allowed", facts.fifo_priority), ""};
  }
  return {"sched_fifo", Verdict::kWarn,
          fmt::format("real-time priority {} is not allowed: a busy machine misses deadlines",
                      facts.fifo_priority),
          limit_remedy(facts, "rtprio", std::to_string(facts.fifo_priority), "SYS_NICE")};
}

[[nodiscard]] Finding judge_lock(const MachineFacts& facts) {
  const std::string needed = mib(facts.lock_needed_bytes);
  if (facts.lock_unlimited) {
    return {"memory_lock", Verdict::kOk, "memory may be locked without limit", ""};
  }
  const std::string limit = mib(facts.lock_limit_bytes);
  if (facts.lock_limit_bytes >= facts.lock_needed_bytes) {
    return {"memory_lock", Verdict::kOk,
            fmt::format("{} may be locked, about {} are needed", limit, needed), ""};
  }
  return {"memory_lock", Verdict::kWarn,
          fmt::format("{} may be locked, about {} are needed: a page fault may delay a step", limit,
                      needed),
          limit_remedy(facts, "memlock", "unlimited", "IPC_LOCK")};
}

[[nodiscard]] Finding judge_shm(const MachineFacts& facts) {
  if (!facts.shm_writable) {
    return {"shared_memory", Verdict::kBad, "no segment can be made in /dev/shm",
            "sudo mount -t tmpfs -o mode=1777 tmpfs /dev/shm"};
  }
  const std::string space = fmt::format("/dev/shm has {} free, a segment takes {}",
                                        mib(facts.shm_free_bytes), mib(facts.segment_bytes));
  if (facts.shm_free_bytes < facts.segment_bytes) {
    return {"shared_memory", Verdict::kBad, space,
            "sudo mount -o remount,size=256M /dev/shm, or docker run --shm-size 256m"};
  }
  return {"shared_memory", Verdict::kOk, space, ""};
}

[[nodiscard]] Finding judge_leftovers(const MachineFacts& facts) {
  if (facts.dead_segments.empty()) {
    return {"leftovers", Verdict::kOk, "no segment of a killed boat lies in /dev/shm", ""};
  }
  return {"leftovers", Verdict::kWarn,
          fmt::format("killed boats have left {} segments of {} in /dev/shm",
                      facts.dead_segments.size(), mib(facts.segment_bytes)),
          fmt::format("rm /dev/shm/{}", fmt::join(facts.dead_segments, " /dev/shm/"))};
}

[[nodiscard]] Finding judge_gnuplot(const MachineFacts& facts) {
  if (facts.gnuplot) {
    return {"gnuplot", Verdict::kOk, "is installed", ""};
  }
  return {"gnuplot", Verdict::kWarn, "is missing: runs need --no-images",
          "sudo apt-get install gnuplot-nox"};
}

[[nodiscard]] Finding judge_rt_test(const MachineFacts& facts) {
  if (facts.rt_test_missing.empty()) {
    return {"rt_test", Verdict::kInfo, "stress-ng and cyclictest are there for lodesman rt-test",
            ""};
  }
  const std::string missing = fmt::format("{}", fmt::join(facts.rt_test_missing, " "));
  return {"rt_test", Verdict::kInfo, "lodesman rt-test could do more with " + missing,
          "sudo apt-get install " + missing};
}

[[nodiscard]] Finding judge_configuration(const MachineFacts& facts) {
  if (facts.configuration_error.empty()) {
    return {"configuration", Verdict::kOk,
            "profiles, vessel and scenarios are valid: " + facts.configuration, ""};
  }
  return {"configuration", Verdict::kBad, facts.configuration_error,
          facts.configuration.empty()
              ? "export LODESMAN_SHARE=DIR, the one that holds deploy/config"
              : "mend that line, or: git checkout -- deploy/config hal_sim/scenarios"};
}

[[nodiscard]] Finding judge_programs(const MachineFacts& facts) {
  if (facts.programs_missing.empty()) {
    return {"programs", Verdict::kOk,
            "lodesman-low and lodesman-high are in " + facts.program_directory.string(), ""};
  }
  const std::string missing = fmt::format("{}", fmt::join(facts.programs_missing, " "));
  return {"programs", Verdict::kBad,
          missing + " not in " + facts.program_directory.string() + ": no run can start",
          fmt::format("cmake --build {} --target {}",
                      facts.program_directory.parent_path().string(), missing)};
}

[[nodiscard]] Finding judge_governor(const MachineFacts& facts) {
  if (facts.governor.empty()) {
    return {"governor", Verdict::kInfo, "the machine does not tell its frequency governor", ""};
  }
  const bool steady = facts.governor == "performance";
  return {"governor", Verdict::kInfo, facts.governor,
          steady ? "" : "for steadier times: sudo cpupower frequency-set -g performance"};
}

}  // namespace

const char* to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kOk: return "ok";
    case Verdict::kInfo: return "info";
    case Verdict::kWarn: return "warn";
    case Verdict::kBad: break;
  }
  return "bad";
}

nlohmann::ordered_json Finding::to_json() const {
  using Json = nlohmann::ordered_json;
  return {{"name", name},
          {"verdict", to_string(verdict)},
          {"what", what},
          {"remedy", remedy.empty() ? Json(nullptr) : Json(remedy)}};
}

std::string Finding::line() const {
  return fmt::format("{:<4}  {:<13}  {}{}{}", to_string(verdict), name, what,
                     remedy.empty() ? "" : "  ->  ", remedy);
}

std::vector<Finding> judge(const MachineFacts& facts) {
  return {judge_fifo(facts),
          judge_lock(facts),
          judge_shm(facts),
          judge_leftovers(facts),
          judge_gnuplot(facts),
          judge_rt_test(facts),
          judge_configuration(facts),
          judge_programs(facts),
          {"preempt_rt", Verdict::kInfo,
           facts.preempt_rt ? "a real-time kernel"
                            : "no real-time kernel: a step may be late by milliseconds",
           ""},
          judge_governor(facts)};
}

bool any_bad(std::span<const Finding> findings) noexcept {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.verdict == Verdict::kBad; });
}

}  // namespace lodesman::cli
