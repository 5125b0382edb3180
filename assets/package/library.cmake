# What other programs are built with: static libraries, headers that are public, and the package that find_package reads.
# Libraries are static: while the version begins with 0 classes change from one minor version to the next, which a program
# that holds its own copy need not care about; find_package accepts the same minor version alone.
include(CMakePackageConfigHelpers)
include(${CMAKE_SOURCE_DIR}/assets/package/public_headers.cmake)

set(dynamics_libraries core mesh model dynamics)
set(sim_libraries expr integrate sim)
set(film_libraries scene picture draw render encode table film)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/chainreel)

foreach(part dynamics sim film)
  foreach(library ${${part}_libraries})
    set_target_properties(chainreel_${library} PROPERTIES EXPORT_NAME ${library})
    target_compile_features(chainreel_${library} INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
    # Eigen aligns as the compiler's flags say: with those of a caller its members would lie elsewhere.
    target_compile_definitions(chainreel_${library} INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=16>)
    target_include_directories(chainreel_${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    install(TARGETS chainreel_${library} EXPORT chainreel-${part}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/chainreel COMPONENT dev)
  endforeach()
  install(EXPORT chainreel-${part} NAMESPACE chainreel:: DESTINATION ${config} COMPONENT dev)
  # One header for all of a library's, and of those that it stands on.
  set(text "// All public headers of chainreel::${part}.\n#pragma once\n\n")
  foreach(below ${parts_below})
    string(APPEND text "#include \"${below}.hpp\"\n")
  endforeach()
  list(APPEND parts_below ${part})
  foreach(header ${${part}_headers})
    string(APPEND text "#include \"${header}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers/${part}.hpp CONTENT "${text}" @ONLY)
endforeach()

# Within the house a header is "core/error.hpp"; elsewhere that may be another's.
set(named ${CMAKE_BINARY_DIR}/headers/chainreel)
string(REPLACE ";" " " headers_of_all "${dynamics_headers} ${sim_headers} ${film_headers}")
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DSOURCE=${CMAKE_SOURCE_DIR}/src\" \"-DFOLDER=${named}\"
  \"-DHEADERS=${headers_of_all}\" \"-DOWN=${CMAKE_BINARY_DIR}/headers\" -P \"${CMAKE_SOURCE_DIR}/assets/package/name_headers.cmake\"
  COMMAND_ERROR_IS_FATAL ANY)" COMPONENT dev)
install(DIRECTORY ${named} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

configure_package_config_file(assets/package/chainreelConfig.cmake.in ${CMAKE_BINARY_DIR}/chainreelConfig.cmake
  INSTALL_DESTINATION ${config})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/chainreelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/chainreelConfig.cmake ${CMAKE_BINARY_DIR}/chainreelConfigVersion.cmake
  DESTINATION ${config} COMPONENT dev)

# What the libraries are linked with, for the Debian package.
set(CPACK_CHAINREEL_DEV_PACKAGES "libassimp-dev, libcairo2-dev, libconsole-bridge-dev, libdeflate-dev, libeigen3-dev, libfreetype-dev, libfribidi-dev, libharfbuzz-dev, libimagequant-dev, libjpeg-dev, libminizip-dev, libpng-dev, libssl-dev, libtinyxml2-dev, liburdfdom-dev, libyaml-cpp-dev, pkg-config, zlib1g-dev")
