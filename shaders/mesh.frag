in vec3 view_position;
in vec3 view_normal;

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;

void main() {
  vec3 n = normalize(view_normal);
  // Meshes come with either winding and may be open: the side that is seen is the front.
  vec3 to_eye = key_direction.w > 0.5 ? vec3(0, 0, 1) : -view_position;
  n = faceforward(n, -to_eye, n);
  albedo = vec4(to_srgb(body_colour.rgb), material_solid);
  normal = vec4(0.5 * n + 0.5, 0);
}
