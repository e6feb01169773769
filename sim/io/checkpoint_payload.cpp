#include "sim/io/checkpoint_payload.h"

#include <zstd.h>

#include <new>
#include <stdexcept>

#include "sim/io/checkpoint_format.h"

namespace curlew {

using namespace checkpoint_format;

namespace {

struct ZstdDeleter {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

void check(std::size_t zstd_result) {
  if (ZSTD_isError(zstd_result)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(zstd_result));
}

}  // namespace

// The fields as one zstd frame. Level 1: floats of a flow hold little to find, higher levels cost time for a few
// percent.
std::vector<std::byte> compress_kept_fields(const Fields& fields) {
  const std::unique_ptr<ZSTD_CCtx, ZstdDeleter> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  std::uint64_t raw_bytes = 0;
  for_each_kept_field(fields,
                      [&](const FieldRow&, const auto& array) { raw_bytes += std::as_bytes(std::span(array)).size(); });
  // Floats of a flow hold little to find: higher levels cost time for a few percent.
  check(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 1));
  check(ZSTD_CCtx_setPledgedSrcSize(context.get(), raw_bytes));  // puts the size into the frame, for the reader

  std::vector<std::byte> frame;
  const auto feed = [&](std::span<const std::byte> bytes, ZSTD_EndDirective directive) {
    ZSTD_inBuffer in = {bytes.data(), bytes.size(), 0};
    for (std::size_t left = 1; in.pos < in.size || (directive == ZSTD_e_end && left != 0);) {
      const std::size_t before = frame.size();
      frame.resize(before + ZSTD_CStreamOutSize());
      ZSTD_outBuffer out = {frame.data() + before, frame.size() - before, 0};
      left = ZSTD_compressStream2(context.get(), &out, &in, directive);
      check(left);
      frame.resize(before + out.pos);
    }
  };
  for_each_kept_field(
      fields, [&](const FieldRow&, const auto& array) { feed(std::as_bytes(std::span(array)), ZSTD_e_continue); });
  feed({}, ZSTD_e_end);
  return frame;
}

// A frame says how much it holds. No block of zstd (128 KiB at most) takes less than four bytes, so a small file that
// claims to hold a thousand gigabytes is found out before memory is taken.
PayloadReader::PayloadReader(std::span<const std::byte> frame, std::uint64_t raw_bytes, const std::string& name)
    : context_(ZSTD_createDCtx()), frame_(frame), name_(name) {
  const unsigned long long declared = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (declared != raw_bytes) {
    throw damaged(name, "its data do not hold the " + std::to_string(raw_bytes) + " bytes of its fields");
  }
  if (raw_bytes / (std::uint64_t{32} << 10) > frame.size()) {
    throw damaged(name, std::to_string(frame.size()) + " bytes of data cannot hold the " + std::to_string(raw_bytes) +
                            " bytes of its fields");
  }
  if (!context_) throw std::bad_alloc();
}

void PayloadReader::Deleter::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

void PayloadReader::read(std::span<std::byte> bytes) {
  while (!bytes.empty()) bytes = bytes.subspan(advance(bytes));
}

bool PayloadReader::ends() {
  std::byte spare;
  while (!done_) {
    if (advance({&spare, 1}) != 0) return false;
  }
  return taken_ == frame_.size();
}

// Decompresses a bit more and returns how many bytes came out. Throws where nothing moves any more.
std::size_t PayloadReader::advance(std::span<std::byte> bytes) {
  if (done_) throw damaged(name_, "its data end too early");
  ZSTD_inBuffer in = {frame_.data(), frame_.size(), taken_};
  ZSTD_outBuffer out = {bytes.data(), bytes.size(), 0};
  const std::size_t result = ZSTD_decompressStream(context_.get(), &out, &in);
  if (ZSTD_isError(result)) {
    throw damaged(name_, std::string("its data cannot be decompressed (") + ZSTD_getErrorName(result) + ")");
  }
  done_ = result == 0;
  if (!done_ && in.pos == taken_ && out.pos == 0) throw damaged(name_, "its data end too early");
  taken_ = in.pos;
  return out.pos;
}

}  // namespace curlew
