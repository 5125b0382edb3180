uniform sampler2D atlas;  // coverage

flat in ivec2 page_to_atlas;
flat in vec4 fill;
layout(location = 0) out vec4 color;

void main() { color = fill * texelFetch(atlas, ivec2(gl_FragCoord.xy) + page_to_atlas, 0).r; }
