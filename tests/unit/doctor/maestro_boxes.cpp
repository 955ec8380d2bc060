// SPDX-License-Identifier: Apache-2.0
// Machines made up of files: which Maestros doctor finds, whom it asks, and what it says.
#include "deploy/operator/doctor/maestro_boxes.h"

#include <fstream>

#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {
namespace {

using namespace cli;
namespace fs = std::filesystem;
using Outcome = MaestroAnswer::Outcome;

[[nodiscard]] MaestroSettings well_set() {
  MaestroSettings settings;
  settings.serial_mode = MaestroSettings::kUsbDualPort;
  settings.time_out = std::chrono::milliseconds{500};
  settings.never_suspend = true;
  settings.left = settings.right = {6000, 3968, 8000, 0, 0};
  return settings;
}

// A Mini Maestro 12 with its two ports.
class BoxMachine {
 public:
  BoxMachine() {
    add_usb("1-2", "1ffb", "008a", "7");
    add_port("ttyACM0", "1-2", "00");
    add_port("ttyACM1", "1-2", "02");
    file("etc/group", "root:x:0:\ndialout:x:20:skipper\n");
  }
  [[nodiscard]] const fs::path& root() const { return directory_.path(); }
  void file(const std::string& name, const std::string& text) const {
    fs::create_directories((root() / name).parent_path());
    std::ofstream{root() / name} << text;
  }
  void link(const std::string& name, const std::string& target) const {
    fs::create_directories((root() / name).parent_path());
    fs::create_symlink(target, root() / name);
  }
  void add_usb(const std::string& place, const std::string& vendor, const std::string& product,
               const std::string& number) const {
    const std::string folder = "sys/devices/usb1/" + place;
    file(folder + "/idVendor", vendor + "\n");
    file(folder + "/idProduct", product + "\n");
    file(folder + "/busnum", "1\n");
    file(folder + "/devnum", number + "\n");
    link("sys/bus/usb/devices/" + place, "../../../devices/usb1/" + place);
  }
  void add_port(const std::string& name, const std::string& place,
                const std::string& interface) const {
    const std::string of_device = "devices/usb1/" + place + "/" + place + ":1." + interface;
    file("sys/" + of_device + "/bInterfaceNumber", interface + "\n");
    fs::create_directories(root() / "sys/class/tty" / name);
    link("sys/class/tty/" + name + "/device", "../../../" + of_device);
    file("dev/" + name, "");
  }
  void hold(const std::string& node, const std::string& program) const {
    file("proc/900/comm", program + "\n");
    link("proc/900/fd/3", node);
  }
  [[nodiscard]] std::vector<Finding> findings(const std::string& thrusters) {
    const PortsFacts ports =
        measure_ports(ports_named_in({"sim:", "sim:", "none", thrusters}), root());
    const MaestroNeeds needs = maestro_needs(thrusters, {});
    const auto ask = [this](const std::string& node, const MaestroOptions&) {
      asked.push_back("/" + fs::path{node}.lexically_relative(root()).string());
      return answer;
    };
    return judge_maestros(measure_maestros(ports, needs, root(), ask), needs);
  }
  [[nodiscard]] Finding only_finding(const std::string& thrusters = "maestro:/dev/ttyACM0") {
    const auto all = findings(thrusters);
    REQUIRE(all.size() == 1);
    CHECK(all[0].name == "maestro");
    return all[0];
  }

  MaestroAnswer answer{Outcome::kRead, well_set()};
  std::vector<std::string> asked;

 private:
  TemporaryDirectory directory_;
};

TEST_CASE("maestro boxes: the one that the configuration names is asked, once", "[cli]") {
  BoxMachine machine;
  machine.link("dev/lodesman/thrusters", "../ttyACM0");
  const Finding finding = machine.only_finding("maestro:/dev/lodesman/thrusters?left=0");
  CHECK(finding.verdict == Verdict::kOk);
  CHECK(finding.what.starts_with("Mini Maestro 12 at /dev/lodesman/thrusters: "));
  CHECK(machine.asked == std::vector<std::string>{"/dev/bus/usb/001/007"});
}

TEST_CASE("maestro boxes: what is wrong with the boat's box is bad", "[cli]") {
  BoxMachine machine;
  machine.answer.settings.time_out = Duration::zero();
  CHECK(machine.only_finding().verdict == Verdict::kBad);
  CHECK_FALSE(machine.only_finding().remedy.empty());
}

TEST_CASE("maestro boxes: one that is plugged in and not named is judged too, and warned of",
          "[cli]") {
  BoxMachine machine;
  CHECK(machine.only_finding("sim:").verdict == Verdict::kOk);
  CHECK(machine.only_finding("sim:").what.starts_with("Mini Maestro 12 at USB 1-2, which no"));
  machine.answer.settings.serial_mode = MaestroSettings::kUartDetect;
  CHECK(machine.only_finding("sim:").verdict == Verdict::kWarn);
  machine.add_usb("1-3", "1ffb", "0089", "8");
  const auto findings = machine.findings("maestro:/dev/ttyACM0");
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].verdict == Verdict::kBad);
  CHECK(findings[1].verdict == Verdict::kWarn);
  CHECK(findings[1].what.starts_with("Micro Maestro 6 at USB 1-3"));
}

