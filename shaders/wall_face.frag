layout(binding = 0) uniform sampler2D depth_map;
uniform float opacity;

layout(location = 0) out vec4 colour;

void main() {
  if (texelFetch(depth_map, ivec2(gl_FragCoord.xy * sampling.x), 0).r > gl_FragCoord.z) discard;
  colour = vec4(to_srgb(line_colour.rgb), opacity);
}
