// Letters (r of the atlas) over a halo of paper (g) that keeps them readable on any picture. Plain bars come with a
// texel left of the atlas.
layout(binding = 0) uniform sampler2D atlas;
uniform vec4 paper;  // sRGB; a: strength of the halo

in vec2 at;
in vec4 tint;
layout(location = 0) out vec4 colour;

void main() {
  if (at.x < 0) {
    colour = tint;
    return;
  }
  vec2 cover = texelFetch(atlas, ivec2(at), 0).rg;
  float letter = cover.r * tint.a, halo = cover.g * paper.a * (1 - letter);
  colour = vec4((tint.rgb * letter + paper.rgb * halo) / max(letter + halo, 1e-4), letter + halo);
}
