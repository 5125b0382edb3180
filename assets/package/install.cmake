# What is installed, and the Debian package of it. The program finds its scenes and models from its own file, so that the
# installed tree may be moved.
include(GNUInstallDirs)

# FFmpeg's libraries, x264, Mesa's and Cairo are opened by name when they are needed, which no tool sees. What this library, which is
# installed nowhere, is linked with by the same functions tells which packages the program needs besides.
pkg_check_modules(OPENED REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale x264 osmesa cairo cairo-ft cairo-pdf)
add_library(chainreel_opened MODULE EXCLUDE_FROM_ALL src/encode/opened_libraries.cpp src/render/opened_libraries.cpp)
target_link_libraries(chainreel_opened PRIVATE PkgConfig::OPENED)
target_include_directories(chainreel_opened PRIVATE ${CMAKE_SOURCE_DIR}/src)

set(manual ${CMAKE_BINARY_DIR}/manual)
# Manual pages and completions are made when they are installed: nothing else needs them.
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" -DPROGRAM=$<TARGET_FILE:chainreel> -DFOLDER=${manual}
  -P \"${CMAKE_SOURCE_DIR}/assets/package/manual.cmake\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT runtime)
set(pages ${CMAKE_BINARY_DIR}/pages)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DSOURCE=${CMAKE_SOURCE_DIR}\" -DFOLDER=${pages}
  -P \"${CMAKE_SOURCE_DIR}/assets/package/pages.cmake\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT runtime)
install(TARGETS chainreel RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(TARGETS chainreel-equations RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/chainreel COMPONENT runtime)
install(DIRECTORY assets/scenes assets/styles assets/gallery assets/container assets/ci assets/cluster assets/library assets/notebooks assets/ros DESTINATION ${CMAKE_INSTALL_DATADIR}/chainreel/assets COMPONENT runtime)
install(DIRECTORY models DESTINATION ${CMAKE_INSTALL_DATADIR}/chainreel COMPONENT runtime)
install(FILES assets/guide/energy_rr.png DESTINATION ${CMAKE_INSTALL_DATADIR}/chainreel/assets/guide COMPONENT runtime)
install(DIRECTORY ${pages}/assets/guide DESTINATION ${CMAKE_INSTALL_DATADIR}/chainreel/assets COMPONENT runtime)
install(FILES ${pages}/README.md CHANGELOG.md packages.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES src/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME house.md COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT runtime)
install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime FILES_MATCHING PATTERN "*.1")
install(FILES ${manual}/chainreel.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME chainreel COMPONENT runtime)
install(FILES ${manual}/_chainreel DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
install(FILES ${manual}/chainreel.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT runtime)

include(assets/package/library.cmake)
if(CHAINREEL_PYTHON)
  set(python_package lib/python3/dist-packages/chainreel)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:chainreel_python>\")
    message(FATAL_ERROR \"the Python module is not built yet: cmake --build ${CMAKE_BINARY_DIR}, or leave it out by -DCHAINREEL_PYTHON=OFF\")
  endif()" COMPONENT python)
  install(TARGETS chainreel_python LIBRARY DESTINATION ${python_package} COMPONENT python)
  install(FILES ${CHAINREEL_PYTHON_FILES} DESTINATION ${python_package} COMPONENT python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME chainreel)
set(CPACK_PACKAGE_VENDOR chainreel)
set(CPACK_PACKAGE_CONTACT "The authors of chainreel <chainreel@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION "From a short scene file to a film of a robot chain moving under given torques:
MP4, WebM, GIF, PNG, SVG and PDF, without display or GPU, with an audit of the physics beside each film.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
# A package each: the program with its scenes, models and guide; what other programs are built with; the Python module.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev)
if(CHAINREEL_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME chainreel)
set(CPACK_DEBIAN_RUNTIME_FILE_NAME chainreel.deb)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "libegl1, libegl-mesa0, librsvg2-2, man-db")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libchainreel-dev)
set(CPACK_DEBIAN_DEV_FILE_NAME libchainreel-dev.deb)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# Who links with the film's library opens what the program opens by name.
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS chainreel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Libraries, headers and CMake package of chainreel: robot dynamics, runs and films.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-chainreel)
set(CPACK_DEBIAN_PYTHON_FILE_NAME python3-chainreel.deb)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module of chainreel: robot dynamics, runs as numpy arrays, films.")
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/assets/package/depends.cmake)
set(CPACK_CHAINREEL_BINARIES "${CMAKE_BINARY_DIR}/chainreel;${CMAKE_BINARY_DIR}/chainreel-equations;${CMAKE_BINARY_DIR}/libchainreel_opened.so")
set(CPACK_CHAINREEL_MODULE "${CHAINREEL_PYTHON_MODULE}") # "": none
set(CPACK_CHAINREEL_PYTHON "${CHAINREEL_PYTHON_VERSION}")
set(CPACK_CHAINREEL_FOLDER ${CMAKE_BINARY_DIR}/package)
include(CPack)
