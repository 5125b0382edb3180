# Renders a film and a picture of a robot in space, with all that lies flat around it, by several numbers of threads, through
# both libraries of the renderer, into folders of other names and, where QEMU is given, on emulated processors without AVX and
# FMA and with them; fails unless all files have the same bytes.
# cmake -D CHAINREEL=.. -D SOURCE=.. [-D QEMU=..] -P same_files.cmake
string(RANDOM LENGTH 8 name)
set(folder $ENV{TMPDIR})
if(NOT folder)
  set(folder /tmp)
endif()
set(folder ${folder}/chainreel_same_files_${name})
set(expected "")

function(require_same what place)
  file(MAKE_DIRECTORY ${folder}/${place})
  execute_process(
    COMMAND ${ARGN} ${SOURCE}/assets/scenes/arm_ellipsoid.yaml --quiet --set duration=0.1 --set video.fps=30
      --set video.width=64 --set video.height=36 --at 0.05 -o ${folder}/${place}/a.mp4 -o ${folder}/${place}/a.png
    RESULT_VARIABLE status ERROR_VARIABLE complaint)
  if(NOT status EQUAL 0)
    file(REMOVE_RECURSE ${folder})
    message(FATAL_ERROR "${what} ends with ${status}: ${complaint}")
  endif()
  file(SHA256 ${folder}/${place}/a.mp4 film)
  file(SHA256 ${folder}/${place}/a.png picture)
  message(STATUS "${what}: ${film} ${picture}")
  if(expected AND NOT "${film} ${picture}" STREQUAL expected)
    file(REMOVE_RECURSE ${folder})
    message(FATAL_ERROR "${what} gives other bytes than ${expected}")
  endif()
  set(expected "${film} ${picture}" PARENT_SCOPE)
endfunction()

require_same("one thread" a ${CHAINREEL} render --jobs 1)
foreach(jobs 2 8)
  require_same("${jobs} threads" "deep/in another/folder ${jobs}" ${CHAINREEL} render --jobs ${jobs})
endforeach()
require_same("EGL" egl ${CHAINREEL} --gl egl render)
if(QEMU)
  foreach(processor Nehalem-v1 Haswell-v1)
    require_same(${processor} ${processor} ${QEMU} -cpu ${processor} ${CHAINREEL} render)
  endforeach()
endif()
file(REMOVE_RECURSE ${folder})
