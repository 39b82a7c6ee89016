# Compiles the sources of a target in groups (scripts/source_groups.py), by this folder's CMakeLists.txt: templates that
# several of them use are instantiated once, and a fresh build takes three fifths of the time.
function(compile_in_groups target)
  if(NOT FAIRING_UNITY)
    return()
  endif()
  find_program(FAIRING_PYTHON3 python3 REQUIRED)
  execute_process(COMMAND "${FAIRING_PYTHON3}" "${PROJECT_SOURCE_DIR}/scripts/source_groups.py" "${CMAKE_CURRENT_LIST_FILE}"
    OUTPUT_VARIABLE source_groups COMMAND_ERROR_IS_FATAL ANY)
  cmake_language(EVAL CODE "${source_groups}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Of headers that other sources of a group include, and of types that are private to a source.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
