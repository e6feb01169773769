// The water's surface mesh.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;

out vec3 view_position;
out vec3 view_normal;

void main() {
  view_position = (world_to_view * vec4(position, 1)).xyz;
  view_normal = mat3(world_to_view) * direction;
  gl_Position = view_to_clip * vec4(view_position, 1);
}