TEST_CASE("maestro boxes: where there is none, there is nothing to say", "[cli]") {
  BoxMachine machine;
  fs::remove_all(machine.root() / "sys/bus");
  CHECK(machine.findings("sim:").empty());
  CHECK(machine.findings("maestro:/dev/ttyACM7").empty());  // which the port's own finding tells
  CHECK(machine.findings("roboclaw:/dev/ttyACM0").empty());
  machine.add_usb("1-4", "1ffb", "0099", "9");  // another device of this maker
  machine.add_usb("1-5", "0403", "6001", "10");
  CHECK(machine.findings("sim:").empty());
  CHECK(machine.asked.empty());
}

// A question might set anew the time-out that is to stop the boat.
TEST_CASE("maestro boxes: one that a program holds, by either port, is not asked", "[cli]") {
  for (const char* node : {"/dev/ttyACM0", "/dev/ttyACM1"}) {
    for (const char* thrusters : {"maestro:/dev/ttyACM0", "sim:"}) {
      BoxMachine machine;
      machine.hold(node, "lodesman-low");
      CHECK(machine.only_finding(thrusters).verdict == Verdict::kInfo);
      CHECK(machine.only_finding(thrusters).what.ends_with(
          "are not read while lodesman-low (900) holds it"));
      CHECK(machine.asked.empty());
    }
  }
}

TEST_CASE("maestro boxes: a user who may not ask is told of the rule or the group", "[cli]") {
  BoxMachine machine;
  machine.answer = {Outcome::kForbidden, {}};
  CHECK(machine.only_finding().verdict == Verdict::kWarn);
  CHECK(machine.only_finding().remedy.find("60-lodesman.rules") != std::string::npos);
  MaestroFacts box;
  box.name = "box";
  box.named = true;
  box.channels = 6;
  box.group = "dialout";
  box.said = machine.answer;
  const auto findings = judge_maestros({box}, {});
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].remedy == "sudo usermod -aG dialout $USER; log in again");
}

TEST_CASE("maestro boxes: one that does not answer is told of, and no verdict is made up",
          "[cli]") {
  BoxMachine machine;
  machine.answer = {Outcome::kSilent, {}};
  CHECK(machine.only_finding().verdict == Verdict::kWarn);
  CHECK(machine.only_finding().what.ends_with("does not tell its settings by USB"));
}

TEST_CASE("maestro boxes: the second port is known for what it is", "[cli]") {
  BoxMachine machine;
  const Finding finding = machine.only_finding("maestro:/dev/ttyACM1");
  CHECK(finding.verdict == Verdict::kBad);
  CHECK(finding.what.ends_with("is its TTL port, which takes no commands"));
}

TEST_CASE("maestro boxes: a port of another maker's adapter says nothing of the box behind it",
          "[cli]") {
  BoxMachine machine;
  fs::remove_all(machine.root() / "sys/bus");
  machine.add_usb("1-5", "0403", "6001", "10");
  machine.add_port("ttyUSB0", "1-5", "00");
  CHECK(machine.only_finding("maestro:/dev/ttyUSB0").verdict == Verdict::kInfo);
  CHECK(machine.asked.empty());
}

TEST_CASE("maestro boxes: a channel that the box does not have is bad, and is not asked for",
          "[cli]") {
  BoxMachine machine;
  CHECK(machine.only_finding("maestro:/dev/ttyACM0?left=0&right=11").verdict == Verdict::kOk);
  machine.asked.clear();
  const Finding finding = machine.only_finding("maestro:/dev/ttyACM0?left=0&right=12");
  CHECK(finding.verdict == Verdict::kBad);
  CHECK(finding.what.ends_with("has channels 0 to 11, and the thrusters are on 0 and 12"));
  CHECK(machine.asked.empty());
}

}  // namespace
}  // namespace lodesman::testing
