layout(binding = 0) uniform sampler2D depth_map;
uniform float line_width;

noperspective in float across;
flat in float opacity;

layout(location = 0) out vec4 colour;

// The walls are drawn over the finished picture, whose pixels are coarser than the scene's where it is supersampled, and finer
// where it is a draft.
bool hidden() { return texelFetch(depth_map, ivec2(gl_FragCoord.xy * sampling.x), 0).r > gl_FragCoord.z; }

void main() {
  if (hidden()) discard;
  float cover = clamp(0.5 * line_width + 0.5 - abs(across), 0, 1);
  colour = vec4(to_srgb(line_colour.rgb), line_colour.a * opacity * cover);
}
