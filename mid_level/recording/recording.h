// SPDX-License-Identifier: Apache-2.0
// One file of a recording: every publication under `raw/<channel>` as it was in memory, gaps under
// `recorder/gaps`, what viewers draw of them, and what belongs to them (configuration, versions,
// mission) as attachments and metadata. Times in it are the boat's: log and publication time are
// both the publication's stamp. One thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mid_level/recording/board_tap.h"
#include "mid_level/recording/mcap_viewer_sink.h"
#include "mid_level/recording/mcap_writer.h"
#include "mid_level/recording/viewer_channels.h"

namespace lodesman {

inline constexpr const char* kRawEncoding = "lodesman.raw";           // of messages
inline constexpr const char* kRawSchemaEncoding = "lodesman.layout";  // of raw_layout()
inline constexpr const char* kRawTopics = "raw/";
inline constexpr const char* kGapsTopic = "recorder/gaps";
inline constexpr const char* kAboutRecord = "lodesman";  // the metadata record of the file

struct RecordingNotes {
  std::string library;                             // which program, of which version
  std::map<std::string, std::string> about;        // versions, boat, segment
  std::map<std::string, std::string> attachments;  // by file name: their text
};

class Recording {
 public:
  Recording(std::unique_ptr<RecordFile> file, const RecordingNotes& notes, Time now);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  void add(const Publication& publication, std::span<const std::byte> raw);
  // What stands in a file before this one too: it is not lost with this one.
  void add_again(const Publication& publication, std::span<const std::byte> raw);
  void add(const Gap& gap, Time at);
  // Until then what was added may be lost with this program.
  void close_chunk();
  // And until then with the machine's power.
  void sync();
  // Closes the file and gives it its name. 0, or the number of the error that kept it from that.
  [[nodiscard]] int finish();

  // 0, or the number of the first error; from then on it takes nothing.
  [[nodiscard]] int fault() const noexcept { return writer_.fault(); }
  // After a fault, and finish(): what was added since the last chunk that was written, or where a
  // sync has failed since the last one that did not; and gaps told since then.
  [[nodiscard]] std::vector<Gap> lost() const;
  [[nodiscard]] std::vector<Gap> untold_gaps() const;
  [[nodiscard]] std::uint64_t size_bytes() const noexcept {
    return writer_.size_bytes() + writer_.waiting_bytes();
  }

 private:
  // Of one channel's numbers.
  struct Span {
    std::uint64_t first = 0;  // 0: nothing
    std::uint64_t last = 0;
    void take_in(const Span& later) noexcept;
  };

  void add_channels();
  void add_attachments(const RecordingNotes& notes, Time now);
  void write(const Publication& publication, std::span<const std::byte> raw);
  void see_what_is_written();
  void forget_what_is_synced();

  std::unique_ptr<RecordFile> file_;
  McapWriter writer_;
  McapViewerSink viewer_sink_{writer_};
  std::unique_ptr<ViewerChannels> viewers_;
  std::vector<std::string> names_;
  std::vector<std::uint16_t> raw_ids_;
  std::uint16_t gaps_id_ = 0;
  std::uint32_t gap_count_ = 0;
  std::vector<Span> waiting_;   // by channel: for their chunk to be written
  std::vector<Span> unsynced_;  // by channel: written
  std::vector<Gap> waiting_gaps_;
  std::vector<Gap> unsynced_gaps_;
  std::size_t chunks_seen_ = 0;
};

}  // namespace lodesman
