// SPDX-License-Identifier: Apache-2.0
// What real ports were seen to do to programs, played by a pty. The letters and numbers are those
// of a list of such reports.
#include <sys/file.h>
#include <sys/wait.h>

#include <atomic>
#include <ctime>

#include "tests/conformance/line_bench.h"

namespace lodesman::conformance {
namespace {

using Ports = std::tuple<PtyBench, SerialPortBench>;
using std::chrono::milliseconds;
using std::chrono::seconds;

[[nodiscard]] double processor_time_s() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

TEMPLATE_LIST_TEST_CASE("S1: a port whose device is gone is closed, and costs next to nothing",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const std::string node = bench.device().node();
  CHECK(descriptors_of(node) > 0);
  bench.unplug();
  REQUIRE(loses_its_connection(bench));
  CHECK(bench.settles([&] { return descriptors_of(node) == 0; }));
  const double before_s = processor_time_s();
  for (int i = 0; i < 200; ++i) {
    CHECK(is_silent(bench));
    std::this_thread::sleep_for(milliseconds{10});
  }
  CHECK(processor_time_s() - before_s < 0.05 * 2.0);
}

TEMPLATE_LIST_TEST_CASE("S1: a helper that tells of bytes does not spin where nobody reads",
                        "[conformance]", Ports) {
  TestType bench;
  std::atomic<int> told{0};
  const auto line = TestType::make(bench.device().path(), [&] { ++told; });
  REQUIRE(bench.settles([&] { return line->connection(bench.now()) == 1; }));
  bench.unplug();
  const double before_s = processor_time_s();
  const int told_before = told;
  std::this_thread::sleep_for(seconds{1});
  CHECK(told > told_before);
  CHECK(processor_time_s() - before_s < 0.05);
}

TEMPLATE_LIST_TEST_CASE("S3: a connection is not taken for one because its descriptor is open",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  bench.device().hang_up();
  CHECK(is_silent(bench));
  CHECK(bench.line().connection(bench.now()) == 0);
  CHECK(bench.line().fault() == DeviceFault::kUnplugged);
  bench.unplug();
}

TEMPLATE_LIST_TEST_CASE("S4: half a frame goes with its connection", "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes frame = pattern(39);
  REQUIRE(bench.device_sends(std::span{frame}.first(20)) == 20);
  bench.unplug();
  std::size_t before = 0;
  Bytes piece(64);
  REQUIRE(bench.settles([&] {
    before += bench.line().read(piece, bench.now()).count;
    return bench.line().connection(bench.now()) == 0;
  }));
  CHECK(before <= 20);
  bench.plug();
  REQUIRE(connect(bench) == 2);
  REQUIRE(bench.device_sends(frame) == frame.size());
  CHECK(read_bytes(bench, frame.size()) == frame);
}

TEMPLATE_LIST_TEST_CASE("S5: a command to a port that is gone is not taken, and says so",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes command{0x84, 0x00, 0x70, 0x2E};
  REQUIRE(bench.line().write(command, bench.now()) == 4);
  bench.unplug();
  CHECK(bench.line().write(command, bench.now()) == 0);
  CHECK(bench.line().connection(bench.now()) == 0);
  CHECK(bench.line().fault() == DeviceFault::kUnplugged);
}

TEMPLATE_LIST_TEST_CASE("S6: a line that is full for half a second is given up, no sooner",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes command(100, 5);
  REQUIRE(bench.settles([&] { return bench.line().write(command, bench.now()) == 0; }));
  Duration waited{};
  while (waited < ReconnectingLine::kFullLimit - milliseconds{10}) {
    bench.pass(milliseconds{10});
    waited += milliseconds{10};
    CHECK(bench.line().write(command, bench.now()) == 0);
    CHECK(bench.line().connection(bench.now()) == 1);
  }
  bench.pass(milliseconds{10});
  CHECK(bench.line().write(command, bench.now()) == 0);
  CHECK(bench.line().connection(bench.now()) == 0);
  CHECK(bench.line().fault() == DeviceFault::kLineFull);
  Bytes piece(4096);
  CHECK(bench.settles([&] { return bench.device_receives(piece) == 0; }));
  REQUIRE(connect(bench) == 2);
  CHECK(bench.line().write(command, bench.now()) == command.size());
}

TEMPLATE_LIST_TEST_CASE("S6: a full line that takes a byte now and then is kept", "[conformance]",
                        Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes command(100, 5);
  for (int round = 0; round < 4; ++round) {
    REQUIRE(bench.settles([&] { return bench.line().write(command, bench.now()) == 0; }));
    bench.pass(ReconnectingLine::kFullLimit - milliseconds{100});
    Bytes piece(4096);
    REQUIRE(bench.settles([&] { return bench.device_receives(piece) > 0; }));
    std::size_t taken = 0;
    for (int i = 0; i < 1000 && taken == 0; ++i) {  // no time passes: the kernel makes room
      while (bench.device_receives(piece) > 0) {
      }
      taken = bench.line().write(command, bench.now());
    }
    CHECK(taken > 0);
  }
  CHECK(bench.line().connection(bench.now()) == 1);
}

TEMPLATE_LIST_TEST_CASE("S7: no byte stops the output or is taken for a signal", "[conformance]",
                        Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes commands{0x13, 0x11, 0x03, 0x1A, 0x1C, 0x04, 0x7F, 0x0D, 0x0A, 0x00, 0xFF, 0x13};
  REQUIRE(bench.device_sends(commands) == commands.size());
  CHECK(read_bytes(bench, commands.size()) == commands);
  const Bytes output = pattern(3000);  // after a stop, if there is such a thing
  REQUIRE(bench.line().write(output, bench.now()) == output.size());
  CHECK(receive_bytes(bench, output.size()) == output);
  const termios settings = bench.device().settings();
  CHECK((settings.c_iflag & (IXON | IXOFF | IXANY)) == 0);
  CHECK((settings.c_cflag & CRTSCTS) == 0);
  CHECK((settings.c_lflag & (ECHO | ICANON | ISIG)) == 0);
}

// With the settings that a device finds, and with raw ones, where more is kept.
TEMPLATE_LIST_TEST_CASE("S8: nothing is given that came before the port was opened",
                        "[conformance]", Ports) {
  const bool raw_before = GENERATE(false, true);
  CAPTURE(raw_before);
  TestType bench;
  if (raw_before) {
    termios settings = bench.device().settings();
    cfmakeraw(&settings);
    REQUIRE(tcsetattr(bench.device().master(), TCSANOW, &settings) == 0);
  }
  for (std::uint64_t start = 0; start < 2; ++start) {
    std::size_t stale = 0;
    for (std::size_t some = 1; some > 0 && stale < 100000;) {
      stale += some = bench.device_sends(Bytes(500, 0xEE));
    }
    CHECK(stale > 4000);
    REQUIRE(connect(bench) == 1);
    CHECK(is_silent(bench));
    REQUIRE(bench.device_sends(Bytes(300, 0x11)) == 300);
    CHECK(read_bytes(bench, 300) == Bytes(300, 0x11));
    bench.drop_line();  // the program is started again
  }
}

TEMPLATE_LIST_TEST_CASE("S9: a thousand questions have a thousand answers", "[conformance]",
                        Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  std::atomic<bool> done{false};
  std::thread device{[&] {
    std::uint8_t question = 0;
    while (!done) {
      if (bench.device().receive({&question, 1}) == 1) {
        std::this_thread::sleep_for(std::chrono::microseconds{question % 5 * 500});
        while (bench.device().send({&question, 1}) == 0 && !done) {
        }
      } else {
        std::this_thread::yield();
      }
    }
  }};
  int answered = 0;
  for (int i = 0; i < 1000; ++i) {
    const Bytes question{static_cast<std::uint8_t>(i)};
    if (bench.line().write(question, bench.now()) != 1 || read_bytes(bench, 1) != question) {
      break;
    }
    ++answered;
  }
  done = true;
  device.join();
  CHECK(answered == 1000);
}

TEST_CASE("S10: a port without modem lines is opened by system calls", "[conformance]") {
  testing::PtyDevice device;
  const OpenedPort opened = open_port(device.path(), 57600);
  REQUIRE(opened.port);
  CHECK(dynamic_cast<const TermiosPort*>(opened.port.get()) != nullptr);
  REQUIRE(opened.port->write(Bytes(5, 3)) == 5);
  Bytes got(8);
  CHECK(testing::eventually([&] { return device.receive(got) == 5; }));
  std::array<int, 2> ends{};
  REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0);
  CHECK_FALSE(has_modem_lines(ends[0]));
  close(ends[0]);
  close(ends[1]);
}

TEMPLATE_LIST_TEST_CASE("S11: closing does not drop the modem lines, which would reset some boards",
                        "[conformance]", Ports) {
  TestType bench;
  CHECK((bench.device().settings().c_cflag & HUPCL) == 0);  // a pty has none by itself:
  termios settings = bench.device().settings();
  settings.c_cflag |= HUPCL;
  REQUIRE(tcsetattr(bench.device().master(), TCSANOW, &settings) == 0);
  REQUIRE((bench.device().settings().c_cflag & HUPCL) != 0);
  REQUIRE(connect(bench) == 1);
  CHECK((bench.device().settings().c_cflag & HUPCL) == 0);
  CHECK((bench.device().settings().c_cflag & CLOCAL) != 0);
}

TEMPLATE_LIST_TEST_CASE("S12: a port that another program holds is waited for", "[conformance]",
                        Ports) {
  TestType bench;
  TtyClaim other = claim_tty(bench.device().path());
  REQUIRE(other.fault == DeviceFault::kNone);
  REQUIRE(bench.settles([&] {
    CHECK(bench.line().connection(bench.now()) == 0);
    return bench.line().fault() == DeviceFault::kPortBusy;
  }));
  std::this_thread::sleep_for(milliseconds{400});  // some tries more
  CHECK(bench.line().fault() == DeviceFault::kPortBusy);
  const Bytes probe{'A', 'T', '\r'};
  REQUIRE(write(other.descriptor.value(), probe.data(), probe.size()) == 3);
  other = {};
  CHECK(connect(bench) == 1);
  CHECK(bench.line().fault() == DeviceFault::kNone);
}

// Asked as a user who is not root: the kernel lets root in all the same.
TEST_CASE("S12: a port that is held exclusively is busy", "[conformance]") {
  testing::PtyDevice device;
  const FileDescriptor holder{open(device.node().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
  REQUIRE(holder.is_open());
  REQUIRE(fchmod(holder.value(), 0666) == 0);
  REQUIRE(ioctl(holder.value(), TIOCEXCL) == 0);
  CHECK(OpensSerialPort::open(device.node(), 57600).fault == DeviceFault::kPortBusy);
  const pid_t child = fork();
  if (child == 0) {
    const bool other_user = geteuid() != 0 || setuid(65534) == 0;
    _exit(other_user ? static_cast<int>(claim_tty(device.node()).fault) : 255);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == static_cast<int>(DeviceFault::kPortBusy));
}

TEMPLATE_LIST_TEST_CASE("S13: a second opener is refused, and the first is not disturbed",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  REQUIRE(bench.device_sends(Bytes(30, 0x11)) == 30);
  {
    const auto second = TestType::make(bench.device().node());  // by its own name, too
    REQUIRE(bench.settles([&] { return second->fault() == DeviceFault::kPortBusy; }));
    std::this_thread::sleep_for(milliseconds{300});
    CHECK(second->connection(bench.now()) == 0);
  }
  CHECK(read_bytes(bench, 30) == Bytes(30, 0x11));
  CHECK((bench.device().settings().c_iflag & (IXON | IXANY)) == 0);
  CHECK(bench.line().connection(bench.now()) == 1);
}

}  // namespace
}  // namespace lodesman::conformance
