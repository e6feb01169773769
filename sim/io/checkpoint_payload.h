// The values in a checkpoint: one zstd frame (RFC 8878) with the kept fields one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/core/fields.h"

struct ZSTD_DCtx_s;  // of zstd.h, which stays out of headers

namespace curlew {

std::vector<std::byte> compress_kept_fields(const Fields&);

// Decompresses a frame of any origin piece by piece; throws InputError beginning with `name` where it is damaged.
class PayloadReader {
 public:
  // Checks that the frame claims to hold `raw_bytes`, and that it can. Keeps references to `frame` and `name`.
  PayloadReader(std::span<const std::byte> frame, std::uint64_t raw_bytes, const std::string& name);

  // Fills all of `bytes`.
  void read(std::span<std::byte> bytes);

  // Whether the frame ends here, with nothing behind it.
  bool ends();

 private:
  struct Deleter {
    void operator()(ZSTD_DCtx_s* context) const;
  };

  std::size_t advance(std::span<std::byte> out);

  std::unique_ptr<ZSTD_DCtx_s, Deleter> context_;
  std::span<const std::byte> frame_;
  std::size_t taken_ = 0;  // bytes of the frame
  const std::string& name_;
  bool done_ = false;
};

}  // namespace curlew
