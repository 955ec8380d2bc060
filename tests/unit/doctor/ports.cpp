// SPDX-License-Identifier: Apache-2.0
// Machines made up of files: what doctor sees of their serial ports, and says.
#include <unistd.h>

#include <fstream>
#include <regex>
#include <set>

#include "deploy/operator/doctor/port_diagnosis.h"
#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {
namespace {

using namespace cli;
namespace fs = std::filesystem;

// With an FTDI cable at ttyUSB0 that a stable link leads to.
class MadeUpMachine {
 public:
  MadeUpMachine() {
    add_usb_port("ttyUSB0", "188:0");
    link("dev/lodesman/ahrs", "../ttyUSB0");
    file("sys/devices/usb1/1-1/1-1.0/ttyUSB0/latency_timer", "1\n");
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
  void add_usb_port(const std::string& name, const std::string& number) const {
    file("dev/" + name, "");
    file("sys/devices/usb1/1-1/idVendor", "0403\n");
    fs::create_directories(root() / "sys/devices/usb1/1-1/1-1.0" / name);
    fs::create_directories(root() / "sys/class/tty" / name);
    link("sys/class/tty/" + name + "/device", "../../../devices/usb1/1-1/1-1.0/" + name);
    file("sys/class/tty/" + name + "/dev", number + "\n");
  }
  void add_process(const std::string& number, const std::string& name,
                   const std::string& opened) const {
    file("proc/" + number + "/comm", name + "\n");
    link("proc/" + number + "/fd/3", opened);
  }
  [[nodiscard]] std::vector<Finding> findings(const DeviceAddresses& devices) const {
    return judge_ports(measure_ports(ports_named_in(devices), root()));
  }
  // Of the one port that is named.
  [[nodiscard]] std::vector<Finding> findings() const {
    auto all = findings({"nav440:/dev/lodesman/ahrs?baud=57600", "sim:", "none", "sim:"});
    REQUIRE(all.back().name == "serial_ports");
    all.pop_back();
    return all;
  }
  [[nodiscard]] Finding only_finding() const {
    const auto all = findings();
    REQUIRE(all.size() == 1);
    CHECK(all[0].name == "heading");
    return all[0];
  }

 private:
  TemporaryDirectory directory_;
};

TEST_CASE("ports: those that the addresses name, without their settings", "[cli]") {
  const auto ports = ports_named_in({"nav440:/dev/lodesman/ahrs?baud=57600&packet=A1",
                                     "delta_t:10.0.0.2:4040", "none", "maestro:/dev/ttyACM0"});
  REQUIRE(ports.size() == 2);
  CHECK(ports[0].device == "heading");
  CHECK(ports[0].scheme == "nav440");
  CHECK(ports[0].path == "/dev/lodesman/ahrs");
  CHECK(ports[1].device == "thrusters");
  CHECK(ports[1].path == "/dev/ttyACM0");
}

TEST_CASE("ports: nothing is wrong with one that nothing is wrong with", "[cli]") {
  const MadeUpMachine machine;
  CHECK(machine.only_finding().verdict == Verdict::kOk);
  CHECK(machine.only_finding().what == "/dev/lodesman/ahrs (/dev/ttyUSB0) is there");
}

TEST_CASE("ports: one that is not there, or is none, is bad", "[cli]") {
  const MadeUpMachine machine;
  fs::remove(machine.root() / "dev/ttyUSB0");
  CHECK(machine.only_finding().verdict == Verdict::kBad);
  CHECK(machine.only_finding().what == "/dev/lodesman/ahrs is not there");
  fs::remove(machine.root() / "dev/lodesman/ahrs");
  CHECK(machine.only_finding().what == "/dev/lodesman/ahrs is not there");
  machine.file("dev/lodesman/ahrs", "");
  CHECK(machine.only_finding().verdict == Verdict::kBad);
  CHECK(machine.only_finding().what == "/dev/lodesman/ahrs is no serial port");
  CHECK(machine.only_finding().remedy == "name one in devices.heading");
}

TEST_CASE("ports: one that this user may not open comes with the group to join", "[cli]") {
  PortsFacts facts;
  facts.ports.resize(1);
  PortFacts& port = facts.ports[0];
  port.named = {"heading", "nav440", "/dev/ttyUSB0"};
  port.node = "/dev/ttyUSB0";
  port.terminal = true;
  port.group = "dialout";
  Finding finding = judge_ports(facts).front();
  CHECK(finding.verdict == Verdict::kBad);
  CHECK(finding.remedy == "sudo usermod -aG dialout $USER; log in again");
  port.group = "root";  // which is no group to join
  finding = judge_ports(facts).front();
  CHECK(finding.verdict == Verdict::kBad);
  CHECK(finding.remedy.find("60-lodesman.rules") != std::string::npos);
}

TEST_CASE("ports: the group of one is found by its number", "[cli]") {
  const MadeUpMachine machine;
  const std::string own = std::to_string(getegid());
  machine.file("etc/group", "boat:x:" + own + ":\n");
  const auto facts = measure_ports({{"heading", "nav440", "/dev/ttyUSB0"}}, machine.root());
  CHECK(facts.ports.at(0).group == "boat");
  CHECK(facts.ports.at(0).usable);
}

TEST_CASE("ports: an FTDI chip that keeps what it receives is told of", "[cli]") {
  const MadeUpMachine machine;
  machine.file("sys/devices/usb1/1-1/1-1.0/ttyUSB0/latency_timer", "16\n");
  const Finding finding = machine.only_finding();
  CHECK(finding.verdict == Verdict::kWarn);
  CHECK(finding.what.ends_with("keeps what it receives for 16 ms"));
  CHECK(
      finding.remedy.starts_with("echo 1 | sudo tee /sys/class/tty/ttyUSB0/device/latency_timer"));
}

TEST_CASE("ports: ModemManager is a danger where udev has not marked the port", "[cli]") {
  const MadeUpMachine machine;
  machine.file("usr/sbin/ModemManager", "");
  CHECK(machine.only_finding().verdict == Verdict::kWarn);
  CHECK(machine.only_finding().what.find("ModemManager") != std::string::npos);
  machine.file("run/udev/data/c188:0", "S:lodesman/ahrs\nE:ID_MM_DEVICE_IGNORE=1\n");
  CHECK(machine.only_finding().verdict == Verdict::kOk);
  machine.file("run/udev/data/c188:0", "E:ID_MM_DEVICE_IGNORE=0\n");
  CHECK(machine.only_finding().verdict == Verdict::kWarn);
}

TEST_CASE("ports: brltty is a danger with its rules alone", "[cli]") {
  const MadeUpMachine machine;
  machine.file("usr/bin/brltty", "");
  CHECK(machine.only_finding().verdict == Verdict::kOk);
  machine.file("usr/lib/udev/rules.d/85-brltty.rules", "");
  CHECK(machine.only_finding().remedy == "sudo apt-get remove brltty");
}

// U5: gpsd is handed some adapters at plug-in, and probes them.
TEST_CASE("ports: what is handed to gpsd is told of, and what gpsd is told to open", "[cli]") {
  const MadeUpMachine machine;
  machine.file("usr/sbin/gpsd", "");
  machine.file("etc/default/gpsd", "# settings\nDEVICES=\"\"\nUSBAUTO=\"true\"\n");
  CHECK(machine.only_finding().verdict == Verdict::kOk);
  machine.file("run/udev/data/c188:0", "E:SYSTEMD_WANTS=gpsdctl@ttyUSB0.service\n");
  CHECK(machine.only_finding().verdict == Verdict::kWarn);
  CHECK(machine.only_finding().what.ends_with("is handed to gpsd at plug-in"));
  machine.file("etc/default/gpsd", "DEVICES=\"\"\nUSBAUTO=\"false\"\n");
  CHECK(machine.only_finding().verdict == Verdict::kOk);
  machine.file("etc/default/gpsd", "DEVICES=\"/dev/ttyS0 /dev/ttyUSB0\"\nUSBAUTO=\"false\"\n");
  CHECK(machine.only_finding().verdict == Verdict::kBad);
  CHECK(machine.only_finding().what.ends_with("is one of gpsd's DEVICES"));
}

TEST_CASE("ports: who holds one is named, the boat itself without reproach", "[cli]") {
  const MadeUpMachine machine;
  machine.add_process("812", "minicom", "/dev/ttyUSB0");
  machine.add_process("813", "cat", "/dev/ttyUSB1");
  CHECK(machine.only_finding().verdict == Verdict::kBad);
  CHECK(machine.only_finding().what.ends_with("is held by minicom (812)"));
  CHECK(machine.only_finding().remedy == "sudo kill 812");
  fs::remove_all(machine.root() / "proc/812");
  machine.add_process("900", "lodesman-low", "/dev/ttyUSB0");
  CHECK(machine.only_finding().verdict == Verdict::kInfo);
}

TEST_CASE("ports: two drivers on one are bad, one driver for two devices is not", "[cli]") {
  const MadeUpMachine machine;
  auto findings =
      machine.findings({"nav440:/dev/lodesman/ahrs", "sim:", "none", "maestro:/dev/ttyUSB0"});
  REQUIRE(findings.size() == 4);
  CHECK(findings[2].name == "thrusters");
  CHECK(findings[2].verdict == Verdict::kBad);
  CHECK(findings[2].what == "/dev/ttyUSB0 is also devices.heading");
  findings = machine.findings({"nav440:/dev/lodesman/ahrs", "sim:", "nav440:/dev/ttyUSB0", "none"});
  CHECK_FALSE(any_bad(findings));
}

TEST_CASE("ports: the machine's own are listed, and who may take them", "[cli]") {
  const MadeUpMachine machine;
  const DeviceAddresses none{"sim:", "sim:", "sim:", "sim:"};
  REQUIRE(machine.findings(none).size() == 1);
  CHECK(machine.findings(none)[0].what == "/dev/ttyUSB0");
  CHECK(machine.findings(none)[0].remedy.empty());
  machine.file("usr/sbin/ModemManager", "");
  CHECK(machine.findings(none)[0].what.ends_with("at plug-in by ModemManager"));
  machine.file("etc/udev/rules.d/60-lodesman.rules", "");
  CHECK(machine.findings(none)[0].what == "/dev/ttyUSB0");
  const TemporaryDirectory empty;
  const auto findings = judge_ports(measure_ports({}, empty.path()));
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].verdict == Verdict::kInfo);
}

