// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/nonblocking_stream.h"

#include <sys/socket.h>

#include <csignal>

#include "tests/support/full_pipe.h"

using namespace lodesman;
using Written = NonblockingStream::Written;

TEST_CASE("nonblocking stream: a full pipe costs the text and no moment", "[run]") {
  const testing::Pipe pipe;
  const NonblockingStream stream{pipe.writer()};
  CHECK(stream.write("a line\n") == Written::kWhole);
  CHECK(pipe.read_some() == "a line\n");
  pipe.fill();
  CHECK(stream.write("lost\n") == Written::kDropped);
  // Whoever else has the pipe finds it as it was: a write of theirs waits.
  CHECK((fcntl(pipe.writer(), F_GETFL) & O_NONBLOCK) == 0);
}

TEST_CASE("nonblocking stream: a socket that nobody reads is not waited for either", "[run]") {
  std::array<int, 2> ends{};
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
  const std::string page(4096, '.');
  while (send(ends[0], page.data(), page.size(), MSG_DONTWAIT) > 0) {
  }
  const NonblockingStream stream{ends[0]};
  CHECK(stream.write("lost\n") == Written::kDropped);
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("nonblocking stream: what is broken, full or closed has failed", "[run]") {
  std::signal(SIGPIPE, SIG_IGN);
  testing::Pipe pipe;
  const NonblockingStream stream{pipe.writer()};
  pipe.close_reader();
  CHECK(stream.write("lost\n") == Written::kFailed);
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  REQUIRE(full >= 0);
  CHECK(NonblockingStream{full}.write("lost\n") == Written::kFailed);
  close(full);
  const int not_to_write = open("/dev/null", O_RDONLY | O_CLOEXEC);
  CHECK(NonblockingStream{not_to_write}.write("lost\n") == Written::kFailed);
  close(not_to_write);
  CHECK(NonblockingStream{-1}.write("lost\n") == Written::kFailed);
}
