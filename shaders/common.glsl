// Before every shader: what the camera, the light and the theme are. Filled by render/view_block.cpp, in this order.
// Positions are in metres; "view" is the camera's space (x right, y up, looking along -z). Colours are linear.
layout(std140, binding = 0) uniform ViewBlock {
  mat4 world_to_view;
  mat4 view_to_world;
  mat4 view_to_clip;
  mat4 clip_to_view;
  mat4 world_to_light;     // to the shadow map: x and y in 0..1, z the depth in 0..1
  vec4 size;               // width and height of the picture in pixels, and their inverses
  vec4 key_direction;      // view space, towards the light; w: 1 if orthographic
  vec4 up;                 // view space, the world's up; w: dimension
  vec4 domain_min;         // w: radius of a drawn particle
  vec4 domain_max;         // w: metres that one pixel covers at distance 1 (or at any, if orthographic)
  vec4 key_colour;         // w: how much of it comes through in full shadow
  vec4 sky_colour;         // ambient light from above; w: strength of reflections
  vec4 ground_colour;      // ambient light from below; w: strength of the ambient occlusion
  vec4 background_top;
  vec4 background_bottom;
  vec4 floor_colour;       // w: distance from the domain's centre at which the floor has faded away
  vec4 grid_colour;        // w: strength of the metre lines
  vec4 body_colour;
  vec4 line_colour;        // of the walls' edges; w: opacity
  vec4 sampling;           // drawn pixels for each of the picture, along one side
};

// What a pixel of the G-buffer shows: alpha of its colour.
// Water also says how much of the pixel it covers.
const float material_none = 0.0, material_floor = 0.2, material_solid = 0.4;

bool is_water(float material) { return material > 0.49; }
bool is_floor(float material) { return material > 0.1 && material < 0.3; }
float water_alpha(float cover) { return 0.5 + 0.5 * cover; }
float cover_of(float alpha) { return clamp(2 * alpha - 1, 0, 1); }

// Metres that a pixel covers at a distance along the view axis.
float pixel_at(float dist) { return domain_max.w * (key_direction.w > 0.5 ? 1.0 : dist); }

// How far a sphere's partly covered rim reaches out, in pixels. Supersampling needs none, nor do drafts; but in flat
// ones there would be gaps.
float rim_pixels() { return sampling.x == 1 || (sampling.x < 1 && up.w < 2.5) ? 0.5 : 0.0; }

float depth_of(vec3 view_position) {
  vec4 clip = view_to_clip * vec4(view_position, 1);
  return clip.z / clip.w;
}

vec3 view_position_at(vec2 uv, float depth) {
  vec4 p = clip_to_view * vec4(2 * uv - 1, depth, 1);
  return p.xyz / p.w;
}

// From a pixel and its distance along the view axis: much cheaper than a matrix.
vec3 view_position_at_distance(vec2 uv, float dist) {
  vec2 plane = (2 * uv - 1) * vec2(clip_to_view[0][0], clip_to_view[1][1]);
  return vec3(key_direction.w > 0.5 ? plane : plane * dist, -dist);
}

vec3 to_linear(vec3 srgb) { return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb)); }
vec3 to_srgb(vec3 linear) {
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1 / 2.4)) - 0.055, step(0.0031308, linear));
}
