// A part of a shape that it fills evenly.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 fill_color;

flat out vec4 fill;

void main() {
  fill = fill_color;
  gl_Position = corner_of(window);
}
