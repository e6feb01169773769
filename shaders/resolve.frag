// From the drawn size to the picture's. N to one: the mean of N x N, in linear light. One to one: edges are softened.
//
// A sphere's rim knows how much of its pixel it covers, and its normal points to what lies outside: the rest comes from
// there. That is exact for single drops, where filters that only see colours make crosses of them.
// Elsewhere, after the idea of Lottes 2009, "FXAA": find an edge's direction from four diagonal neighbours, average
// along it, and keep the average only where it stays within what the neighbours show.
layout(binding = 0) uniform sampler2D shaded;  // filtered linearly
layout(binding = 1) uniform sampler2D albedo_map;
layout(binding = 2) uniform sampler2D normal_map;

in vec2 uv;
layout(location = 0) out vec4 colour;

float luminance(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

vec3 mean_of_block(int n) {
  ivec2 corner = ivec2(gl_FragCoord.xy) * n;
  vec3 sum = vec3(0);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) sum += to_linear(texelFetch(shaded, corner + ivec2(x, y), 0).rgb);
  return to_srgb(sum / float(n * n));
}

vec3 covered(ivec2 texel, vec3 centre, float cover) {
  vec2 out_of_it = 2 * texelFetch(normal_map, texel, 0).xy - 1;
  float l = length(out_of_it);
  if (l < 1e-3) return centre;
  vec3 outside = textureLod(shaded, uv + out_of_it / l * size.zw, 0).rgb;
  return to_srgb(mix(to_linear(outside), to_linear(centre), cover));
}

vec3 smoothed_edge(ivec2 texel, vec3 centre) {
  ivec2 last = textureSize(shaded, 0) - 1;
  const ivec2 around[4] = ivec2[](ivec2(-1, 1), ivec2(1, 1), ivec2(-1, -1), ivec2(1, -1));
  vec4 l;
  for (int i = 0; i < 4; ++i) {
    ivec2 there = clamp(texel + around[i], ivec2(0), last);
    if (is_water(texelFetch(albedo_map, there, 0).a)) return centre;
    l[i] = luminance(texelFetch(shaded, there, 0).rgb);
  }
  float m = luminance(centre), low = min(m, min(min(l.x, l.y), min(l.z, l.w)));
  float high = max(m, max(max(l.x, l.y), max(l.z, l.w)));
  if (high - low < max(0.04, 0.1 * high)) return centre;
  vec2 along = vec2(l.z + l.w - l.x - l.y, l.y + l.w - l.x - l.z);
  float damp = max(0.03 * (l.x + l.y + l.z + l.w), 0.008);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + damp), -6, 6) * size.zw;
  vec3 near = 0.5 * (textureLod(shaded, uv - along / 6, 0).rgb + textureLod(shaded, uv + along / 6, 0).rgb);
  vec3 far = 0.5 * near + 0.25 * (textureLod(shaded, uv - along / 2, 0).rgb + textureLod(shaded, uv + along / 2, 0).rgb);
  float f = luminance(far);
  return f < low || f > high ? near : far;
}

void main() {
  int n = int(sampling.x + 0.5);
  if (n > 1) {
    colour = vec4(mean_of_block(n), 1);
    return;
  }
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 centre = texelFetch(shaded, texel, 0).rgb;
  float material = texelFetch(albedo_map, texel, 0).a, cover = cover_of(material);
  if (is_water(material))
    colour = vec4(cover < 0.99 ? covered(texel, centre, cover) : centre, 1);
  else
    colour = vec4(smoothed_edge(texel, centre), 1);
}
