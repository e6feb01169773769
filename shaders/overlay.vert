// Text and bars over the finished picture, in pixels from its top left corner.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 ink;

uniform vec4 picture;  // width, height

out vec2 at;
out vec4 tint;

void main() {
  at = texel;
  tint = ink;
  gl_Position = vec4(2 * position.x / picture.x - 1, 1 - 2 * position.y / picture.y, 0, 1);
}
