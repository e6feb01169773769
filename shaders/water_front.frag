// The nearest layer of the surface. Seen from behind (where the eye is in the water, or a nearer layer was cut away),
// it still shows its face.
in vec3 view_position;
in vec3 view_normal;

layout(location = 0) out vec4 normal;

void main() {
  vec3 to_eye = key_direction.w > 0.5 ? vec3(0, 0, 1) : normalize(-view_position);
  vec3 n = normalize(view_normal);
  // Interpolated normals may turn away at the rim, where the triangle itself does not.
  float facing = dot(n, to_eye);
  if (facing < 0.02) n = normalize(n + (0.02 - facing) * to_eye);
  normal = vec4(0.5 * n + 0.5, 1);
}
