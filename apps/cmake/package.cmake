# The package fovead for Debian and what is like it: cpack -G DEB, in a build with -DFOVEA_PACKAGE=ON. With
# -DFOVEA_STATIC=ON the package needs no other, not even a C library, and one of arm64 serves every arm64.
find_program(FOVEA_GZIP gzip REQUIRED)
set(debian ${CMAKE_CURRENT_SOURCE_DIR}/fovead/debian)
set(pages ${CMAKE_CURRENT_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${pages})

# ---- What fovead writes of itself ---------------------------------------------------------

# The sample of settings and their manual page come from the program's own table. For another processor the program is
# compiled a second time, for this machine; it is headers and one source.
set(fovead_here fovead)
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  find_program(FOVEA_HOST_CXX NAMES c++ g++ clang++ REQUIRED NO_CMAKE_FIND_ROOT_PATH
               DOC "A compiler for this machine, to make the pages of the package")
  set(fovead_here ${pages}/fovead_here)
  set(includes ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(folder core hal ports/linux ports/simulated)
    list(APPEND includes ${PROJECT_SOURCE_DIR}/${folder}/include)
  endforeach()
  list(TRANSFORM includes PREPEND -I)
  add_custom_command(OUTPUT ${fovead_here} DEPENDS fovead
    COMMAND ${FOVEA_HOST_CXX} -std=c++17 -DFOVEA_VERSION="${PROJECT_VERSION}" ${includes}
            ${CMAKE_CURRENT_SOURCE_DIR}/fovead/main.cpp -o ${fovead_here}
    COMMENT "fovead for this machine, which writes the pages of the package" VERBATIM)
endif()
add_custom_command(OUTPUT ${pages}/fovead.toml DEPENDS fovead ${fovead_here}
  COMMAND ${fovead_here} --sample-config > ${pages}/fovead.toml VERBATIM)
add_custom_command(OUTPUT ${pages}/keys DEPENDS fovead ${fovead_here}
  COMMAND ${fovead_here} --settings-manual > ${pages}/keys VERBATIM)
add_custom_command(OUTPUT ${pages}/fovead.conf.5 DEPENDS ${pages}/keys fovead/fovead.conf.5.in
  COMMAND ${CMAKE_COMMAND} -DKEYS_FILE=${pages}/keys -DIN=${CMAKE_CURRENT_SOURCE_DIR}/fovead/fovead.conf.5.in
          -DOUT=${pages}/fovead.conf.5 -P ${CMAKE_CURRENT_LIST_DIR}/fill_in.cmake VERBATIM)

# ---- Files --------------------------------------------------------------------------------

# compressed(FILE NAME): a file of the source tree or of pages as Debian has its pages, without the time.
set(compressed_files "")
function(compressed file name)
  add_custom_command(OUTPUT ${pages}/${name}.gz DEPENDS ${file}
    COMMAND ${FOVEA_GZIP} -9 -n -c ${file} > ${pages}/${name}.gz VERBATIM)
  set(compressed_files ${compressed_files} ${pages}/${name}.gz PARENT_SCOPE)
endfunction()
compressed(${CMAKE_CURRENT_SOURCE_DIR}/tool/fovea.1 fovea.1)
compressed(${CMAKE_CURRENT_SOURCE_DIR}/fovead/fovead.8 fovead.8)
compressed(${pages}/fovead.conf.5 fovead.conf.5)
set(FOVEA_PACKAGE_MAINTAINER "fovea contributors <fovea@localhost.localdomain>" CACHE STRING
    "Who answers for the package, with an address")
configure_file(${debian}/changelog.in ${pages}/changelog @ONLY)
compressed(${pages}/changelog changelog)
add_custom_target(fovead_pages ALL DEPENDS ${pages}/fovead.toml ${compressed_files})

# A component of its own, which `cmake --install` of the headers and programs leaves out.
macro(packaged)
  install(${ARGN} COMPONENT fovead EXCLUDE_FROM_ALL)
endmacro()
packaged(TARGETS fovea fovead RUNTIME DESTINATION usr/bin)
packaged(FILES ${pages}/fovead.toml DESTINATION etc/fovea)
packaged(DIRECTORY DESTINATION etc/fovea/jobs)
packaged(FILES fovead/fovead.service DESTINATION lib/systemd/system)
packaged(FILES fovead/60-fovea.rules DESTINATION lib/udev/rules.d)
packaged(FILES fovead/sysusers.conf DESTINATION usr/lib/sysusers.d RENAME fovead.conf)
packaged(FILES ${pages}/fovea.1.gz DESTINATION usr/share/man/man1)
packaged(FILES ${pages}/fovead.conf.5.gz DESTINATION usr/share/man/man5)
packaged(FILES ${pages}/fovead.8.gz DESTINATION usr/share/man/man8)
packaged(FILES ${debian}/lintian-overrides DESTINATION usr/share/lintian/overrides RENAME fovead)
packaged(FILES ${debian}/copyright ${pages}/changelog.gz DESTINATION usr/share/doc/fovead)

# ---- The package --------------------------------------------------------------------------

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL fovead)
set(CPACK_PACKAGE_NAME fovead)
set(CPACK_PACKAGE_VENDOR fovea)
set(CPACK_PACKAGE_CONTACT "${FOVEA_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FOVEAD_PACKAGE_NAME fovead)
set(CPACK_DEBIAN_FOVEAD_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_FOVEAD_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FOVEAD_PACKAGE_CONTROL_EXTRA ${debian}/postinst ${debian}/prerm ${debian}/postrm ${debian}/conffiles)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "measures and decides with a camera")
set(CPACK_COMPONENT_FOVEAD_DESCRIPTION
"fovead takes frames of a camera, measures the part that it sees by a recipe,
and says OK or not OK: on lines of a GPIO chip, on a serial port, and as lines
of JSON. fovea is the tool that teaches recipes from pictures, measures in
pictures, lists the cameras there are and tells what is wrong with them.")
set(architectures x86_64=amd64 aarch64=arm64 arm=armhf riscv64=riscv64)
foreach(pair IN LISTS architectures)
  if(pair MATCHES "^${CMAKE_SYSTEM_PROCESSOR}=(.*)")
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${CMAKE_MATCH_1})
  endif()
endforeach()
if(NOT FOVEA_STATIC AND NOT CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
elseif(NOT FOVEA_STATIC)
  # What the libraries of another architecture need cannot be asked here.
  set(CPACK_DEBIAN_FOVEAD_PACKAGE_DEPENDS "libc6, libgcc-s1, libstdc++6")
endif()
include(CPack)
