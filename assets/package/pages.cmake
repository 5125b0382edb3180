# Pages as they are installed: there the program is found by its name, and what they show lies in share/chainreel.
#   cmake -DSOURCE=.. -DFOLDER=.. -P pages.cmake
file(GLOB pages RELATIVE ${SOURCE} ${SOURCE}/assets/guide/*.md)
foreach(page README.md ${pages})
  file(READ ${SOURCE}/${page} text)
  string(REPLACE "build/chainreel" "chainreel" text "${text}")
  if(page STREQUAL "README.md")
    string(REPLACE "](assets/" "](../../chainreel/assets/" text "${text}")
    string(REPLACE "](src/README.md" "](house.md" text "${text}")
  endif()
  string(REPLACE "](../../src/README.md" "](../../../doc/chainreel/house.md" text "${text}")
  file(WRITE ${FOLDER}/${page} "${text}")
endforeach()
