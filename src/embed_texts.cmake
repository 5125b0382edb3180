# Writes OUTPUT, a C++ file with the texts of FILES, so that the program needs no data files beside it: TYPE ARRAY[] with
# name and text of each, and const int COUNT, as HEADER declares them.
# cmake -D OUTPUT=.. -D FILES="a.vert;b.frag" -D HEADER=.. -D TYPE=.. -D ARRAY=.. -D COUNT=.. -P embed_texts.cmake
set(text "// Generated, see ${HEADER}.\n#include \"${HEADER}\"\n\nnamespace chainreel {\n\n")
string(APPEND text "const ${TYPE} ${ARRAY}[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} source)
  string(APPEND text "    {\"${name}\", R\"embedded(${source})embedded\"},\n")
endforeach()
list(LENGTH FILES count)
string(APPEND text "};\nconst int ${COUNT} = ${count};\n\n}  // namespace chainreel\n")
file(WRITE ${OUTPUT} "${text}")
