// Seen from the light: bodies as triangles, particles as points as large as they are. The light is so far away that
// a point has one size everywhere.
layout(location = 0) in vec4 position;  // w: of a particle, the factor on its size

uniform float point_size;  // pixels of the shadow map

void main() {
  vec3 p = (world_to_light * vec4(position.xyz, 1)).xyz;
  gl_Position = vec4(2 * p.xy - 1, p.z, 1);
  gl_PointSize = max(point_size * position.w, 1);
}
