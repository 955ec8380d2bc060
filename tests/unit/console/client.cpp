// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/client.h"

#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::console;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr Time kNow{seconds{100}};

// Keeps what it was asked, until it is told the answer.
class FakePort final : public CommandPort {
 public:
  struct Asked {
    std::string request;
    Done done;
  };
  explicit FakePort(std::vector<Asked>& asked) : asked_{asked} {}
  void ask(const std::string& request, Done done) override {
    asked_.push_back({request, std::move(done)});
  }

 private:
  std::vector<Asked>& asked_;
};

struct Viewer {
  explicit Viewer(const ClientRights& rights = {Scope::kCommand, 1, true})
      : client{1, rights, topics, pulse} {
    client.set_ports(std::make_unique<FakePort>(asked), std::make_unique<FakePort>(urgent));
    topics.set_published([this](std::uint16_t topic, const std::string& part,
                                const MessagePtr& message) { client.offer(topic, part, message); });
  }

  void subscribe(unsigned id, unsigned channel) {
    client.hear(true,
                R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) +
                    R"(,"channelId":)" + std::to_string(channel) + "}]}",
                kNow);
  }
  void call(const std::string& payload, Time now = kNow, std::uint32_t service = 1) {
    using namespace std::string_literals;
    client.hear(false,
                "\x02"s + static_cast<char>(service) + "\0\0\0\x07\0\0\0\x04\0\0\0json"s + payload,
                now);
  }
  // All that waits, without heads.
  [[nodiscard]] std::vector<std::string> all() {
    std::vector<std::string> frames;
    while (const auto frame = client.take()) {
      frames.push_back(frame->body ? frame->body->json : frame->head);
    }
    return frames;
  }

  TopicTable topics;
  Pulse pulse;
  std::uint16_t boat = topics.add_topic("/boat", viewer::log_entry());
  std::uint16_t scene = topics.add_topic("/scene", viewer::log_entry());
  std::vector<FakePort::Asked> asked;
  std::vector<FakePort::Asked> urgent;
  Client client;
};

[[nodiscard]] bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("console client: who begins to listen has the newest at once", "[console]") {
  Viewer viewer;
  viewer.topics.publish(viewer.scene, "hull", kNow, "hull");
  viewer.topics.publish(viewer.scene, "goal", kNow, "old goal");
  viewer.topics.publish(viewer.scene, "goal", kNow, "goal");
  viewer.subscribe(9, 2);
  CHECK(viewer.all() == std::vector<std::string>{"hull", "goal"});
}

TEST_CASE("console client: of what waits newest wins, and no topic keeps another waiting",
          "[console]") {
  Viewer viewer;
  viewer.subscribe(1, 1);
  viewer.subscribe(2, 2);
  for (int i = 0; i < 100000; ++i) {
    viewer.topics.publish(viewer.boat, "", kNow, std::to_string(i));
    viewer.topics.publish(viewer.scene, "a", kNow, "a" + std::to_string(i));
    viewer.topics.publish(viewer.scene, "b", kNow, "b" + std::to_string(i));
  }
  CHECK(viewer.all() == std::vector<std::string>{"99999", "a99999", "b99999"});
}

TEST_CASE("console client: it hears no more of what it has left", "[console]") {
  Viewer viewer;
  viewer.subscribe(1, 1);
  CHECK(viewer.topics[viewer.boat].listeners == 1);
  viewer.client.hear(true, R"({"op":"unsubscribe","subscriptionIds":[1,2]})", kNow);
  CHECK(viewer.topics[viewer.boat].listeners == 0);
  viewer.topics.publish(viewer.boat, "", kNow, "x");
  CHECK(viewer.all().empty());
  viewer.subscribe(1, 77);
  viewer.subscribe(1, 0);
  CHECK(viewer.topics[viewer.boat].listeners == 0);
}

TEST_CASE(
    "console client: a command goes on without token and protocol, its answer comes as it was",
    "[console]") {
  Viewer viewer;
  std::vector<std::string> told;
  viewer.client.on_command = [&](const CommandNews& news) {
    told.push_back(news.who + " " + news.command);
  };
  viewer.call(R"({"command":"take","name":"Ann","token":"stolen","protocol":1})");
  REQUIRE(viewer.asked.size() == 1);
  CHECK(viewer.asked[0].request == R"({"command":"take","name":"Ann"})");
  viewer.asked[0].done({true, R"({"ok":true})"});
  const auto frames = viewer.all();
  REQUIRE(frames.size() == 1);
  CHECK(frames[0].ends_with(R"(json{"ok":true})"));
  CHECK(told == std::vector<std::string>{"Ann take"});
}

