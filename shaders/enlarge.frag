// A draft, drawn with fewer pixels than the picture has, to its size.
layout(binding = 0) uniform sampler2D shaded;

in vec2 uv;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(textureLod(shaded, uv, 0).rgb, 1); }
