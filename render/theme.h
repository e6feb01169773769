// The light and dark look: colours of everything that is not water. Colours are linear.
#pragma once

#include <array>
#include <string_view>

namespace curlew {

using Colour = std::array<float, 3>;

struct Theme {
  Colour key, sky, ground;  // light: the lamp's, from above, from below
  float key_in_shadow;      // part of the lamp's light that reaches full shadow
  float reflections;        // strength, 0..1
  float occlusion;          // strength of the ambient occlusion, 0..1
  Colour background_top, background_bottom;
  Colour floor, grid;
  float grid_strength;
  Colour body;
  Colour line;  // edges of the walls
  float line_opacity, wall_opacity;
  Colour water;                    // where particles are not coloured by a value
  Colour sky_zenith, sky_horizon;  // in the mirror of clear water
  Colour deep_water;               // what deep clear water gives back
  Colour absorption;  // what clear water takes of red, green, blue on its way through a domain's diagonal, as exp(-a)
  Colour ink, paper;  // text, and the halo around it
};

// "light" or "dark"; throws InputError for another name.
const Theme& theme_named(std::string_view name);

// One channel, 0..1.
float srgb_to_linear(float c);
float linear_to_srgb(float c);

}  // namespace curlew
