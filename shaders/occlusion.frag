// Half size: how much of the sky (r) and of the key light (g) reaches a point, and the normal of the smoothed surface.
// Ambient obscurance after McGuire, Mara & Luebke 2012, "Scalable ambient obscurance", with their estimator.
layout(binding = 0) uniform sampler2D distances;   // smoothed
layout(binding = 1) uniform sampler2D normal_map;  // of the G-buffer, twice the size
layout(binding = 2) uniform sampler2DShadow shadow_map;
uniform vec4 light_texel;  // one texel of the shadow map: in its own units, and in metres (z)

in vec2 uv;
layout(location = 0) out vec2 light;
layout(location = 1) out vec4 normal;

const int sky_taps = 10, key_taps = 8;

vec3 position_at(ivec2 texel) {
  ivec2 size = textureSize(distances, 0);
  texel = clamp(texel, ivec2(0), size - 1);
  return view_position_at_distance((vec2(texel) + 0.25) / vec2(size), abs(texelFetch(distances, texel, 0).r));
}

// Of the two neighbours, the one nearer in depth: the other may lie on another surface.
vec3 slope(vec3 before, vec3 here, vec3 after) {
  return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float here = texelFetch(distances, texel, 0).r;
  light = vec2(1);
  normal = vec4(0.5, 0.5, 1, 0);
  if (here < -1e8) return;
  vec3 p = position_at(texel);
  vec3 n = normalize(2 * texelFetch(normal_map, min(texel * 2, textureSize(normal_map, 0) - 1), 0).xyz - 1);
  if (here > 0) {
    vec3 dx = slope(position_at(texel - ivec2(2, 0)), p, position_at(texel + ivec2(2, 0)));
    vec3 dy = slope(position_at(texel - ivec2(0, 2)), p, position_at(texel + ivec2(0, 2)));
    n = normalize(cross(dx, dy));
  }
  normal = vec4(0.5 * n + 0.5, 0);
  if (up.w < 2.5) return;  // a flat scene has no sky above it

  // A different turn for each of 4 x 4 pixels; the blur that follows averages them.
  float turn = 0.0625 * float(((texel.x & 3) * 4 + (texel.y & 3)) * 7 & 15);
  float r = domain_min.w, pixel = 2 * pixel_at(abs(here));
  float reach = 0.05 * length(domain_max.xyz - domain_min.xyz) + 4 * r, pixels = min(reach / pixel, 120.0);
  float obscured = 0;
  for (int i = 0; i < sky_taps; ++i) {
    float part = (float(i) + 0.5 * turn + 0.25) / float(sky_taps);
    float angle = 6.2831853 * (part * 3 + turn);
    vec3 v = position_at(texel + ivec2(part * pixels * vec2(cos(angle), sin(angle)))) - p;
    float vv = dot(v, v), vn = dot(v, n) - 0.02 * reach;
    float f = max(1 - vv / (reach * reach), 0.0);
    obscured += f * f * f * max(vn / sqrt(vv + 1e-4 * reach * reach), 0.0);
  }
  light.r = clamp(1 - 2.2 * obscured / float(sky_taps), 0, 1);

  // Off the surface by a little more than a texel and a particle, or it would shade itself.
  vec3 world = (view_to_world * vec4(p + n * (1.5 * r + 1.5 * light_texel.z), 1)).xyz;
  vec3 at = (world_to_light * vec4(world, 1)).xyz;
  if (any(lessThan(at, vec3(0))) || any(greaterThan(at, vec3(1)))) return;
  float lit = 0;
  for (int i = 0; i < key_taps; ++i) {
    float part = (float(i) + 0.5) / float(key_taps), angle = 6.2831853 * (part * 2 + turn);
    lit += texture(shadow_map, vec3(at.xy + sqrt(part) * light_texel.w * vec2(cos(angle), sin(angle)), at.z));
  }
  light.g = lit / float(key_taps);
}
