// SPDX-License-Identifier: Apache-2.0
// Whether a device can have been without power since a port to it was last opened. A device that is
// itself on the USB is numbered anew each time it comes up (Linux, ABI/stable/sysfs-bus-usb:
// devnum), and its node is made anew. What sits behind an adapter, a UART or a network may lose its
// power unseen: nothing is known of it. A pty stands for a bench, whose devices live as long as it.
// Helper threads alone; it may block.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lodesman {

struct PowerUpSources {
  std::filesystem::path sysfs = "/sys";
  std::filesystem::path boot_id = "/proc/sys/kernel/random/boot_id";
};

// Of an open terminal device: a number for this boot, this device and this time that it came up.
// 0 where that is not known. A node is told from the one before it by the time at which it was
// made, in ticks of the kernel (at most 10 ms): a pty within the same one counts as the same. A
// node whose owner or mode is changed counts as another.
[[nodiscard]] std::uint64_t power_up_of(int descriptor, const PowerUpSources& sources = {});

}  // namespace lodesman
