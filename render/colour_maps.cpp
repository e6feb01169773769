// The published maps are kept as 33 even nodes with straight lines between them: within 2/255 of the originals.
//
// viridis, magma: van der Walt & Smith 2015 (with Firing), matplotlib's colour maps, CC0.
// turbo: Mikhailov 2019, "Turbo, an improved rainbow colormap for visualization".
// coolwarm: Moreland 2009, "Diverging color maps for scientific visualization".
// water, grey: our own. water runs from the blue of deep water over turquoise to the white of foam, lighter all the
// way.
#include "render/colour_maps.h"

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "sim/core/error.h"

namespace curlew {
namespace {

using Table = std::array<Rgb, 256>;

constexpr std::array<std::uint32_t, 33> kViridis{
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b, 0x375a8d, 0x33638d,
    0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908c, 0x1f988b, 0x1f9f88, 0x21a685, 0x28ae80, 0x31b57b,
    0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c, 0x96d83f, 0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725};

constexpr std::array<std::uint32_t, 33> kMagma{
    0x000004, 0x030311, 0x0a0822, 0x130d33, 0x1d1146, 0x28115a, 0x36106a, 0x430f76, 0x50127c, 0x5d177f, 0x691c81,
    0x762181, 0x822681, 0x8f2a81, 0x9c2e7f, 0xa9327d, 0xb63779, 0xc33b75, 0xcf4170, 0xdb486a, 0xe65163, 0xee5c5e,
    0xf5695c, 0xf9785d, 0xfb8761, 0xfd9668, 0xfea571, 0xfeb47b, 0xfec387, 0xfed194, 0xfde0a2, 0xfceeb0, 0xfcfdbf};

constexpr std::array<std::uint32_t, 33> kTurbo{
    0x30123b, 0x392a73, 0x4040a1, 0x4456c7, 0x466be3, 0x467ff6, 0x4293ff, 0x37a7fa, 0x29bbec, 0x1dcdd8, 0x18dcc3,
    0x1ee8b0, 0x31f299, 0x4cf97e, 0x6bfd64, 0x8aff4d, 0xa3fd3c, 0xb8f735, 0xcced34, 0xdee037, 0xedd03a, 0xf8c03a,
    0xfdae35, 0xfe982c, 0xfb8022, 0xf56817, 0xec520f, 0xe04009, 0xd23105, 0xc02302, 0xac1701, 0x950d01, 0x7a0403};

constexpr std::array<std::uint32_t, 33> kCoolwarm{
    0x3b4cc0, 0x445acc, 0x4d68d7, 0x5775e1, 0x6282ea, 0x6c8ef1, 0x779af7, 0x82a5fb, 0x8db0fe, 0x98b9ff, 0xa3c2fe,
    0xaec9fc, 0xb8d0f9, 0xc2d5f4, 0xccd9ee, 0xd5dbe6, 0xdddddd, 0xe5d8d1, 0xecd3c5, 0xf1ccb9, 0xf4c4ad, 0xf7bba0,
    0xf7b194, 0xf7a687, 0xf49a7b, 0xf18d6f, 0xec7f63, 0xe57058, 0xde604d, 0xd55042, 0xcb3e38, 0xc0282f, 0xb40426};

constexpr std::array<std::uint32_t, 9> kWater{0x0d4c92, 0x1162ad, 0x1c7cc2, 0x3998d1, 0x62b3de,
                                              0x8ecce8, 0xb8e1f0, 0xdcf0f7, 0xf9fcfe};

constexpr std::array<std::uint32_t, 2> kGrey{0x1a1a1a, 0xf2f2f2};

double channel(std::uint32_t rgb, unsigned shift) { return static_cast<double>(rgb >> shift & 0xffu); }

Table table(std::span<const std::uint32_t> nodes) {
  Table all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double at = static_cast<double>(i) / 255 * static_cast<double>(nodes.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(at), nodes.size() - 2);
    const double f = at - static_cast<double>(k);
    const auto mixed = [&](unsigned shift) {
      return static_cast<std::uint8_t>(
          std::lround((1 - f) * channel(nodes[k], shift) + f * channel(nodes[k + 1], shift)));
    };
    all[i] = {mixed(16), mixed(8), mixed(0)};
  }
  return all;
}

struct Named {
  std::string_view name;
  Table table;
};

const std::array<Named, 6>& all_maps() {
  static const std::array<Named, 6> maps{{{"water", table(kWater)},
                                          {"viridis", table(kViridis)},
                                          {"magma", table(kMagma)},
                                          {"turbo", table(kTurbo)},
                                          {"coolwarm", table(kCoolwarm)},
                                          {"grey", table(kGrey)}}};
  return maps;
}

}  // namespace

const Table& colour_map(std::string_view name) {
  std::string known;
  for (const Named& map : all_maps()) {
    if (map.name == name) return map.table;
    known += (known.empty() ? "" : ", ") + std::string(map.name);
  }
  throw InputError("look.colour_map is \"" + std::string(name) + "\", expected one of " + known);
}

}  // namespace curlew
