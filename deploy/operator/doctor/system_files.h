// SPDX-License-Identifier: Apache-2.0
// What the kernel, udev and the system's settings have written down: read as plain text, below a
// root that a test may make up. One thread; no device is opened. What cannot be read is as if it
// were not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lodesman::cli {

[[nodiscard]] bool is_there(const std::filesystem::path& path);
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& file);
[[nodiscard]] std::string first_line_of(const std::filesystem::path& file);
[[nodiscard]] std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

// The folder of the USB device that an entry of /sys/class/tty belongs to; empty: none.
[[nodiscard]] std::filesystem::path usb_device_of(const std::filesystem::path& terminal);

// Of a device node: whether this user may read and write it, and the group that it belongs to.
[[nodiscard]] bool is_usable(const std::filesystem::path& node);
[[nodiscard]] std::string group_of(const std::filesystem::path& node,
                                   const std::filesystem::path& root);

struct PortHolder {
  std::string program;
  std::string process;  // its number
};
// Of a node such as /dev/ttyUSB0, as far as this user may see.
[[nodiscard]] std::vector<PortHolder> holders_of(const std::string& node,
                                                 const std::filesystem::path& root);

}  // namespace lodesman::cli
