// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/nonblocking_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <string>

namespace lodesman {
namespace {

// A second description of the same pipe or terminal. A file keeps its own: two of them would write
// over one another, and a disk does not make anybody wait.
[[nodiscard]] int opened_anew(int descriptor) noexcept {
  struct stat about {};
  const bool written_to = (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
  if (!written_to || fstat(descriptor, &about) != 0 ||
      (!S_ISFIFO(about.st_mode) && !S_ISCHR(about.st_mode))) {
    return -1;
  }
  std::string link{"/proc/self/fd/"};
  link += std::to_string(descriptor);
  return open(link.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

}  // namespace

NonblockingStream::NonblockingStream(int descriptor) noexcept
    : descriptor_{descriptor}, own_{opened_anew(descriptor)} {}

NonblockingStream::~NonblockingStream() {
  if (own_ >= 0) {
    close(own_);
  }
}

// A pipe that can be written to at all takes PIPE_BUF bytes.
bool NonblockingStream::would_block() const noexcept {
  pollfd room{descriptor_, POLLOUT, 0};
  return descriptor_ >= 0 && poll(&room, 1, 0) == 0;
}

NonblockingStream::Written NonblockingStream::write(std::string_view text) const noexcept {
  const int descriptor = own_ >= 0 ? own_ : descriptor_;
  while (!text.empty()) {
    if (own_ < 0 && would_block()) {
      return Written::kDropped;
    }
    const ssize_t count =
        ::write(descriptor, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
    if (count < 0 && errno != EINTR) {
      return errno == EAGAIN ? Written::kDropped : Written::kFailed;
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return Written::kWhole;
}

}  // namespace lodesman
