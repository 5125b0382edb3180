# Runs CARD_HASH under several settings of Mesa's software renderer, through both libraries that bring it, by none and, where
# QEMU is given, on emulated processors without FMA and AVX and with them; fails unless all print the same hash. Settings that would
# change bytes, or crash, are among them: the program overrules those.
# cmake -D CARD_HASH=.. [-D QEMU=..] -P same_bytes.cmake
set(expected "")

function(require_same name)
  execute_process(COMMAND ${ARGN}
    OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_VARIABLE complaint RESULT_VARIABLE status)
  message(STATUS "${name}: ${hash}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "with ${name} the card is not drawn (${status}): ${complaint}")
  endif()
  if(NOT hash MATCHES "^[0-9a-f]+$" OR (expected AND NOT hash STREQUAL expected))
    message(FATAL_ERROR "with ${name} the card has other pixels: ${hash}, not ${expected}")
  endif()
  set(expected ${hash} PARENT_SCOPE)
endfunction()

foreach(setting LP_NUM_THREADS=0 LP_NUM_THREADS=2 LP_NATIVE_VECTOR_WIDTH=256 LP_NATIVE_VECTOR_WIDTH=512
        GALLIUM_OVERRIDE_CPU_CAPS=ssse3 LP_NO_RAST=1 MESA_SHADER_CACHE_DISABLE=true)
  require_same(${setting} ${CMAKE_COMMAND} -E env ${setting} ${CARD_HASH})
endforeach()
foreach(library osmesa egl none)
  require_same(${library} ${CARD_HASH} ${library})
endforeach()
if(QEMU)
  foreach(processor Nehalem-v1 Haswell-v1)
    require_same(${processor} ${QEMU} -cpu ${processor} ${CARD_HASH})
    require_same("${processor}, none" ${QEMU} -cpu ${processor} ${CARD_HASH} none)
  endforeach()
endif()
