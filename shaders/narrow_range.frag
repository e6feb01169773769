// The narrow-range filter of Truong & Yuksel 2018, "A narrow-range filter for screen-space fluid rendering", along one
// axis: a Gaussian over distances, in which what lies far behind counts as a little behind, and what lies far before is
// left out, together with its mirror image. Silhouettes stay, bumps of particles go.
layout(binding = 0) uniform sampler2D distances;  // 0: no water
uniform vec4 axis;                                // x, y; z: standard deviation in m

layout(location = 0) out float result;

const int most = 14;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(distances, 0) - 1;
  float here = texelFetch(distances, texel, 0).r;
  result = here;
  if (here <= 0) return;
  float sigma = clamp(axis.z / pixel_at(here), 0.8, 40.0);  // pixels
  float stride = max(2 * sigma / float(most), 1.0);
  float r = domain_min.w, range = 4 * r, behind = 0.8 * r;
  float nearest = here - range, farthest = here + range;
  float sum = here, weights = 1;
  for (int i = 1; i <= most; ++i) {
    float s = float(i) * stride;
    if (s > 2 * sigma + 0.5) break;
    vec2 value;
    for (int k = 0; k < 2; ++k) {
      ivec2 at = clamp(texel + ivec2(round((k == 0 ? s : -s) * axis.xy)), ivec2(0), last);
      float there = texelFetch(distances, at, 0).r;
      value[k] = there <= 0 ? farthest + 1 : there;
    }
    if (min(value.x, value.y) < nearest) continue;
    float weight = exp(-0.5 * s * s / (sigma * sigma));
    for (int k = 0; k < 2; ++k) {
      bool far = value[k] > farthest;
      sum += weight * (far ? here + behind : value[k]);
      weights += weight;
      // Within range, the range grows with the slope that it finds.
      if (!far) {
        nearest = min(nearest, value[k] - range);
        farthest = max(farthest, value[k] + range);
      }
    }
  }
  result = sum / weights;
}
