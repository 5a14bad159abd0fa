# The first reading of a component: a script, in which there are no targets, and which ends where the component registers.
set(registered FALSE)
macro(idf_component_register)
  set(registered TRUE PARENT_SCOPE)
  return()
endmacro()

function(read_component)
  include(${COMPONENT_DIR}/CMakeLists.txt)
endfunction()
read_component()

if(NOT registered)
  message(FATAL_ERROR "the component does not register itself")
endif()
