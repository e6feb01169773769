// The walls behind the water: plain quads.
layout(std430, binding = 0) readonly buffer Corners { vec4 corners[]; };

void main() {
  vec3 p = (world_to_view * vec4(corners[gl_VertexID].xyz, 1)).xyz;
  gl_Position = view_to_clip * vec4(p, 1);
}
