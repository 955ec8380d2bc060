// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/http_rules.h"

#include "tests/support/catch.h"

using namespace lodesman::console;

TEST_CASE("console http: a Host is loopback's or one that is named, with any port", "[console]") {
  const std::vector<std::string> names{"boat.example", "192.0.2.1", "2001:db8::1"};
  for (const char* host : {"localhost", "localhost:8765", "127.0.0.1:1", "[::1]:8765", "[::1]",
                           "LOCALHOST:80", "localhost:", "boat.example", "Boat.Example:8765",
                           "192.0.2.1:8765", "[2001:db8::1]:8765"}) {
    INFO(host);
    CHECK(is_own_host(host, names));
  }
  for (const char* host : {"", ":8765", "evil.example", "localhost.evil.example", "localhost:80x",
                           "localhost:123456", "127.0.0.1.evil.example", "127.0.0.2", "[::1",
                           "boat.example.", "x@localhost", "[::1]x:80"}) {
    INFO(host);
    CHECK_FALSE(is_own_host(host, names));
  }
}

TEST_CASE("console http: an origin is its own where host and port are the same", "[console]") {
  CHECK(is_own_origin("http://localhost:8765", "localhost:8765"));
  CHECK(is_own_origin("https://boat.example", "boat.example"));
  CHECK_FALSE(is_own_origin("http://localhost:8766", "localhost:8765"));
  CHECK_FALSE(is_own_origin("http://localhost", "localhost:8765"));
  CHECK_FALSE(is_own_origin("null", "localhost:8765"));
  CHECK_FALSE(is_own_origin("", ""));
  CHECK_FALSE(is_own_origin("http://localhost:8765.evil.example", "localhost:8765"));
}

TEST_CASE("console http: a cookie is found among others", "[console]") {
  CHECK(cookie_value("a=1; lodesman_console=x; b=2", "lodesman_console") == "x");
  CHECK(cookie_value("lodesman_console=x", "lodesman_console") == "x");
  CHECK(cookie_value("xlodesman_console=x;lodesman_console=y ", "lodesman_console") == "y");
  CHECK(cookie_value("lodesman_console", "lodesman_console").empty());
  CHECK(cookie_value("", "lodesman_console").empty());
}

TEST_CASE("console http: a target is a file of the page's or nothing", "[console]") {
  CHECK(page_file("/") == "index.html");
  CHECK(page_file("/?a=b") == "index.html");
  CHECK(page_file("/console.js") == "console.js");
  CHECK(page_file("/lib/dygraph.min.js") == "lib/dygraph.min.js");
  for (const char* target :
       {"", "x", "/..", "/../x", "/a/../b", "/.hidden", "/a/.b", "//etc/passwd", "/a//b", "/a/",
        "/%2e%2e/x", "/a\\b", "http://x/", "*", "/a b"}) {
    INFO(target);
    CHECK(page_file(target).empty());
  }
  CHECK(page_file("/" + std::string(300, 'a')).empty());
}
