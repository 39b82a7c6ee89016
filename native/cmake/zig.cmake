# Toolchain file: the platforms that the extension ships for, from any machine that runs zig.
#   cmake -DCMAKE_TOOLCHAIN_FILE=native/cmake/zig.cmake -DFAIRING_ZIG=<zig> -DFAIRING_PLATFORM=<linux-x64 …>
#         -DFAIRING_PYTHON_HEADERS=<folder with that platform's Python.h> [-DFAIRING_PYTHON_LIBRARY=<.lib, Windows>]
#         [-DFAIRING_LINKER=<LLVM's ld64.lld, macOS>]
# Floors: glibc 2.28 (manylinux_2_28), macOS 11.0, Windows with the universal C runtime.

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES
  FAIRING_ZIG FAIRING_PLATFORM FAIRING_PYTHON_HEADERS FAIRING_PYTHON_LIBRARY FAIRING_LINKER)
if(FAIRING_PLATFORM STREQUAL "linux-x64")
  set(CMAKE_SYSTEM_NAME Linux)
  set(CMAKE_SYSTEM_PROCESSOR x86_64)
  set(zig_target x86_64-linux-gnu.2.28)
elseif(FAIRING_PLATFORM STREQUAL "linux-arm64")
  set(CMAKE_SYSTEM_NAME Linux)
  set(CMAKE_SYSTEM_PROCESSOR aarch64)
  set(zig_target aarch64-linux-gnu.2.28)
elseif(FAIRING_PLATFORM STREQUAL "windows-x64")
  set(CMAKE_SYSTEM_NAME Windows)
  set(CMAKE_SYSTEM_PROCESSOR AMD64)
  set(zig_target x86_64-windows-gnu)
elseif(FAIRING_PLATFORM STREQUAL "macos-arm64")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_SYSTEM_PROCESSOR arm64)
  set(zig_target aarch64-macos.11.0)
elseif(FAIRING_PLATFORM STREQUAL "macos-x64")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_SYSTEM_PROCESSOR x86_64)
  set(zig_target x86_64-macos.11.0)
else()
  message(FATAL_ERROR "FAIRING_PLATFORM=${FAIRING_PLATFORM}: "
                      "it should be linux-x64, linux-arm64, windows-x64, macos-arm64 or macos-x64")
endif()

set(CMAKE_CXX_COMPILER "${FAIRING_ZIG}" c++)
set(CMAKE_CXX_COMPILER_TARGET ${zig_target})
# CMake's trials compile only: at the first link zig compiles the target's C++ library, in each kind of build anew.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# zig's own archiver: the machine's may not know the target's object files. D: no dates, no owners.
set(CMAKE_CXX_ARCHIVE_CREATE "\"${FAIRING_ZIG}\" ar qcD <TARGET> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_APPEND "\"${FAIRING_ZIG}\" ar qD <TARGET> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_FINISH "\"${FAIRING_ZIG}\" ranlib -D <TARGET>")
set(CMAKE_STRIP "")  # likewise: the linker strips
set(CMAKE_INTERPROCEDURAL_OPTIMIZATION OFF)
set(FAIRING_UNITY ON)  # each build here is a fresh one
get_filename_component(source_root "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
set(CMAKE_CXX_FLAGS_INIT "-ffile-prefix-map=${source_root}/=")  # no path of this machine in the module
string(APPEND CMAKE_CXX_FLAGS_INIT " -DPYBIND11_EXPORT_EXCEPTION=")  # else Windows' module shows pybind11's classes
set(CMAKE_CXX_FLAGS_RELEASE_INIT "-g0 -fno-sanitize=undefined")  # zig checks for undefined behaviour by default
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-s")

# This machine's libraries are none of the target's: its libpython would decide which headers fit.
set(CMAKE_FIND_ROOT_PATH "${FAIRING_PYTHON_HEADERS}")
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)

# No Python of the target runs here: say what it would have said.
file(STRINGS "${FAIRING_PYTHON_HEADERS}/patchlevel.h" python_minor REGEX "^#define PY_MINOR_VERSION")
string(REGEX MATCH "[0-9]+$" python_minor "${python_minor}")
set(Python_INCLUDE_DIR "${FAIRING_PYTHON_HEADERS}")
set(PYBIND11_USE_CROSSCOMPILING ON)
set(PYTHON_IS_DEBUG OFF)
set(PYTHON_MODULE_DEBUG_POSTFIX "")
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  set(PYTHON_MODULE_EXTENSION ".cpython-3${python_minor}-${CMAKE_SYSTEM_PROCESSOR}-linux-gnu.so")
  string(APPEND CMAKE_MODULE_LINKER_FLAGS_INIT " -Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/module.map")
elseif(CMAKE_SYSTEM_NAME STREQUAL Windows)
  set(PYTHON_MODULE_EXTENSION ".cp3${python_minor}-win_amd64.pyd")
  set(Python_LIBRARY "${FAIRING_PYTHON_LIBRARY}")
else()
  set(PYTHON_MODULE_EXTENSION ".cpython-3${python_minor}-darwin.so")
  # zig brings Apple's headers. Their math.h takes a part of float.h, whose guard then keeps the rest out.
  string(APPEND CMAKE_CXX_FLAGS_INIT " -DFLT_MAX=__FLT_MAX__")
  set(CMAKE_OSX_SYSROOT "")
  set(CMAKE_USER_MAKE_RULES_OVERRIDE_CXX "${CMAKE_CURRENT_LIST_DIR}/zig_macos.cmake")
  set(CMAKE_INSTALL_NAME_TOOL "${FAIRING_ZIG}")
endif()
