flat in vec4 fill;
flat in vec4 slopes;
flat in vec4 offsets;
layout(location = 0) out vec4 color;

void main() { color = fill * fade(slopes, offsets); }
