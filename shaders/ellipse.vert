layout(location = 0) in vec4 place;  // centre, unit direction of the major axis
layout(location = 1) in vec4 body;   // major and minor semi-axis, half stroke
layout(location = 2) in vec4 fill_color;
layout(location = 3) in vec4 stroke_color;

flat out vec4 frame;
flat out vec3 size;
flat out vec4 fill;
flat out vec4 stroke;

void main() {
  frame = place;
  size = body.xyz;
  fill = fill_color;
  stroke = stroke_color;
  vec2 local = quad_corner() * (body.xy + body.z + kFringe);
  vec2 minor = vec2(-place.w, place.z);
  gl_Position = clip_position(place.xy + local.x * place.zw + local.y * minor);
}