// As udev(7) has it: KEY or KEY{name}, an operator, a value in quotes; GOTO needs its LABEL. What a
// device's parents are not is no condition: of a tty some parent is always something else.
TEST_CASE("ports: the rules for udev are well formed", "[cli]") {
  const std::regex token{
      R"re((ACTION|SUBSYSTEMS?|DRIVER|GROUP|MODE|SYMLINK|GOTO|LABEL|(ATTRS?|ENV|IMPORT)\{\w+\}))re"
      R"re((==|!=|\+=|=)"[^"]*")re"};
  const std::regex unlike_parents{R"re((SUBSYSTEMS|DRIVERS|KERNELS|ATTRS\{\w+\})!=)re"};
  std::ifstream rules{LODESMAN_UDEV_RULES};
  std::string line;
  std::set<std::string> wanted;
  std::set<std::string> labels;
  int lines = 0;
  while (std::getline(rules, line)) {
    if (line.empty() || line.starts_with("#")) {
      continue;
    }
    ++lines;
    CHECK_FALSE(std::regex_search(line, unlike_parents));
    std::string rest = line;
    for (std::smatch match; !rest.empty();) {
      INFO(line);
      REQUIRE(std::regex_search(rest, match, token, std::regex_constants::match_continuous));
      const std::string found = match.str();
      if (found.starts_with("GOTO")) {
        wanted.insert(found.substr(found.find('"')));
      } else if (found.starts_with("LABEL")) {
        labels.insert(found.substr(found.find('"')));
      }
      rest = match.suffix();
      if (!rest.empty()) {
        REQUIRE(rest.starts_with(", "));
        rest.erase(0, 2);
      }
    }
  }
  CHECK(lines > 8);
  CHECK(wanted == labels);
}

}  // namespace
}  // namespace lodesman::testing
