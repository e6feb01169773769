// Water from its particles, first step: distance along the view axis to the nearest sphere.
in vec3 on_quad;
flat in vec3 centre;
flat in float radius;

layout(location = 0) out float result;

void main() {
  vec3 origin = vec3(0), ray = normalize(on_quad);
  if (key_direction.w > 0.5) {
    origin = vec3(on_quad.xy, 0);
    ray = vec3(0, 0, -1);
  }
  vec3 aside = origin + dot(centre - origin, ray) * ray - centre;
  float inside2 = radius * radius - dot(aside, aside);
  if (inside2 < 0) discard;
  vec3 p = centre + aside - sqrt(inside2) * ray;
  gl_FragDepth = depth_of(p);
  result = -p.z;
}
