// SPDX-License-Identifier: Apache-2.0
// A library to be preloaded: counts what each thread of a program asks of the heap, where
// lodesman rt-test can read it (allocation_slots.h), and does nothing else. Without the file that
// the environment names it counts nothing.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include "deploy/operator/rt_test/allocation_slots.h"

// The C library's own, by the names that it keeps for programs which replace the others.
extern "C" {
void* own_malloc(std::size_t size) __asm__("__libc_malloc");
void* own_calloc(std::size_t count, std::size_t size) __asm__("__libc_calloc");
void* own_realloc(void* block, std::size_t size) __asm__("__libc_realloc");
void* own_memalign(std::size_t alignment, std::size_t size) __asm__("__libc_memalign");
}

namespace {

using lodesman::cli::AllocationSlot;
using lodesman::cli::AllocationSlots;

constinit std::atomic<AllocationSlots*> g_slots{nullptr};

// Of a model that needs no memory of the heap itself.
[[gnu::tls_model("initial-exec")]] thread_local constinit AllocationSlot* t_slot = nullptr;

[[gnu::constructor]] void map_slots() noexcept {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before the program has threads
  const char* file = std::getenv(lodesman::cli::kAllocationsFile);
  const int descriptor = file != nullptr ? open(file, O_RDWR | O_CLOEXEC) : -1;
  if (descriptor < 0) {
    return;
  }
  void* mapped =
      mmap(nullptr, sizeof(AllocationSlots), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (mapped != MAP_FAILED) {
    g_slots.store(static_cast<AllocationSlots*>(mapped), std::memory_order_release);
  }
}

void count() noexcept {
  AllocationSlots* slots = g_slots.load(std::memory_order_acquire);
  if (slots == nullptr) {
    return;
  }
  if (t_slot == nullptr) {
    const std::uint32_t index = slots->claimed.fetch_add(1, std::memory_order_relaxed);
    if (index >= AllocationSlots::kMost) {
      return;
    }
    t_slot = &slots->slots[index];
    t_slot->thread.store(gettid(), std::memory_order_release);
  }
  t_slot->count.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  count();
  return own_malloc(size);
}
void* calloc(std::size_t elements, std::size_t size) noexcept {
  count();
  return own_calloc(elements, size);
}
void* realloc(void* block, std::size_t size) noexcept {
  count();
  return own_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  count();
  return own_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count();
  return own_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
  count();
  *block = own_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

}  // extern "C"
