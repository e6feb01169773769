// Added up over all layers: where the eye's ray leaves the water less where it enters, both no farther than the solid.
layout(binding = 0) uniform sampler2D solid_depth;

in vec3 view_position;

layout(location = 0) out float metres;

void main() {
  float depth = texelFetch(solid_depth, ivec2(gl_FragCoord.xy), 0).r;
  float along = key_direction.w > 0.5 ? -view_position.z : length(view_position);
  if (depth > 0) {
    vec2 uv = gl_FragCoord.xy * size.zw;
    vec3 solid = view_position_at(uv, depth);
    along = min(along, key_direction.w > 0.5 ? -solid.z : length(solid));
  }
  metres = gl_FrontFacing ? -along : along;
}
