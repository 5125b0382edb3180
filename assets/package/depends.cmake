# Read by CPack: which packages, of which versions on, hold the symbols that the program and the module use. dpkg-shlibdeps
# knows them from the libraries' packages; fonts and what other programs are linked with are none.
file(MAKE_DIRECTORY ${CPACK_CHAINREEL_FOLDER}/debian)
file(WRITE ${CPACK_CHAINREEL_FOLDER}/debian/control "Source: chainreel\n\nPackage: chainreel\nArchitecture: any\n")
function(packages_of variable)
  list(TRANSFORM ARGN PREPEND "-e" OUTPUT_VARIABLE binaries)
  execute_process(COMMAND dpkg-shlibdeps -O ${binaries} WORKING_DIRECTORY ${CPACK_CHAINREEL_FOLDER}
    OUTPUT_VARIABLE depends OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "shlibs:Depends=" "" depends "${depends}")
  set(${variable} "${depends}" PARENT_SCOPE)
endfunction()

packages_of(depends ${CPACK_CHAINREEL_BINARIES})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "${depends}, fonts-dejavu-core, fonts-lmodern")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${CPACK_CHAINREEL_DEV_PACKAGES}")
if(CPACK_CHAINREEL_MODULE)
  packages_of(depends ${CPACK_CHAINREEL_MODULE})
  # The module is of one minor version of Python.
  string(REPLACE "." ";" version ${CPACK_CHAINREEL_PYTHON})
  list(GET version 0 major)
  list(GET version 1 minor)
  math(EXPR behind "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${depends}, chainreel (= ${CPACK_PACKAGE_VERSION}), \
python3 (>= ${major}.${minor}), python3 (<< ${major}.${behind}), python3-numpy")
endif()
