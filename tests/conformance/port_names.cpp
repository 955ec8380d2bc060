// SPDX-License-Identifier: Apache-2.0
// How real ports come, go and change their names, played by a pty; and what each port does besides.
// The letters and numbers are those of a list of reports.
#include <sys/wait.h>

#include <atomic>

#include "tests/conformance/line_bench.h"

namespace lodesman::conformance {
namespace {

using Ports = std::tuple<PtyBench, SerialPortBench>;
using std::chrono::milliseconds;
using std::chrono::seconds;
namespace fs = std::filesystem;

TEMPLATE_LIST_TEST_CASE("U1: a device that comes back by another number is found through its link",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const std::string node = bench.device().node();
  // The old number stays taken, as a kernel keeps it while somebody has the port open.
  const int old_master = dup(bench.device().master());
  REQUIRE(old_master >= 0);
  bench.unplug();
  bench.plug();
  REQUIRE(bench.device().node() != node);
  CHECK(bench.line().connection(bench.now()) == 1);
  close(old_master);
  const auto appeared = std::chrono::steady_clock::now();
  REQUIRE(
      bench.settles([&] { return is_silent(bench) && bench.line().connection(bench.now()) == 2; }));
  CHECK(std::chrono::steady_clock::now() - appeared < seconds{2});
  CHECK(descriptors_of(bench.device().node()) > 0);
  REQUIRE(bench.device_sends(Bytes(9, 4)) == 9);
  CHECK(read_bytes(bench, 9) == Bytes(9, 4));
}

TEMPLATE_LIST_TEST_CASE("U1: a device that was long gone is found within two seconds",
                        "[conformance]", Ports) {
  TestType bench;
  bench.unplug();
  REQUIRE(bench.settles([&] { return bench.line().fault() == DeviceFault::kNoPort; }));
  std::this_thread::sleep_for(seconds{2});  // until it looks as seldom as it does
  bench.plug();
  const auto appeared = std::chrono::steady_clock::now();
  REQUIRE(connect(bench) == 1);
  CHECK(std::chrono::steady_clock::now() - appeared < seconds{2});
}

TEMPLATE_LIST_TEST_CASE("U2: links are followed anew at each opening", "[conformance]", Ports) {
  TestType bench;
  const fs::path outer = bench.device().folder() / "outer";
  fs::create_symlink(bench.device().path(), outer);
  const auto line = TestType::make(outer.string());
  REQUIRE(bench.settles([&] { return line->connection(bench.now()) == 1; }));
  testing::PtyDevice other;
  bench.device().point_link_at(other.node());
  CHECK(line->connection(bench.now()) == 1);
  line->reconnect(9600);
  REQUIRE(bench.settles([&] { return line->connection(bench.now()) == 2; }));
  REQUIRE(line->write(Bytes{7}, bench.now()) == 1);
  Bytes got(4);
  REQUIRE(bench.settles([&] { return other.receive(got) == 1; }));
  CHECK(got[0] == 7);
  const termios settings = other.settings();
  CHECK(cfgetospeed(&settings) == B9600);
}

TEMPLATE_LIST_TEST_CASE("U4: a device that hangs up soon after the first opening is tried again",
                        "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  std::this_thread::sleep_for(milliseconds{200});
  bench.unplug();
  bench.plug();
  REQUIRE(loses_its_connection(bench));
  REQUIRE(connect(bench) == 2);
  CHECK(bench.line().fault() == DeviceFault::kNone);
  REQUIRE(bench.line().write(Bytes(5, 3), bench.now()) == 5);
  CHECK(receive_bytes(bench, 5) == Bytes(5, 3));
}

TEMPLATE_LIST_TEST_CASE("port: whoever is to be told of bytes is told, and not without",
                        "[conformance]", Ports) {
  TestType bench;
  std::atomic<int> told{0};
  const auto line = TestType::make(bench.device().path(), [&] { ++told; });
  REQUIRE(bench.settles([&] { return line->connection(bench.now()) == 1; }));
  REQUIRE(bench.settles([&] { return told == 1; }));  // of the connection itself
  const auto sent = std::chrono::steady_clock::now();
  REQUIRE(bench.device_sends(Bytes(5, 3)) == 5);
  REQUIRE(bench.settles([&] { return told > 20; }));  // again and again, while nobody reads
  const auto lasted = std::chrono::steady_clock::now() - sent;
  CHECK(told - 1 <= lasted / milliseconds{1} + 2);
  Bytes got(8);
  REQUIRE(line->read(got, bench.now()).count == 5);
  std::this_thread::sleep_for(milliseconds{50});  // what it was about to say
  const int after = told;
  std::this_thread::sleep_for(milliseconds{100});
  CHECK(told == after);
  REQUIRE(bench.device_sends(Bytes(1, 3)) == 1);
  CHECK(bench.settles([&] { return told > after; }));
}

TEST_CASE("port: what is no port is told from what is not there or not allowed", "[conformance]") {
  const testing::TemporaryDirectory folder;
  const auto fault = [](const std::string& path) { return open_port(path, 57600).fault; };
  CHECK(fault((folder.path() / "nothing").string()) == DeviceFault::kNoPort);
  CHECK(fault((folder.path() / "nothing" / "inside").string()) == DeviceFault::kNoPort);
  fs::create_symlink("around", folder.path() / "around");
  CHECK(fault((folder.path() / "around").string()) == DeviceFault::kNoPort);
  CHECK(fault("") == DeviceFault::kNoPort);
  CHECK(fault(folder.path().string()) == DeviceFault::kNotAPort);
  CHECK(fault("/proc/self/status") == DeviceFault::kNotAPort);
  CHECK(fault("/dev/null") == DeviceFault::kNotAPort);
  testing::PtyDevice device;
  CHECK(open_port(device.path(), 57601).fault == DeviceFault::kDoesNotFit);
  REQUIRE(chmod(device.node().c_str(), 0) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const bool other_user = geteuid() != 0 || setuid(65534) == 0;
    _exit(other_user ? static_cast<int>(claim_tty(device.node()).fault) : 255);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WEXITSTATUS(status) == static_cast<int>(DeviceFault::kNoPermission));
}

// A program that is started while a port is open must not have it.
TEMPLATE_LIST_TEST_CASE("port: no descriptor is inherited", "[conformance]", Ports) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator{"/proc/self/fd"}) {
    std::error_code error;
    if (fs::read_symlink(entry.path(), error) == bench.device().node()) {
      ++seen;
      CHECK((fcntl(std::stoi(entry.path().filename()), F_GETFD) & FD_CLOEXEC) != 0);
    }
  }
  CHECK(seen > 0);
}

}  // namespace
}  // namespace lodesman::conformance
