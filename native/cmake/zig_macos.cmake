# Read by CMake after its own rules for macOS. zig compiles, LLVM's linker links: zig's makes no bundles, takes no list
# of what to show, and binds the module's C++ library to whatever other copy is loaded.
set(CMAKE_CXX_CREATE_SHARED_MODULE
  "\"${CMAKE_CURRENT_LIST_DIR}/link_macos.sh\" \"${FAIRING_LINKER}\" <TARGET>")
string(APPEND CMAKE_CXX_CREATE_SHARED_MODULE
  " <CMAKE_CXX_COMPILER> <LANGUAGE_COMPILE_FLAGS> -- <OBJECTS> <LINK_LIBRARIES>")
