// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/allocation_counter.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPreload = "LD_PRELOAD";

}  // namespace

fs::path allocations_library() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {here, here.parent_path() / "lib" / "lodesman"}) {
    if (fs::path library = folder / kAllocationsLibrary; fs::exists(library, error)) {
      return library;
    }
  }
  return {};
}

AllocationCounter::AllocationCounter(const fs::path& directory) {
  const fs::path library = allocations_library();
  const fs::path file = directory / "allocations";
  const int descriptor =
      library.empty() ? -1 : open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    return;
  }
  void* mapped = ftruncate(descriptor, sizeof(AllocationSlots)) == 0
                     ? mmap(nullptr, sizeof(AllocationSlots), PROT_READ, MAP_SHARED, descriptor, 0)
                     : MAP_FAILED;
  close(descriptor);
  if (mapped == MAP_FAILED) {
    return;
  }
  slots_ = static_cast<const AllocationSlots*>(mapped);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread, as the header says
  in_environment_ = std::getenv(kPreload) == nullptr &&
                    setenv(kAllocationsFile, file.c_str(), 1) == 0 &&  // NOLINT: likewise
                    setenv(kPreload, library.c_str(), 1) == 0;         // NOLINT: likewise
}

AllocationCounter::~AllocationCounter() {
  leave_environment();
  if (slots_ != nullptr) {
    munmap(const_cast<AllocationSlots*>(slots_), sizeof(AllocationSlots));
  }
}

void AllocationCounter::leave_environment() noexcept {
  if (in_environment_) {
    unsetenv(kPreload);          // NOLINT(concurrency-mt-unsafe): likewise
    unsetenv(kAllocationsFile);  // NOLINT(concurrency-mt-unsafe): likewise
    in_environment_ = false;
  }
}

std::map<pid_t, std::uint64_t> AllocationCounter::counts() const {
  std::map<pid_t, std::uint64_t> counts;
  if (slots_ == nullptr) {
    return counts;
  }
  for (const AllocationSlot& slot : slots_->slots) {
    if (const pid_t thread = slot.thread.load(std::memory_order_acquire); thread != 0) {
      counts[thread] = slot.count.load(std::memory_order_relaxed);
    }
  }
  return counts;
}

}  // namespace lodesman::cli
