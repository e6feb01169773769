// Water's particles seen from the light, added up: metres of water before the solid.
layout(binding = 0) uniform sampler2D solids;  // the shadow map
uniform float light_texel;                     // of the target, as a share of its side
uniform float radius;                          // of a particle, m
uniform float fill;                            // share of the water's volume in the spheres

layout(location = 0) out float metres;

void main() {
  if (textureLod(solids, gl_FragCoord.xy * light_texel, 0).r < gl_FragCoord.z) discard;
  vec2 off = 2 * gl_PointCoord - 1;
  metres = 2 * radius * sqrt(max(1 - dot(off, off), 0)) / fill;
}
