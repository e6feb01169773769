// One quad a particle, four vertices each, that holds the sphere's silhouette exactly: it stands across the line from
// the eye to the centre, and the cone that touches the sphere cuts it in a circle of radius r d / sqrt(d^2 - r^2).
// Half a pixel is added for the rim that sphere.frag covers in part.
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };  // w: factor on the radius
layout(std430, binding = 1) readonly buffer Values { float values[]; };

layout(binding = 0) uniform sampler2D colour_map;
uniform float larger;      // by how much the sphere is drawn larger, as a share of its radius
uniform vec4 value_range;  // smallest, 1 / (largest - smallest), 1 if coloured by value, 0

out vec3 on_quad;       // view space
flat out vec3 centre;   // view space
flat out vec3 colour;   // sRGB
flat out float radius;

void main() {
  int particle = gl_VertexID >> 2;
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  centre = (world_to_view * vec4(positions[particle].xyz, 1)).xyz;

  float t = value_range.z > 0.5 ? (values[particle] - value_range.x) * value_range.y : 0.0;
  colour = textureLod(colour_map, vec2((clamp(t, 0, 1) * 255 + 0.5) / 256, value_range.z > 0.5 ? 0.25 : 0.75), 0).rgb;

  vec3 right = vec3(1, 0, 0), up = vec3(0, 1, 0);
  radius = (1 + larger) * domain_min.w * positions[particle].w;
  float r = radius + rim_pixels() * pixel_at(-centre.z);
  float reach = r;
  if (key_direction.w < 0.5) {
    float d2 = dot(centre, centre);
    if (!(d2 > r * r)) {  // the eye is inside, or the position is not a number: nothing to draw
      gl_Position = vec4(0, 0, -2, 1);
      return;
    }
    reach = r * sqrt(d2 / (d2 - r * r));
    right = normalize(vec3(-centre.z, 0, centre.x));
    up = cross(right, centre) * inversesqrt(d2);
  }
  on_quad = centre + reach * (corner.x * right + corner.y * up);
  gl_Position = view_to_clip * vec4(on_quad, 1);
}
