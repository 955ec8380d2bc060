// SPDX-License-Identifier: Apache-2.0
// HTTP: who is answered what, and that nothing that is said does any harm.
#include <random>
#include <thread>

#include "tests/support/catch.h"
#include "tests/unit/console/served_console.h"

using namespace lodesman;
using namespace lodesman::testing;
using std::chrono::milliseconds;

TEST_CASE("console server: the page comes with headers that keep it to itself", "[console]") {
  const ServedConsole console;
  RawViewer viewer{console.port()};
  const RawReply page = viewer.ask("GET", "/");
  CHECK(page.status == 200);
  CHECK(page.body.find("<title>page") != std::string::npos);
  CHECK(page.header("Content-Security-Policy").find("default-src 'none'") == 0);
  CHECK(page.header("X-Content-Type-Options") == "nosniff");
  CHECK(page.header("Referrer-Policy") == "no-referrer");
  CHECK(page.header("Cache-Control") == "no-cache");
  // The same connection goes on.
  CHECK(viewer.ask("GET", "/nothing.js").status == 404);
  CHECK(viewer.ask("GET", "/../secret.txt").status == 404);
  CHECK(viewer.ask("GET", "/%2e%2e/secret.txt").status == 404);
  CHECK(viewer.ask("PUT", "/").status == 405);
  CHECK(viewer.ask("GET", "/session").body.find(R"("scope":null)") != std::string::npos);
}

TEST_CASE("console server: a host or an origin of another name is refused", "[console]") {
  const ServedConsole console;
  RawViewer viewer{console.port()};
  const std::string own = viewer.host;
  CHECK(viewer.ask("GET", "/", "Origin: http://" + own + "\r\n").status == 200);
  CHECK(viewer.ask("GET", "/", "Origin: http://evil.example\r\n").status == 403);
  CHECK(viewer
            .ask("POST", "/session", "Origin: null\r\n",
                 R"({"token":")" + console.tokens.command + "\"}")
            .status == 403);
  viewer.host = "evil.example";
  CHECK(viewer.ask("GET", "/").status == 421);
  viewer.host = "localhost:1";
  CHECK(viewer.ask("GET", "/").status == 200);
  const std::string cookie = console.signed_in(console.tokens.command);
  RawViewer other{console.port()};
  CHECK(other.upgrade("/", cookie + "Origin: http://evil.example\r\n").status == 403);
}

TEST_CASE("console server: a token signs in for what it is good for, and out again", "[console]") {
  const ServedConsole console;
  const std::pair<std::string, std::string> rows[] = {
      {console.tokens.command, "command"}, {console.tokens.abort, "abort"},
      {console.tokens.view, "view"},       {console.run_tokens.command, "command"},
      {console.run_tokens.view, "view"},   {console.one_time_token, "command"}};
  for (const auto& [token, scope] : rows) {
    const std::string cookie = console.signed_in(token);
    RawViewer viewer{console.port()};
    CHECK(viewer.ask("GET", "/session", cookie).body.find("\"" + scope + "\"") !=
          std::string::npos);
    CHECK(viewer.ask("DELETE", "/session", cookie).status == 204);
    CHECK(viewer.ask("GET", "/session", cookie).body.find("null") != std::string::npos);
  }
  RawViewer viewer{console.port()};
  const std::string once = R"({"token":")" + console.one_time_token + "\"}";
  CHECK(viewer.ask("POST", "/session", "", once).status == 403);
  const RawReply reply =
      viewer.ask("POST", "/session", "", R"({"token":")" + console.tokens.view + "\"}");
  const std::string cookie = reply.header("Set-Cookie");
  for (const char* part : {"lodesman_console=", "HttpOnly", "SameSite=Strict", "Path=/"}) {
    CHECK(cookie.find(part) != std::string::npos);
  }
}

TEST_CASE("console server: a form's post and wrong tokens sign nobody in, and have to wait",
          "[console]") {
  const ServedConsole console;
  RawViewer viewer{console.port()};
  const std::string right = R"({"token":")" + console.tokens.command + "\"}";
  viewer.say("POST /session HTTP/1.1\r\nHost: " + viewer.host +
             "\r\nContent-Type: text/plain\r\nContent-Length: " + std::to_string(right.size()) +
             "\r\n\r\n" + right);
  CHECK(viewer.hear_reply().status == 415);
  for (const char* body : {"{}", "[]", "x", R"({"token":7})"}) {
    CHECK(viewer.ask("POST", "/session", "", body).status == 400);
  }
  int waits = 0;
  for (int i = 0; i < 8; ++i) {
    const RawReply reply = viewer.ask("POST", "/session", "", R"({"token":"wrong"})");
    CHECK((reply.status == 403 || reply.status == 429));
    waits += reply.status == 429 && !reply.header("Retry-After").empty() ? 1 : 0;
  }
  CHECK(waits == 3);
  CHECK(viewer.ask("POST", "/session", "", right).status == 204);
}

TEST_CASE("console server: too long a header or body, and what is no request, end the connection",
          "[console]") {
  const ServedConsole console;
  const auto status_of = [&](const std::string& bytes) {
    RawViewer viewer{console.port()};
    viewer.say(bytes);
    return viewer.hear_reply().status;
  };
  CHECK(status_of("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20000, 'x') +
                  "\r\n\r\n") == 431);
  CHECK(status_of("POST /session HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                  "Content-Length: 70000\r\n\r\n" +
                  std::string(70000, 'x')) == 413);
  CHECK(status_of("nonsense\r\n\r\n") == 400);
  RawViewer after{console.port()};
  CHECK(after.ask("GET", "/").status == 200);
}

TEST_CASE("console server: a header that comes slowly, or never, ends its connection",
          "[console]") {
  const ServedConsole console{std::chrono::seconds{10}, milliseconds{300}};
  RawViewer silent{console.port()};
  RawViewer slow{console.port()};
  slow.say("GET / HTTP/1.1\r\nHost: loc");
  CHECK(silent.is_ended());
  CHECK(slow.is_ended());
  RawViewer after{console.port()};
  CHECK(after.ask("GET", "/").status == 200);
}

TEST_CASE("console server: a thousand bad requests crash nothing", "[console]") {
  const ServedConsole console;
  std::mt19937 chance{11};  // NOLINT: the same each time
  const std::string good =
      "POST /session HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Content-Length: 16\r\n\r\n{\"token\":\"wrong\"";
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 1 + i % 7; ++k) {
      bytes[chance() % bytes.size()] = static_cast<char>(chance());
    }
    bytes.resize(1 + chance() % bytes.size());
    RawViewer viewer{console.port()};
    viewer.say(bytes);
  }
  RawViewer after{console.port()};
  CHECK(after.ask("GET", "/").status == 200);
  CHECK(console.told_but_status() == 0);
}

TEST_CASE("console server: more connections than there are places leave room for the next",
          "[console]") {
  const ServedConsole console;
  std::vector<RawViewer> crowd;
  for (int i = 0; i < 300; ++i) {
    crowd.emplace_back(console.port());
  }
  RawViewer after{console.port()};
  CHECK(after.ask("GET", "/").status == 200);
}
