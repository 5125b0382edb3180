// Puts a drawn group of bodies down on the page.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 settings;      // opacity, radius of the outline in px
layout(location = 2) in vec4 line_color;    // premultiplied

flat out vec4 how;
flat out vec4 line;

void main() {
  how = settings;
  line = line_color;
  gl_Position = corner_of(window);
}
