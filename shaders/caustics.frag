// Light on the floor over what falls there without water: the share of the surface that sends its light to this texel,
// as the light sees it.
uniform float texel_area;  // m^2

in vec3 source;

layout(location = 0) out float light;

void main() {
  vec3 to_light = mat3(view_to_world) * key_direction.xyz;
  float seen = abs(dot(cross(dFdx(source), dFdy(source)), to_light));
  light = min(seen / (texel_area * to_light.y), 12.0);
}
