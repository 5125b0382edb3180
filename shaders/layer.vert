// Colours a rectangle of the trail layer.
layout(location = 0) in vec4 place;  // left, top, right, bottom
layout(location = 1) in vec4 layer_color;

flat out vec4 fill;

void main() {
  fill = layer_color;
  gl_Position = clip_position(mix(place.xy, place.zw, 0.5 * quad_corner() + 0.5));
}
