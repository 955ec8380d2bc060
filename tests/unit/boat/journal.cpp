// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/journal.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cstdlib>

#include "tests/unit/boat/unix_listener.h"

namespace lodesman::testing {
namespace {

TEST_CASE("journal: an entry is to the byte as the protocol has it", "[boat]") {
  using namespace std::string_literals;
  const std::array fields{JournalField{"MESSAGE", "two\nlines"}, JournalField{"PRIORITY", "4"}};
  CHECK(journal_entry(fields) ==
        "MESSAGE\n\x09\0\0\0\0\0\0\0two\nlines\nPRIORITY\n\x01\0\0\0\0\0\0\0"
        "4\n"s);
}

TEST_CASE("journal: what an address holds cannot make a field of its own", "[boat]") {
  const UnixListener listener;
  const std::array fields{JournalField{"LODESMAN_ADDRESS", "a\n_UID=0\n"}};
  REQUIRE(send_to_journal(fields, listener.path().c_str()));
  CHECK(listener.hear() == journal_entry(fields));
  CHECK(journal_entry(fields).find('\n') == std::string_view{"LODESMAN_ADDRESS"}.size());
}

TEST_CASE("journal: one that is stuck or gone costs lines and never a moment", "[boat]") {
  const std::array fields{JournalField{"MESSAGE", "a"}};
  {
    const UnixListener listener;  // nobody reads: its queue fills, and each call still returns
    int sent = 0;
    while (send_to_journal(fields, listener.path().c_str())) {
      ++sent;
    }
    CHECK(sent > 0);
    CHECK(listener.hear() == journal_entry(fields));
  }
  CHECK_FALSE(send_to_journal(fields, "/nowhere/socket"));
  CHECK_FALSE(send_to_journal(fields, std::string(200, 'x').c_str()));
}

TEST_CASE("journal: a stream leads to it that is the one the service manager named", "[boat]") {
  const int stream = open("/dev/null", O_WRONLY | O_CLOEXEC);
  struct stat status {};
  REQUIRE(fstat(stream, &status) == 0);
  const std::string device = std::to_string(status.st_dev);
  unsetenv("JOURNAL_STREAM");
  CHECK_FALSE(leads_to_the_journal(stream));
  setenv("JOURNAL_STREAM", (device + ":" + std::to_string(status.st_ino)).c_str(), 1);
  CHECK(leads_to_the_journal(stream));
  setenv("JOURNAL_STREAM", (device + ":" + std::to_string(status.st_ino + 1)).c_str(), 1);
  CHECK_FALSE(leads_to_the_journal(stream));
  unsetenv("JOURNAL_STREAM");
  close(stream);
}

}  // namespace
}  // namespace lodesman::testing
