// As water_thickness.frag, along the key light.
layout(binding = 0) uniform sampler2D solids;  // the shadow map
uniform float light_metres;                    // from depth 0 to 1
uniform float light_texel;                     // of the target, as a share of its side

layout(location = 0) out float metres;

void main() {
  float solid = textureLod(solids, gl_FragCoord.xy * light_texel, 0).r;
  float along = min(gl_FragCoord.z, solid) * light_metres;
  metres = gl_FrontFacing ? -along : along;
}
