#include "zstandard.h"

#if DETENT_ZSTD
#include <string.h>
#include <zstd.h>

#include <algorithm>
#include <vector>
#endif

namespace detent_tool {

#if DETENT_ZSTD

namespace {

constexpr int k_level = 9;  // beyond this level recordings take longer and get no smaller

struct FreeDecoder {
  void operator()(ZSTD_DCtx* decoder) const { ZSTD_freeDCtx(decoder); }
};
struct FreeEncoder {
  void operator()(ZSTD_CCtx* encoder) const { ZSTD_freeCCtx(encoder); }
};

/// Decompresses only the requested bytes, so a hostile file can cost time, but not memory: the memory is one window, at
/// most the 128 MB of zstd's own limit. The bytes end where the file ends, even in the middle of a frame.
class PackedInput final : public Input {
 public:
  explicit PackedInput(File file)
      : file_(std::move(file)), decoder_(ZSTD_createDCtx()), packed_(ZSTD_DStreamInSize()) {}

  bool read(uint8_t* bytes, uint32_t count, uint32_t& got) override {
    ZSTD_outBuffer out = {bytes, count, 0};
    while (out.pos < out.size && !ended_) {
      if (in_.pos == in_.size) {
        in_ = {packed_.data(), fread(packed_.data(), 1, packed_.size(), file_.get()), 0};
        if (in_.size == 0 && ferror(file_.get()) != 0) return fail("cannot be read");
      }
      const size_t before = out.pos, used = in_.pos;
      const size_t result = ZSTD_decompressStream(decoder_.get(), &out, &in_);
      if (ZSTD_isError(result) != 0) return fail(std::string("zstd: ") + ZSTD_getErrorName(result));
      const bool moved = out.pos != before || in_.pos != used;
      if (moved) whole_ = result == 0;
      ended_ = !moved && in_.pos == in_.size && feof(file_.get()) != 0;
    }
    got = static_cast<uint32_t>(out.pos);
    at_ += got;
    return at_ <= bytes_max || fail("unpacks to more than " + std::to_string(bytes_max) + " bytes");
  }

  bool ends_whole() override {
    uint8_t more = 0;
    uint32_t got = 0;
    return read(&more, 1, got) && (whole_ || got != 0 || fail("truncated within the checksum of its compression"));
  }

  bool seek(uint64_t offset) override {
    if (offset < at_) {
      if (fseek(file_.get(), 0, SEEK_SET) != 0) return fail("cannot be read");
      ZSTD_DCtx_reset(decoder_.get(), ZSTD_reset_session_only);
      in_ = {};
      at_ = 0;
      ended_ = false;
    }
    uint8_t passed[4096];
    while (at_ < offset) {
      uint32_t got = 0;
      if (!read(passed, static_cast<uint32_t>(std::min<uint64_t>(sizeof passed, offset - at_)), got)) return false;
      if (got == 0) return true;
    }
    return true;
  }

 private:
  bool fail(const std::string& why) {
    problem = why;
    return false;
  }

  File file_;
  std::unique_ptr<ZSTD_DCtx, FreeDecoder> decoder_;
  std::vector<uint8_t> packed_;
  ZSTD_inBuffer in_ = {};
  uint64_t at_ = 0;  ///< decompressed bytes returned so far
  bool ended_ = false;
  bool whole_ = true;  ///< the bytes so far end with a whole frame
};

class PackedOutput final : public Output {
 public:
  explicit PackedOutput(File file)
      : file_(std::move(file)), encoder_(ZSTD_createCCtx()), packed_(ZSTD_CStreamOutSize()) {
    ZSTD_CCtx_setParameter(encoder_.get(), ZSTD_c_compressionLevel, k_level);
    ZSTD_CCtx_setParameter(encoder_.get(), ZSTD_c_checksumFlag, 1);
  }

  bool write(const uint8_t* bytes, uint32_t count) override { return pack({bytes, count, 0}, ZSTD_e_continue); }

 private:
  bool finish() override {
    const bool packed = pack({}, ZSTD_e_end);
    return fclose(file_.release()) == 0 && packed;
  }
  bool pack(ZSTD_inBuffer in, ZSTD_EndDirective directive) {
    for (;;) {
      ZSTD_outBuffer out = {packed_.data(), packed_.size(), 0};
      const size_t left = ZSTD_compressStream2(encoder_.get(), &out, &in, directive);
      file_bytes += out.pos;
      if (ZSTD_isError(left) != 0 || fwrite(packed_.data(), 1, out.pos, file_.get()) != out.pos) return false;
      if (directive == ZSTD_e_end ? left == 0 : in.pos == in.size) return true;
    }
  }

  File file_;
  std::unique_ptr<ZSTD_CCtx, FreeEncoder> encoder_;
  std::vector<uint8_t> packed_;
};

}  // namespace

std::unique_ptr<Input> unpack(File file, std::string&) {
  auto input = std::make_unique<PackedInput>(std::move(file));
  input->bytes_max = k_unpacked_bytes_max;
  input->snapshot_bytes_max = k_unpacked_snapshot_bytes_max;
  return input;
}

std::unique_ptr<Output> pack(File file, std::string&) { return std::make_unique<PackedOutput>(std::move(file)); }

#else

namespace {
constexpr const char* k_missing = "is compressed, and this tool was built without zstd";
}

std::unique_ptr<Input> unpack(File, std::string& problem) {
  problem = k_missing;
  return nullptr;
}

std::unique_ptr<Output> pack(File, std::string& problem) {
  problem = k_missing;
  return nullptr;
}

#endif

}  // namespace detent_tool
