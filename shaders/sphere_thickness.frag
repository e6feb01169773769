// Added up over all particles: metres of water on the eye's ray. Spheres fill pi / 6 of the water's volume where they
// touch; a drawn radius may differ from the particle's.
layout(binding = 1) uniform sampler2D solid_depth;
uniform float fill;  // share of the water's volume in the spheres

in vec3 on_quad;
flat in vec3 centre;
flat in float radius;

layout(location = 0) out float metres;

void main() {
  vec3 origin = vec3(0), ray = normalize(on_quad);
  if (key_direction.w > 0.5) {
    origin = vec3(on_quad.xy, 0);
    ray = vec3(0, 0, -1);
  }
  float along = dot(centre - origin, ray);
  vec3 aside = origin + along * ray - centre;
  float inside2 = radius * radius - dot(aside, aside);
  if (inside2 < 0) discard;
  float depth = texelFetch(solid_depth, ivec2(gl_FragCoord.xy), 0).r;
  if (depth > 0) {
    vec3 solid = view_position_at(gl_FragCoord.xy * size.zw, depth);
    if (-solid.z < -centre.z) discard;
  }
  metres = 2 * sqrt(inside2) / fill;
}
