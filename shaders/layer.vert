// Colours a rectangle of the trail layer.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 layer_color;

flat out vec4 fill;

void main() {
  fill = layer_color;
  gl_Position = corner_of(window);
}
