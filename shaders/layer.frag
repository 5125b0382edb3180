uniform sampler2D layer;

flat in vec4 fill;
layout(location = 0) out vec4 color;

void main() { color = fill * texelFetch(layer, ivec2(gl_FragCoord.xy), 0).r; }
