// Where the key light falls on the floor after the water's surface has bent it: each triangle of the surface becomes
// one of the floor's map, which spans the domain.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;

out vec3 source;  // on the surface, world space

void main() {
  vec3 to_light = mat3(view_to_world) * key_direction.xyz;
  source = position;
  float facing = dot(direction, to_light);
  vec3 bent = refract(-to_light, facing > 0 ? direction : -direction, 1 / 1.33);
  float height = position.y - domain_min.y;
  vec2 hit = position.xz + bent.xz * height / max(-bent.y, 0.05);
  vec2 map = (hit - domain_min.xz) / (domain_max.xz - domain_min.xz);
  // Light comes in where the surface faces it; the other side is put out of the picture.
  gl_Position = vec4(2 * map - 1, 0, facing > 0.02 ? 1 : -1);
}
