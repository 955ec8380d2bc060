// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/outside_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

namespace lodesman::fuzz {

OutsideFile::OutsideFile(std::string_view bytes)
    : descriptor_{memfd_create("outside", MFD_CLOEXEC)} {
  if (descriptor_ < 0 ||
      write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error{"no file in memory"};
  }
}

OutsideFile::~OutsideFile() { close(descriptor_); }

std::filesystem::path OutsideFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

}  // namespace lodesman::fuzz
