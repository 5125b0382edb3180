// Puts drawn bodies down on the page.
layout(location = 0) in vec4 window;

void main() { gl_Position = corner_of(window); }
