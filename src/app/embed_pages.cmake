# Writes OUTPUT, a C++ file with the texts of FILES, so that the program needs no data files beside it.
# cmake -D OUTPUT=.. -D FILES="a.html;b.css" -P embed_pages.cmake
set(text "// Generated from src/app/pages/.\n#include \"app/page_template.hpp\"\n\nnamespace chainreel {\n\n")
string(APPEND text "const EmbeddedPage kEmbeddedPages[] = {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} source)
  string(APPEND text "    {\"${name}\", R\"page(${source})page\"},\n")
endforeach()
list(LENGTH FILES count)
string(APPEND text "};\nconst int kEmbeddedPageCount = ${count};\n\n}  // namespace chainreel\n")
file(WRITE ${OUTPUT} "${text}")
