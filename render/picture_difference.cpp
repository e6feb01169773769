#include "render/picture_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace curlew {
namespace {

double luma(const std::uint8_t* p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

// One window of SSIM.
double similarity(const Image& a, const Image& b, int left, int top, int size) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + size; ++y) {
    for (int x = left; x < left + size; ++x) {
      const double p = luma(a.at(x, y)), q = luma(b.at(x, y));
      sum_a += p, sum_b += q, aa += p * p, bb += q * q, ab += p * q;
    }
  }
  const double n = size * size, mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = aa / n - mean_a * mean_a, var_b = bb / n - mean_b * mean_b, cov = ab / n - mean_a * mean_b;
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  return (2 * mean_a * mean_b + c1) * (2 * cov + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

double mean_similarity(const Image& a, const Image& b) {
  constexpr int size = 8, step = 4;
  double sum = 0;
  int windows = 0;
  for (int y = 0; y + size <= a.height; y += step) {
    for (int x = 0; x + size <= a.width; x += step, ++windows) sum += similarity(a, b, x, y, size);
  }
  return windows > 0 ? sum / windows : 1;
}

}  // namespace

PictureDifference picture_difference(const Image& a, const Image& b, int channel) {
  PictureDifference d;
  d.same_size = a.width == b.width && a.height == b.height;
  if (!d.same_size) return {1, 255, 255, 0, false};
  std::size_t beyond = 0;
  double sum = 0;
  for (std::size_t pixel = 0; pixel < a.rgba.size(); pixel += 4) {
    int most = 0;
    for (std::size_t k = pixel; k < pixel + 3; ++k) {
      const int difference = std::abs(int{a.rgba[k]} - int{b.rgba[k]});
      sum += difference;
      most = std::max(most, difference);
    }
    d.largest = std::max(d.largest, most);
    beyond += most > channel;
  }
  const double pixels = static_cast<double>(a.rgba.size() / 4);
  d.share = static_cast<double>(beyond) / pixels;
  d.mean = sum / (3 * pixels);
  d.ssim = mean_similarity(a, b);
  return d;
}

Image difference_picture(const Image& a, const Image& b, int times) {
  Image image = a;
  if (a.width != b.width || a.height != b.height) return image;
  for (std::size_t k = 0; k < a.rgba.size(); ++k) {
    const int difference = std::abs(int{a.rgba[k]} - int{b.rgba[k]});
    image.rgba[k] = k % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::min(255, 64 + times * difference));
  }
  return image;
}

}  // namespace curlew