TEST_CASE("console client: what stops the boat waits behind nothing", "[console]") {
  Viewer viewer;
  viewer.call(R"({"command":"start"})");
  for (const char* word : {"abort", "estop", "disarm"}) {
    viewer.call(std::string{R"({"command":")"} + word + "\"}");
  }
  CHECK(viewer.asked.size() == 1);
  CHECK(viewer.urgent.size() == 3);
  viewer.call(R"({"command":"estop","release":true})");
  CHECK(viewer.asked.size() == 2);
}

TEST_CASE("console client: who looks on by a ticket commands nothing", "[console]") {
  Viewer viewer{{Scope::kView, 0, false}};
  viewer.call(R"({"command":"abort"})");
  CHECK(viewer.asked.empty());
  CHECK(viewer.urgent.empty());
  CHECK(contains(viewer.all().at(0), "serviceCallFailure"));
}

TEST_CASE("console client: fifty commands a second, and no more", "[console]") {
  Viewer viewer;
  for (int i = 0; i < 200; ++i) {
    viewer.call(R"({"command":"heartbeat"})");
    if (!viewer.asked.empty()) {
      viewer.asked.back().done({true, "{}"});
      viewer.asked.clear();
    }
    static_cast<void>(viewer.all());
  }
  int obeyed = 0;
  for (int i = 0; i < 1000 && !viewer.client.is_over(); ++i) {
    viewer.call(R"({"command":"heartbeat"})", kNow + seconds{1} + milliseconds{20 * i});
    if (!viewer.asked.empty()) {
      ++obeyed;
      viewer.asked.back().done({true, "{}"});
      viewer.asked.clear();
    }
    static_cast<void>(viewer.all());
  }
  CHECK_FALSE(viewer.client.is_over());
  CHECK(obeyed == 1000);  // fifty a second are let through
}

TEST_CASE("console client: what is no command is answered and asks nothing", "[console]") {
  Viewer viewer;
  const std::string deep = std::string(30000, '[') + std::string(30000, ']');
  for (const std::string& payload :
       {std::string{}, std::string{"[]"}, std::string{"{}"}, std::string{R"({"command":1})"},
        std::string{"\xff\xfe"}, deep, std::string{"{\"command\":"} + deep + "}"}) {
    viewer.call(payload);
  }
  viewer.call(R"({"command":"abort"})", kNow, 9);
  CHECK(viewer.asked.empty());
  CHECK(viewer.urgent.empty());
  CHECK(viewer.all().size() == 8);
  viewer.call("{\"command\":\"tune\",\"set\":" + deep + "}");
  CHECK(viewer.asked.size() == 1);
}

TEST_CASE("console client: who asks without end and takes nothing is at its end", "[console]") {
  Viewer viewer;
  Time now = kNow;
  int asked = 0;
  for (; asked < 100000 && !viewer.client.is_over(); ++asked) {
    now += milliseconds{20};
    viewer.client.hear(true, "nonsense", now);
  }
  CHECK(viewer.client.is_over());
  CHECK(asked <= static_cast<int>(Client::kMaxReplies) + 1);
}

TEST_CASE("console client: what was ordered while it was held up is refused, but for stops",
          "[console]") {
  Viewer viewer;
  const auto start = [&](Time now) { viewer.call(R"({"command":"start"})", now); };
  viewer.pulse.beat(kNow);
  start(kNow + milliseconds{900});
  CHECK(viewer.asked.size() == 1);
  start(kNow + seconds{5});  // read before the console's first step after it woke
  viewer.pulse.beat(kNow + seconds{5});
  start(kNow + seconds{5} + milliseconds{400});
  CHECK(viewer.asked.size() == 1);
  viewer.call(R"({"command":"abort"})", kNow + seconds{5} + milliseconds{400});
  CHECK(viewer.urgent.size() == 1);
  viewer.pulse.beat(kNow + seconds{5} + milliseconds{500});
  start(kNow + seconds{5} + milliseconds{600});
  CHECK(viewer.asked.size() == 2);
}
