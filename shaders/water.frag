// Light on water, over the finished picture of what stands behind it.
//
// At each pixel the surface splits the eye's ray. One part is mirrored to the sky; the other is bent (Snell, n = 1.33)
// and meets what lies behind at another place of the picture, after losing light to the water on its way
// (Beer-Lambert), which gives back some of its own colour. How much goes where is Schlick's (1994) approximation of
// Fresnel.
layout(binding = 0) uniform sampler2D shaded;     // what lies behind, sRGB, filtered linearly
layout(binding = 1) uniform sampler2D depth_map;  // of the nearest, water or solid
layout(binding = 2) uniform sampler2D normals;    // a: 1 where the nearest is water
layout(binding = 3) uniform sampler2D thickness;  // metres of water before the solid
layout(binding = 4) uniform sampler2D distances;  // half size: along the view axis to the solid, negative
uniform vec4 deep_colour;                         // linear
uniform vec4 absorption;                          // 1/m
uniform vec4 sky_zenith, sky_horizon;             // linear

in vec2 uv;
layout(location = 0) out vec4 colour;

// The sky's light from a direction: bright at the horizon, deeper above, the sun with its glow, and the floor below.
vec3 sky(vec3 direction) {
  float height = dot(direction, up.xyz);
  vec3 above = mix(sky_horizon.rgb, sky_zenith.rgb, 1 - exp(-3.5 * max(height, 0)));
  vec3 c = mix(above, floor_colour.rgb * ground_colour.rgb * 2, smoothstep(0.02, -0.12, height));
  float sun = max(dot(direction, key_direction.xyz), 0);
  return c + key_colour.rgb * (0.5 * pow(sun, 24) + 160 * pow(sun, 900));
}

vec3 film(vec3 c) {
  const float knee = 0.7;
  return mix(c, knee + (1 - knee) * (1 - exp(-(c - knee) / (1 - knee))), step(knee, c));
}
vec3 before_film(vec3 c) {
  const float knee = 0.7;
  return mix(c, knee - (1 - knee) * log(max(1 - (c - knee) / (1 - knee), 1e-3)), step(knee, c));
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 here = texelFetch(shaded, texel, 0).rgb;
  vec4 front = texelFetch(normals, texel, 0);
  if (front.a < 0.5) {
    colour = vec4(here, 1);
    return;
  }
  vec3 n = normalize(2 * front.xyz - 1);
  vec3 p = view_position_at(uv, texelFetch(depth_map, texel, 0).r);
  vec3 to_eye = key_direction.w > 0.5 ? vec3(0, 0, 1) : normalize(-p);
  float metres = max(texelFetch(thickness, texel, 0).r, 0);

  // Where the bent ray leaves the water or meets the solid, seen from the eye.
  vec3 bent = refract(-to_eye, n, 1 / 1.33);
  vec3 q = p + bent * min(metres, 0.25 * length(domain_max.xyz - domain_min.xyz));
  vec4 clip = view_to_clip * vec4(q, 1);
  vec2 there = clamp(0.5 + 0.5 * clip.xy / clip.w, 0.5 * size.zw, 1 - 0.5 * size.zw);
  // What stands before the water cannot be behind it.
  float solid = -texelFetch(distances, ivec2(there * vec2(textureSize(distances, 0))), 0).r;
  if (solid > 0 && solid < -p.z) there = uv;
  float through = there == uv ? metres : mix(metres, max(textureLod(thickness, there, 0).r, 0), 0.5);

  vec3 left = exp(-absorption.rgb * through);
  vec3 behind = before_film(to_linear(textureLod(shaded, there, 0).rgb));
  float lit = 0.65 + 0.35 * max(dot(n, key_direction.xyz), 0);
  vec3 body = behind * left + deep_colour.rgb * lit * (1 - left);

  float facing = clamp(dot(n, to_eye), 0, 1);
  float fresnel = 0.02 + 0.98 * pow(1 - facing, 5);
  vec3 c = mix(body, sky(reflect(-to_eye, n)), fresnel);
  // Thin sheets end softly.
  c = mix(before_film(to_linear(here)), c, smoothstep(0.0, 0.5 * domain_min.w, metres));
  float checker = float((texel.x + texel.y) & 1) - 0.5;
  colour = vec4(to_srgb(film(c)) + 0.5 * checker / 255, 1);
}
