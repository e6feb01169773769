#include "render/theme.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "sim/core/error.h"

namespace curlew {

float srgb_to_linear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

float linear_to_srgb(float c) { return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }

namespace {

// From the notation of web pages, 0xrrggbb in sRGB.
Colour web(std::uint32_t rgb) {
  const auto channel = [&](unsigned shift) { return srgb_to_linear(static_cast<float>(rgb >> shift & 0xffu) / 255.f); };
  return {channel(16), channel(8), channel(0)};
}

Theme light_theme() {
  Theme t;
  t.key = {0.78f, 0.75f, 0.70f};
  t.sky = {0.43f, 0.48f, 0.54f};
  t.ground = {0.25f, 0.25f, 0.26f};
  t.key_in_shadow = 0.10f;
  t.reflections = 0.75f;
  t.occlusion = 1.0f;
  t.background_top = web(0xb7c4d0);
  t.background_bottom = web(0xe9ecee);
  t.floor = web(0xcbcfd3);
  t.grid = web(0x89949c);
  t.grid_strength = 0.55f;
  t.body = web(0xd2c1a8);
  t.line = web(0x33424f);
  t.line_opacity = 0.55f;
  t.wall_opacity = 0.05f;
  t.water = web(0x2f86c6);
  t.sky_zenith = {0.16f, 0.36f, 0.70f};
  t.sky_horizon = {1.15f, 1.2f, 1.25f};
  t.deep_water = web(0x0a4f70);
  t.absorption = {14.f, 4.6f, 2.6f};
  t.ink = web(0x1d2830);
  t.paper = web(0xf4f6f7);
  return t;
}

Theme dark_theme() {
  Theme t;
  t.key = {1.00f, 0.95f, 0.88f};
  t.sky = {0.36f, 0.44f, 0.56f};
  t.ground = {0.15f, 0.16f, 0.19f};
  t.key_in_shadow = 0.06f;
  t.reflections = 0.8f;
  t.occlusion = 0.9f;
  t.background_top = web(0x0b0f16);
  t.background_bottom = web(0x222b36);
  t.floor = web(0x3a444f);
  t.grid = web(0x77889a);
  t.grid_strength = 0.5f;
  t.body = web(0x9d9488);
  t.line = web(0xb9cbdc);
  t.line_opacity = 0.5f;
  t.wall_opacity = 0.05f;
  t.water = web(0x3a96d8);
  t.sky_zenith = {0.10f, 0.22f, 0.48f};
  t.sky_horizon = {0.85f, 0.95f, 1.05f};
  t.deep_water = web(0x0b4a70);
  t.absorption = {10.f, 3.2f, 1.8f};
  t.ink = web(0xe8eef3);
  t.paper = web(0x11161d);
  return t;
}

}  // namespace

const Theme& theme_named(std::string_view name) {
  static const Theme light = light_theme(), dark = dark_theme();
  if (name == "light") return light;
  if (name == "dark") return dark;
  throw InputError("look.background is \"" + std::string(name) + "\", expected \"light\" or \"dark\"");
}

}  // namespace curlew
