# Writes OUTPUT, the one unit that knows the version and the revision of the source tree FOLDER, where it has changed:
# cmake -DOUTPUT=version.cpp -DVERSION=0.1.0 -DFOLDER=. -P write_version.cmake
execute_process(COMMAND git -C ${FOLDER} describe --always --dirty --exclude=* OUTPUT_VARIABLE revision
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(text "#include \"app/report/version.hpp\"

namespace chainreel {

const char* program_version() {
  return \"${VERSION}\";
}

const char* program_revision() {
  return \"${revision}\";
}

}  // namespace chainreel
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
