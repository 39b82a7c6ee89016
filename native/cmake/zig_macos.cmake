# Read by CMake after its own rules for macOS: zig's linker makes no bundles. Python loads a library as well.
set(CMAKE_SHARED_MODULE_CREATE_CXX_FLAGS "-dynamiclib")
