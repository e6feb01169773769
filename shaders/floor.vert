// A large square under the domain (3D), or the sheet behind it (2D).
out vec3 world_position;

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  vec3 centre = 0.5 * (domain_min.xyz + domain_max.xyz);
  if (up.w < 2.5)
    world_position = vec3(centre.xy + 0.5 * corner * (domain_max.xy - domain_min.xy), -2 * domain_min.w);
  else
    world_position = vec3(centre.x + corner.x * floor_colour.w, domain_min.y, centre.z + corner.y * floor_colour.w);
  gl_Position = view_to_clip * (world_to_view * vec4(world_position, 1));
}
