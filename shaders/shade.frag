// Light on what the G-buffer holds, to sRGB.
layout(binding = 0) uniform sampler2D depth_map;
layout(binding = 1) uniform sampler2D albedo_map;
layout(binding = 2) uniform sampler2D normal_map;
layout(binding = 3) uniform sampler2D lights;          // half size
layout(binding = 4) uniform sampler2D smooth_normals;  // half size
layout(binding = 5) uniform sampler2D distances;       // half size, smoothed
layout(binding = 6) uniform sampler2D water_light;     // metres of water that the key light crosses, seen from it
layout(binding = 7) uniform sampler2D caustics;        // light on the floor under water, over that without
uniform float light_through_water;                     // 1 where there is water to cross
uniform float has_caustics;                            // 1 where that map is there

in vec2 uv;
layout(location = 0) out vec4 colour;

vec3 background() {
  vec3 c = mix(background_bottom.rgb, background_top.rgb, smoothstep(0.0, 1.0, uv.y));
  vec2 off = (uv - vec2(0.48, 0.45)) * vec2(1.1, 1.0);
  return c * (1 - 0.22 * dot(off, off));
}

// What a mirror would show: a bright soft sky, darker towards the ground.
vec3 reflection(vec3 direction) {
  float height = dot(direction, up.xyz);
  return mix(ground_colour.rgb, 1.3 * sky_colour.rgb, smoothstep(-0.3, 0.8, height));
}

// Straight up to 0.7, then a shoulder that never quite reaches white: colours of the legend keep their place.
vec3 film(vec3 c) {
  const float knee = 0.7;
  return mix(c, knee + (1 - knee) * (1 - exp(-(c - knee) / (1 - knee))), step(knee, c));
}

// To sRGB, a quarter of a step up or down in a checkerboard: slow gradients would show their steps.
vec3 encoded(vec3 c) {
  float checker = float((int(gl_FragCoord.x) + int(gl_FragCoord.y)) & 1) - 0.5;
  return to_srgb(film(c)) + 0.5 * checker / 255;
}

// The half-size buffers at this pixel: the four nearest texels, those at another distance left out. `surface`
// tells water surface (1) from lone drops (0).
void fetch_light(float dist, out vec2 light, out vec3 n, out float surface) {
  vec2 at = gl_FragCoord.xy * 0.5 - 0.25;
  ivec2 base = ivec2(floor(at)), last = textureSize(lights, 0) - 1;
  vec2 f = at - vec2(base);
  vec3 light_sum = vec3(0);
  surface = 0;
  n = vec3(0);
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1), texel = clamp(base + offset, ivec2(0), last);
    vec2 there = texelFetch(distances, texel, 0).rg;
    float apart = (abs(there.r) - dist) / (3 * domain_min.w + 0.01 * dist);
    vec2 bilinear = mix(1 - f, f, vec2(offset));
    float w = bilinear.x * bilinear.y * max(1 - apart * apart, 0.0) + 1e-4;
    light_sum += w * vec3(texelFetch(lights, texel, 0).rg, 1);
    surface += w * there.g;
    n += w * (2 * texelFetch(smooth_normals, texel, 0).xyz - 1);
  }
  light = light_sum.rg / light_sum.b;
  surface = smoothstep(0.2, 0.6, surface / light_sum.b);
}

// What is left of the key light behind the water before a point. The lamp is wide, so the shadow's rim is soft.
vec3 through_water(vec3 p, bool on_floor) {
  if (light_through_water < 0.5) return vec3(1);
  vec3 world = (view_to_world * vec4(p, 1)).xyz;
  vec2 at = (world_to_light * vec4(world, 1)).xy;
  float metres = 0;
  for (int i = 0; i < 8; ++i) {
    float part = (float(i) + 0.5) / 8.0, angle = 6.2831853 * 2 * part;
    metres += max(textureLod(water_light, at + sqrt(part) * 0.004 * vec2(cos(angle), sin(angle)), 0).r, 0) / 8.0;
  }
  float depth = metres / length(domain_max.xyz - domain_min.xyz);
  float covered = 1 - exp(-250 * depth);
  vec3 left = exp(-vec3(5, 1.7, 1.0) * depth);
  if (!on_floor || has_caustics < 0.5) return left * (1 - 0.2 * covered);
  vec2 map = (world.xz - domain_min.xz) / (domain_max.xz - domain_min.xz);
  if (any(lessThan(map, vec2(0))) || any(greaterThan(map, vec2(1)))) return left * (1 - 0.2 * covered);
  vec2 texel = 1.5 / vec2(textureSize(caustics, 0));
  float bright = 0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) bright += textureLod(caustics, map + texel * vec2(x, y), 0).r / 9.0;
  return left * mix(1, min(bright, 4.0), covered);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_map, texel, 0).r;
  vec3 behind = background();
  if (depth == 0) {
    colour = vec4(encoded(behind), 1);
    return;
  }
  vec4 albedo = texelFetch(albedo_map, texel, 0);
  vec3 base = to_linear(albedo.rgb), p = view_position_at(uv, depth);
  vec3 n = normalize(2 * texelFetch(normal_map, texel, 0).xyz - 1);
  vec3 to_eye = key_direction.w > 0.5 ? vec3(0, 0, 1) : normalize(-p);
  vec2 light;
  vec3 smooth_n;
  float surface;
  fetch_light(-p.z, light, smooth_n, surface);

  bool water = is_water(albedo.a);
  float rim = 1;
  vec3 mirror = n;
  if (water) {
    smooth_n = normalize(smooth_n + 1e-3 * to_eye);
    rim = mix(0.62, 1.0, smoothstep(0.0, 0.75, dot(n, to_eye)));  // the gaps between particles are dark
    mirror = normalize(mix(n, smooth_n, 0.85 * surface));
    n = normalize(mix(n, smooth_n, 0.6 * surface));
  }
  float sky = mix(1, light.r, ground_colour.w), key = mix(key_colour.w, 1, light.g);
  float facing = dot(n, key_direction.xyz);
  float diffuse = water ? max((facing + 0.35) / 1.35, 0) : max(facing, 0);  // light bleeds through water
  vec3 ambient = mix(ground_colour.rgb, sky_colour.rgb, 0.5 + 0.5 * dot(n, up.xyz));
  vec3 lamp = key_colour.rgb * through_water(p, is_floor(albedo.a));
  vec3 c = base * rim * (ambient * sky + lamp * diffuse * key * mix(0.6, 1.0, sky));
  if (water) {
    // Schlick 1994, with a ceiling: the surface is rough, and a full mirror at every grazing angle would sparkle.
    float fresnel = min(0.02 + 0.98 * pow(clamp(1 - dot(mirror, to_eye), 0, 1), 5), 0.35);
    c = mix(c, reflection(reflect(-to_eye, mirror)) * sky * rim, fresnel * sky_colour.w);
    vec3 halfway = normalize(to_eye + key_direction.xyz);
    c += key_colour.rgb * (0.28 * sky_colour.w * rim * key * sky * pow(max(dot(mirror, halfway), 0), 40));
  }
  if (is_floor(albedo.a)) {
    vec3 world = (view_to_world * vec4(p, 1)).xyz;
    vec3 away = world - 0.5 * (domain_min.xyz + domain_max.xyz);
    float faded = up.w < 2.5 ? 0.5 : smoothstep(0.22, 1.0, length(away.xz) / floor_colour.w);
    c = mix(c, behind, faded);
  }
  colour = vec4(encoded(c), 1);
}
