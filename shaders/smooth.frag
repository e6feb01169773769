// Flattens the bumps of single particles out of the distances (r): the surface that the eye should read. A bilateral
// filter (Tomasi & Manduchi 1998) along one axis; the next pass does the other, and two more passes with short strides
// fill what the taps of the first two skipped. Width in metres, so that water looks the same at every picture size.
// g says how much of the filter's width found water: little on a lone drop, which keeps its own round shape.
layout(binding = 0) uniform sampler2D distances;
uniform vec4 axis;  // x, y; z: 0 for the wide passes, 1 for the filling ones

in vec2 uv;
layout(location = 0) out vec2 result;

const int taps = 6;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(distances, 0) - 1;
  vec2 here = texelFetch(distances, texel, 0).rg;
  result = here;
  if (here.r <= 0) return;
  float r = domain_min.w;
  float reach = clamp(6.0 * r / (2 * pixel_at(here.r)), 2.0, 60.0);  // pixels, two standard deviations
  float stride = max(reach / taps, 1.0);
  if (axis.z > 0.5) {
    reach = stride;
    stride = max(reach / 3, 1.0);
  }
  vec3 sum = vec3(here, 1);
  float all = 1;
  for (int i = 1; i <= taps; ++i) {
    float s = i * stride;
    if (s > reach) break;
    float along = exp(-2 * s * s / (reach * reach));
    for (int side = -1; side <= 1; side += 2) {
      vec2 there = texelFetch(distances, clamp(texel + ivec2(round(side * s * axis.xy)), ivec2(0), last), 0).rg;
      float apart = (there.r - here.r) / (4 * r);
      float w = there.r > 0 ? along * exp(-apart * apart) : 0.0;
      sum += w * vec3(there, 1);
      all += along;
    }
  }
  float found = axis.z > 0.5 ? 1.0 : sum.z / all;
  result = vec2(sum.x / sum.z, found * sum.y / sum.z);
}
