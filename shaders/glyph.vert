// One glyph on whole pixels; its bitmap in the atlas has been drawn for its place between them.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 source;  // left, top in the atlas
layout(location = 2) in vec4 place;   // left, top, width, height on the page
layout(location = 3) in vec4 text_color;

flat out ivec2 page_to_atlas;
flat out vec4 fill;

void main() {
  page_to_atlas = ivec2(source.xy) - ivec2(place.xy);
  fill = text_color;
  gl_Position = corner_of(window);
}
