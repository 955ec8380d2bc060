// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/journal.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace lodesman {
namespace {

constexpr unsigned kBitsAByte = 8;

// Little end first, as the protocol has it.
void append_length(std::string& entry, std::uint64_t length) {
  for (std::size_t i = 0; i < sizeof length; ++i) {
    entry += static_cast<char>(static_cast<unsigned char>(length >> (kBitsAByte * i)));
  }
}

}  // namespace

bool leads_to_the_journal(int descriptor) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody writes it
  const char* named = std::getenv("JOURNAL_STREAM");
  struct stat stream {};
  return named != nullptr && fstat(descriptor, &stream) == 0 &&
         named == std::to_string(stream.st_dev) + ":" + std::to_string(stream.st_ino);
}

std::string journal_entry(std::span<const JournalField> fields) {
  std::string entry;
  for (const JournalField& field : fields) {
    entry += field.name;
    entry += '\n';
    append_length(entry, field.value.size());
    entry += field.value;
    entry += '\n';
  }
  return entry;
}

bool send_to_journal(std::span<const JournalField> fields, const char* socket_path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (std::strlen(socket_path) >= sizeof address.sun_path) {
    return false;
  }
  std::strncpy(address.sun_path, socket_path, sizeof address.sun_path - 1);
  const int socket_file = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_file < 0) {
    return false;
  }
  const std::string entry = journal_entry(fields);
  // The interface of sockets: an address of one kind is handed in as one of any.
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  const bool sent = sendto(socket_file, entry.data(), entry.size(), MSG_NOSIGNAL, any,
                           sizeof address) == static_cast<ssize_t>(entry.size());
  close(socket_file);
  return sent;
}

}  // namespace lodesman
