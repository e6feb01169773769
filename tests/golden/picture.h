// Pictures for the golden tests: read, compare, and show where two differ.
//
// SSIM: Wang et al., Image quality assessment: from error visibility to structural similarity, 2004; on luma, in
// windows of 8 x 8 pixels, every 4 pixels.
#pragma once

#include <string>

#include "render/image.h"

namespace curlew::test {

Image read_png(const std::string& file);

struct Difference {
  double share = 0;  // of pixels of which a channel differs by more than `channel`
  double mean = 0;   // absolute, over all channels, of 255
  int largest = 0;   // of any channel
  double ssim = 1;   // 1 for equal pictures
  bool same_size = true;
};

Difference difference(const Image& a, const Image& b, int channel);

// Grey where equal, brighter where not, four times as strong.
Image difference_picture(const Image& a, const Image& b);

}  // namespace curlew::test
