# The public headers as they are installed: "core/error.hpp" becomes "chainreel/core/error.hpp". cmake -DSOURCE=src
# -DHEADERS="a.hpp b.hpp" -DOWN=folder of those made here -DFOLDER=to -P ..
file(REMOVE_RECURSE ${FOLDER})
function(write_named from to)
  file(READ ${from} text)
  string(REGEX REPLACE "#include \"([a-z_]+/)" "#include \"chainreel/\\1" text "${text}")
  # An entry of a list would lose its brackets and semicolons; a text in quotes keeps them.
  file(CONFIGURE OUTPUT ${to} CONTENT "${text}" @ONLY)
endfunction()

string(REPLACE " " ";" headers "${HEADERS}")
foreach(header ${headers})
  write_named(${SOURCE}/${header} ${FOLDER}/${header})
endforeach()
foreach(part dynamics sim film)
  write_named(${OWN}/${part}.hpp ${FOLDER}/${part}.hpp)
endforeach()
