# Writes OUTPUT, a C++ file with the texts of FILES, so that the program needs no data files beside it.
# cmake -D OUTPUT=.. -D FILES="a.vert;b.frag" -P embed_shaders.cmake
set(text "// Generated from shaders/.\n#include \"render/shader_source.hpp\"\n\nnamespace chainreel {\n\n")
string(APPEND text "const EmbeddedShader kEmbeddedShaders[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} source)
  string(APPEND text "    {\"${name}\", R\"glsl(${source})glsl\"},\n")
endforeach()
list(LENGTH FILES count)
string(APPEND text "};\nconst int kEmbeddedShaderCount = ${count};\n\n}  // namespace chainreel\n")
file(WRITE ${OUTPUT} "${text}")
