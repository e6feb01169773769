// From filtered distances to a surface: its depth, and its normal from differences, of which the smaller one counts.
layout(binding = 0) uniform sampler2D distances;

in vec2 uv;
layout(location = 0) out vec4 normal;

vec3 position_at(ivec2 texel, float otherwise) {
  ivec2 extent = textureSize(distances, 0);
  texel = clamp(texel, ivec2(0), extent - 1);
  float d = texelFetch(distances, texel, 0).r;
  return view_position_at_distance((vec2(texel) + 0.5) / vec2(extent), d > 0 ? d : otherwise);
}

vec3 slope(vec3 before, vec3 here, vec3 after) {
  return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float here = texelFetch(distances, texel, 0).r;
  if (here <= 0) discard;
  vec3 p = position_at(texel, here);
  float nowhere = 1e6;
  vec3 dx = slope(position_at(texel - ivec2(1, 0), nowhere), p, position_at(texel + ivec2(1, 0), nowhere));
  vec3 dy = slope(position_at(texel - ivec2(0, 1), nowhere), p, position_at(texel + ivec2(0, 1), nowhere));
  vec3 n = normalize(cross(dx, dy));
  gl_FragDepth = depth_of(p);
  normal = vec4(0.5 * n + 0.5, 1);
}
