// Averages the 4 x 4 pixels over which occlusion.frag turned its samples, but not across edges.
layout(binding = 0) uniform sampler2D lights;
layout(binding = 1) uniform sampler2D distances;

in vec2 uv;
layout(location = 0) out vec2 light;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(lights, 0) - 1;
  float here = abs(texelFetch(distances, texel, 0).r);
  vec3 sum = vec3(0);
  for (int y = -2; y < 2; ++y)
    for (int x = -2; x < 2; ++x) {
      ivec2 at = clamp(texel + ivec2(x, y), ivec2(0), last);
      float apart = (abs(texelFetch(distances, at, 0).r) - here) / (4 * domain_min.w + 0.01 * here);
      float w = max(1 - apart * apart, 0.0) + 1e-4;
      sum += w * vec3(texelFetch(lights, at, 0).rg, 1);
    }
  light = sum.rg / sum.b;
}
