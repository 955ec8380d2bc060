// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/machine.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "deploy/boat/configuration.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/operator/watch/find_segment.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/runtime/task_table.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kCapIpcLock = 14;  // <linux/capability.h>

[[nodiscard]] int highest_priority() noexcept {
  int highest = 0;
  for (const TaskSpec& spec : kTaskTable) {
    highest = std::max(highest, spec.fifo_priority);
  }
  return highest;
}

// Tried in a thread of its own, which takes what it was given with it.
[[nodiscard]] bool fifo_is_allowed(int priority) {
  bool allowed = false;
  std::thread trial{[&] {
    sched_param param{};
    param.sched_priority = priority;
    allowed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
  }};
  trial.join();
  return allowed;
}

[[nodiscard]] std::string status_word(const std::string& key) {
  std::ifstream status{"/proc/self/status"};
  std::string line;
  while (std::getline(status, line)) {
    std::istringstream words{line};
    std::string name;
    std::string value;
    if (words >> name >> value && name == key + ":") {
      return value;
    }
  }
  return {};
}

void measure_lock(MachineFacts& facts) {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  facts.lock_limit_bytes = limit.rlim_cur;
  const std::uint64_t rights = std::strtoull(status_word("CapEff").c_str(), nullptr, 16);
  facts.lock_unlimited = limit.rlim_cur == RLIM_INFINITY || (rights >> kCapIpcLock & 1U) != 0;
  // mlockall(MCL_FUTURE) counts all that is mapped: this process is as large as the others before
  // they begin, and to that come the segment and a stack for each task.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  std::size_t stack_bytes = 0;
  pthread_attr_getstacksize(&attributes, &stack_bytes);
  pthread_attr_destroy(&attributes);
  const std::uint64_t mapped_kib = std::strtoull(status_word("VmSize").c_str(), nullptr, 10);
  facts.lock_needed_bytes = mapped_kib * 1024 + facts.segment_bytes + kTaskCount * stack_bytes;
}

void measure_shm(MachineFacts& facts) {
  facts.dead_segments = dead_segments_in("/dev/shm");
  struct statvfs space {};
  if (statvfs("/dev/shm", &space) == 0) {
    facts.shm_free_bytes = std::uint64_t{space.f_bavail} * space.f_frsize;
  }
  // Not lodesman-*: nobody should take it for a segment.
  const std::string name = "/doctor-of-lodesman-" + std::to_string(getpid());
  if (const int file = shm_open(name.c_str(), O_CREAT | O_EXCL | O_RDWR, 0600); file >= 0) {
    facts.shm_writable = true;
    close(file);
    shm_unlink(name.c_str());
  }
}

[[nodiscard]] bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody writes it
  std::istringstream folders{path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin"};
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (access((fs::path{folder} / program).c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

void measure_configuration(const CommonOptions& common, MachineFacts& facts) {
  try {
    const fs::path share = share_directory();
    // A directory that is named and holds no configuration is none.
    std::error_code ignored;
    if (fs::exists(share / "deploy" / "config" / "default.toml", ignored)) {
      facts.configuration = share.string();
    }
    const BoatConfig config = load_configuration("default", common);
    (void)load_configuration("paper", common);
    (void)load_hull(config.simulation.hull);
    for (const auto& entry : fs::directory_iterator{share / "hal_sim" / "scenarios"}) {
      if (entry.path().extension() == ".toml") {
        (void)load_scenario(entry.path(), config.speeds);
      }
    }
  } catch (const std::exception& error) {
    facts.configuration_error = error.what();
  }
}

[[nodiscard]] std::string first_line(const char* file) {
  std::ifstream stream{file};
  std::string line;
  std::getline(stream, line);
  return line;
}

void measure_kernel(MachineFacts& facts) {
  utsname name{};
  uname(&name);
  facts.preempt_rt = first_line("/sys/kernel/realtime") == "1" ||
                     std::string{name.version}.find("PREEMPT_RT") != std::string::npos;
  facts.governor = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
}

}  // namespace

MachineFacts measure_machine(const CommonOptions& common) {
  MachineFacts facts;
  facts.root = geteuid() == 0;
  facts.fifo_priority = highest_priority();
  facts.fifo_allowed = fifo_is_allowed(facts.fifo_priority);
  facts.segment_bytes = sizeof(SegmentHeader) + sizeof(Blackboard);
  measure_lock(facts);
  measure_shm(facts);
  facts.gnuplot = is_in_path("gnuplot");
  if (!is_in_path("stress-ng")) {
    facts.rt_test_missing.emplace_back("stress-ng");
  }
  if (!is_in_path("cyclictest")) {
    facts.rt_test_missing.emplace_back("rt-tests");
  }
  measure_configuration(common, facts);
  std::error_code error;
  facts.program_directory = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* program : {"lodesman-low", "lodesman-high"}) {
    if (access((facts.program_directory / program).c_str(), X_OK) != 0) {
      facts.programs_missing.emplace_back(program);
    }
  }
  measure_kernel(facts);
  return facts;
}

}  // namespace lodesman::cli
