// Half size: distance along the view axis of every other pixel, negative where it is not water; far away where there is
// nothing.
layout(binding = 0) uniform sampler2D depth_map;
layout(binding = 1) uniform sampler2D albedo_map;

in vec2 uv;
layout(location = 0) out vec2 result;

void main() {
  ivec2 texel = min(ivec2(gl_FragCoord.xy) * 2, textureSize(depth_map, 0) - 1);
  float depth = texelFetch(depth_map, texel, 0).r;
  float dist = depth == 0 ? -1e9 : -view_position_at(vec2(0.5), depth).z;
  if (depth != 0 && !is_water(texelFetch(albedo_map, texel, 0).a)) dist = -dist;
  result = vec2(dist, 1);
}
