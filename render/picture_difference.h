// How far two pictures are apart, by what differs and by what the eye sees of it.
//
// SSIM: Wang et al., Image quality assessment: from error visibility to structural similarity, 2004; on luma, in
// windows of 8 x 8 pixels, every 4 pixels.
#pragma once

#include "render/image.h"

namespace curlew {

struct PictureDifference {
  double share = 0;  // of pixels of which a channel differs by more than `channel`
  double mean = 0;   // absolute, over all channels, of 255
  int largest = 0;   // of any channel
  double ssim = 1;   // 1 for equal pictures
  bool same_size = true;
};

PictureDifference picture_difference(const Image& a, const Image& b, int channel);

// What is allowed; pictures of another size never are.
struct PictureTolerance {
  int channel = 0;
  double share = 0, mean = 0, ssim = 1;

  bool accepts(const PictureDifference& d) const {
    return d.same_size && d.share <= share && d.mean <= mean && d.ssim >= ssim;
  }
};

// Grey where equal, brighter where not, so many times as strong. Of pictures of different sizes, the first.
Image difference_picture(const Image& a, const Image& b, int times);

}  // namespace curlew
