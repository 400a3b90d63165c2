#pragma once
#include <detent/recording.h>
#include <stdio.h>

/// A recorder's sink that writes to a file. Without a path the sink is empty and nothing is recorded.
class RecordingFile {
 public:
  explicit RecordingFile(const char* path) : file_(path != nullptr ? fopen(path, "wb") : nullptr) {}
  ~RecordingFile() { static_cast<void>(close()); }
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  bool is_open() const { return file_ != nullptr; }
  detent::Sink sink() { return is_open() ? detent::Sink{write, file_} : detent::Sink{}; }
  uint8_t* buffer() { return buffer_; }
  /// False if some of the written bytes did not reach the file.
  bool close() {
    const bool written = file_ == nullptr || fclose(file_) == 0;
    file_ = nullptr;
    return written;
  }

 private:
  static detent::Status write(void* file, const uint8_t* bytes, uint32_t count) {
    return fwrite(bytes, 1, count, static_cast<FILE*>(file)) == count ? detent::Status::ok
                                                                      : detent::Status::sink_failed;
  }

  FILE* file_;
  uint8_t buffer_[detent::k_recording_buffer_bytes];
};
