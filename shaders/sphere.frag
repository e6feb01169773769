// The sphere that a quad stands for: ray against sphere, with its own depth and normal.
in vec3 on_quad;
flat in vec3 centre;
flat in vec3 colour;
flat in float radius;

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;

void main() {
  float r = radius;
  vec3 origin = vec3(0), ray = normalize(on_quad);
  if (key_direction.w > 0.5) {
    origin = vec3(on_quad.xy, 0);
    ray = vec3(0, 0, -1);
  }
  float along = dot(centre - origin, ray);
  vec3 aside = origin + along * ray - centre;  // from the centre to the ray's nearest point: keeps its digits far away
  float away2 = dot(aside, aside);
  // Part of the pixel that the sphere covers: across one pixel at its rim it falls from 1 to 0. resolve.frag mixes the
  // rest with what lies outside.
  float cover = 1;
  if (rim_pixels() > 0)
    cover = clamp(0.5 + (r - sqrt(away2)) / pixel_at(-centre.z), 0, 1);
  else if (away2 > r * r)
    cover = 0;
  if (cover == 0) discard;
  vec3 n = normalize(aside - sqrt(max(r * r - away2, 0)) * ray);
  gl_FragDepth = depth_of(centre + r * n);
  albedo = vec4(colour, water_alpha(cover));
  normal = vec4(0.5 * n + 0.5, 0);
}
