# fovea as a library for Arduino:
#   cmake -P ports/arduino/library.cmake                   build/arduino/fovea, and fovea.zip beside it
#   cmake -DOUT=folder -P ports/arduino/library.cmake      elsewhere
# Arduino finds a library by a header in its folder src/, and that folder alone is in the include path; so the headers of
# core and hal are copied there, below a fovea.h that includes them all.
get_filename_component(fovea ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
if(NOT OUT)
  set(OUT ${fovea}/build/arduino)
endif()
get_filename_component(out ${OUT} ABSOLUTE)
set(library ${out}/fovea)

file(REMOVE_RECURSE ${library} ${library}.zip)
file(COPY ${fovea}/core/include/ ${fovea}/hal/include/ DESTINATION ${library}/src)
file(COPY ${CMAKE_CURRENT_LIST_DIR}/library.properties ${CMAKE_CURRENT_LIST_DIR}/examples ${fovea}/LICENSE
     DESTINATION ${library})

# Arduino.h comes first in a sketch, and in many cores it has macros by these names.
set(macros abs bit max min round word)
file(GLOB_RECURSE headers RELATIVE ${library}/src ${library}/src/fovea/*.hpp)
list(SORT headers)
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>")
list(TRANSFORM macros REPLACE "(.+)" "#pragma push_macro(\"\\1\")\n#undef \\1" OUTPUT_VARIABLE put_aside)
list(TRANSFORM macros REPLACE "(.+)" "#pragma pop_macro(\"\\1\")" OUTPUT_VARIABLE taken_back)
list(JOIN headers "\n" headers)
list(JOIN put_aside "\n" put_aside)
list(JOIN taken_back "\n" taken_back)
file(WRITE ${library}/src/fovea.h "// SPDX-License-Identifier: MIT
//
// fovea for Arduino: all of its headers, with macros of Arduino.h put aside.
#pragma once

#if __cplusplus < 201703L
#error \"fovea needs C++17: take a core that compiles with -std=gnu++17 or newer\"
#elif __INT_MAX__ < 0x7FFFFFFF
#error \"fovea needs a processor whose int has 32 bits\"
#else

${put_aside}

${headers}

${taken_back}

#endif
")

execute_process(COMMAND ${CMAKE_COMMAND} -E tar cf fovea.zip --format=zip fovea WORKING_DIRECTORY ${out}
                COMMAND_ERROR_IS_FATAL ANY)
message("${library}.zip")
