// The floor and its lines: one a metre, and fainter ones every tenth of a metre where there is room for them.
in vec3 world_position;

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;

// Coverage of lines `width` metres wide, every `spacing` metres; fades out where they would crowd each other.
float lines(vec2 p, vec2 footprint, float spacing, float pixels) {
  vec2 away = abs(fract(p / spacing + 0.5) - 0.5) * spacing;
  vec2 cover = clamp(0.5 * pixels + 0.5 - away / footprint, 0, 1);
  vec2 room = clamp(spacing / (6 * footprint) - 1, 0, 1);
  return max(cover.x * room.x, cover.y * room.y);
}

void main() {
  vec2 p = up.w < 2.5 ? world_position.xy : world_position.xz;
  vec2 footprint = max(fwidth(p), 1e-9);
  float strength = max(lines(p, footprint, 1.0, 1.4), 0.45 * lines(p, footprint, 0.1, 1.0));
  albedo = vec4(to_srgb(mix(floor_colour.rgb, grid_colour.rgb, grid_colour.a * strength)), material_floor);
  vec3 n = up.w < 2.5 ? vec3(0, 0, 1) : up.xyz;
  normal = vec4(0.5 * n + 0.5, 0);
}
