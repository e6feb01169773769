// Edges of the domain as thin quads that always face us: six vertices each, from the two ends of the edge.
layout(std430, binding = 0) readonly buffer Edges { vec4 ends[]; };  // two an edge; w of the first: opacity

uniform float line_width;  // pixels of the picture

noperspective out float across;  // pixels from the middle of the line
flat out float opacity;

void main() {
  int edge = gl_VertexID / 6, corner = gl_VertexID % 6;
  bool at_end = corner == 1 || corner == 2 || corner == 4;
  float side = corner == 0 || corner == 1 || corner == 3 ? -1.0 : 1.0;
  vec3 a = (world_to_view * vec4(ends[2 * edge].xyz, 1)).xyz, b = (world_to_view * vec4(ends[2 * edge + 1].xyz, 1)).xyz;
  opacity = ends[2 * edge].w;

  // Cut at a plane just before the eye, where a projection still makes sense.
  bool flat_picture = key_direction.w > 0.5;
  float nearest = -1e-3 * length(domain_max.xyz - domain_min.xyz);
  if (!flat_picture) {
    if (a.z > nearest && b.z > nearest) {
      gl_Position = vec4(0, 0, -2, 1);
      return;
    }
    if (a.z > nearest) a = mix(a, b, (a.z - nearest) / (a.z - b.z));
    if (b.z > nearest) b = mix(b, a, (b.z - nearest) / (b.z - a.z));
  }
  // A little towards the eye: an edge lies on the floor and must not fight with it, least of all with a draft's.
  float nearer = sampling.x < 1 ? 0.99 : 0.999;
  a = flat_picture ? a + vec3(0, 0, domain_min.w) : a * nearer;
  b = flat_picture ? b + vec3(0, 0, domain_min.w) : b * nearer;

  vec4 from = view_to_clip * vec4(a, 1), to = view_to_clip * vec4(b, 1);
  vec2 direction = (to.xy / to.w - from.xy / from.w) * size.xy / sampling.x;
  direction = dot(direction, direction) > 0 ? normalize(direction) : vec2(1, 0);
  float reach = 0.5 * line_width + 1;
  gl_Position = at_end ? to : from;
  gl_Position.xy += side * reach * 2 * sampling.x * size.zw * vec2(-direction.y, direction.x) * gl_Position.w;
  across = side * reach;
}
