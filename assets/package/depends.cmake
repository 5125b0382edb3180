# Read by CPack: which packages, of which versions on, hold the symbols that the program uses. dpkg-shlibdeps knows them from
# the libraries' packages; fonts are none.
file(MAKE_DIRECTORY ${CPACK_CHAINREEL_FOLDER}/debian)
file(WRITE ${CPACK_CHAINREEL_FOLDER}/debian/control "Source: chainreel\n\nPackage: chainreel\nArchitecture: any\n")
list(TRANSFORM CPACK_CHAINREEL_BINARIES PREPEND "-e" OUTPUT_VARIABLE binaries)
execute_process(COMMAND dpkg-shlibdeps -O ${binaries} WORKING_DIRECTORY ${CPACK_CHAINREEL_FOLDER}
  OUTPUT_VARIABLE depends OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "shlibs:Depends=" "" depends "${depends}")
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${depends}, fonts-dejavu-core, fonts-lmodern")
