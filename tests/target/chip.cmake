# The programs for emulated chips, a board each: golden_<board> where there is room, lines_<board> on all of them.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "cortex-m0")
  fovea_add_board(roomy_microbit FOLDER ${PROJECT_SOURCE_DIR}/ports/bare_metal/microbit
                  MEMORY ${CMAKE_CURRENT_SOURCE_DIR}/roomy_microbit.ld)
endif()

# The levels of optimisation that the host and the boards with Linux do not have, each somewhere.
set(golden_level -O2)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "cortex-m0")
  set(golden_level -Os)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "cortex-m4")
  set(golden_level -O3)
endif()

# What GCC guesses about loops at -O3 is wrong for pictures whose size it sees. With its vectorizer of straight code it
# takes twice as long, for the same instructions within some percent; the M7, which is compared with others, has it.
set(golden_compiler $<$<CXX_COMPILER_ID:GNU>:-Wno-aggressive-loop-optimizations>)
if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "cortex-m7" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND golden_compiler -fno-tree-slp-vectorize)
endif()

# Of the boards of a processor those that have room for it.
set(roomy_boards roomy_microbit mps2_an385 mps2_an386 mps2_an500 mps2_an505 mps3_an547 rv32_virt)
# The operators of the catalogue are taken from costs.cpp, at the level above. Of the other vectors bits alone are compared,
# and GCC needs but 3/5 of the time at -O1; -O2 is seen on the M4, and by Clang, which takes longer at -O1.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "cortex-m4")
  set_source_files_properties(golden.cpp PROPERTIES COMPILE_OPTIONS -O2)
elseif(golden_level STREQUAL "-O2" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(golden.cpp PROPERTIES COMPILE_OPTIONS -O1)
endif()
foreach(board IN LISTS fovea_boards ITEMS roomy_microbit)
  if(TARGET fovea_board_${board} AND board IN_LIST roomy_boards)
    add_executable(golden_${board} costs.cpp golden.cpp)  # what both have is taken of the first
    target_include_directories(golden_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_compile_options(golden_${board} PRIVATE ${golden_level} ${golden_compiler})
    target_link_libraries(golden_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
    # Calibrations and poses are deep where less is optimised.
    target_link_options(golden_${board} PRIVATE -Wl,--defsym=fovea_stack_size=32768)
  endif()
endforeach()

foreach(board IN LISTS fovea_boards)
  add_executable(lines_${board} lines.cpp)
  target_compile_options(lines_${board} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fcallgraph-info=su>)
  target_include_directories(lines_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(lines_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
endforeach()

# Boards whose pins can be driven from outside; one of them has no outputs there.
add_custom_target(pins)
set(boards_with_pins microbit lm3s6965evb netduinoplus2 sifive_e)
foreach(board IN LISTS fovea_boards)
  if(board IN_LIST boards_with_pins)
    add_executable(pins_${board} pins.cpp)
    add_dependencies(pins pins_${board})
    target_compile_definitions(pins_${board} PRIVATE FOVEA_OUTPUTS=$<NOT:$<STREQUAL:${board},netduinoplus2>>)
    target_include_directories(pins_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(pins_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
  endif()
endforeach()

# Boards with a watchdog that the emulator has too.
add_custom_target(watchdogs)
foreach(board IN ITEMS lm3s6965evb mps2_an386 mps2_an500)
  if(board IN_LIST fovea_boards)
    add_executable(watchdog_${board} watchdog.cpp)
    add_dependencies(watchdogs watchdog_${board})
    target_include_directories(watchdog_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(watchdog_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
  endif()
endforeach()

# What reading codes costs, where a frame of QR codes has room.
add_custom_target(code_costs)
foreach(board IN ITEMS mps2_an386 mps2_an500)
  if(board IN_LIST fovea_boards)
    add_executable(code_costs_${board} code_costs.cpp)
    add_dependencies(code_costs code_costs_${board})
    target_include_directories(code_costs_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/apps)
    target_link_libraries(code_costs_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
  endif()
endforeach()

# What numbers and geometry cost, and a whole calibration.
add_custom_target(geometry_costs)
foreach(board IN ITEMS roomy_microbit mps2_an386 rv32_virt)
  if(TARGET fovea_board_${board})
    foreach(program IN ITEMS geometry_costs calibration)
      add_executable(${program}_${board} ${program}.cpp)
      add_dependencies(geometry_costs ${program}_${board})
      target_include_directories(${program}_${board} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
      target_link_libraries(${program}_${board} PRIVATE fovea_core fovea_board_${board} fovea_warnings)
    endforeach()
  endif()
endforeach()
