# shellcheck shell=bash disable=SC2154
# The engine's module for each platform, by zig; sourced by scripts/package after sources.sh.

export ZIG_GLOBAL_CACHE_DIR=$build/zig-cache ZIG_LOCAL_CACHE_DIR=$build/zig-cache

# One hash of all that a platform's modules are compiled from.
inputs_of() {
    fingerprint native CMakeLists.txt pyproject.toml scripts/source_groups.py scripts/shipping/compile.sh \
        scripts/locked/{"bpy-$bpy",zig}.txt "$cross/openmesh" "$cross"/python*/unix /usr/include/eigen3 -- "$1" "$(dpkg-query -W "$lld" 2>/dev/null)"
}

# usage: build_module PLATFORM PYTHON: compiles and installs to build/cross/stage/PLATFORM-PYTHON.
# One build folder per platform: the second Python compiles its bindings alone. It begins from scratch where anything
# has changed, since zig's dependency files miss precompiled headers.
build_module() {
    local platform=$1 version=$2 folder=$cross/$1 stage=$cross/stage/$1-$2 headers=$cross/python$2/unix library='' inputs
    inputs=$(inputs_of "$platform")
    if is_done "$stage.inputs" "$inputs"; then return; fi
    if ! is_done "$folder/.inputs" "$inputs"; then
        rm -rf "$folder"
        mkdir -p "$folder"
        printf '%s' "$inputs" >"$folder/.inputs"
    fi
    if [[ $platform == windows-* ]]; then
        headers=$cross/python$version/windows
        library=$headers/python${version/./}.lib
    fi
    quietly "configure-$platform-$version" cmake -S . -B "$folder" -G Ninja \
        -U 'Python_*' -U '_Python_*' -U 'PYTHON_*' \
        -DCMAKE_TOOLCHAIN_FILE="$root/native/cmake/zig.cmake" -DFAIRING_ZIG="$zig" \
        -DFAIRING_PLATFORM="$platform" -DFAIRING_PYTHON_HEADERS="$headers" -DFAIRING_PYTHON_LIBRARY="$library" \
        -DFAIRING_LINKER="ld64.$lld" \
        -DFAIRING_BUILD_TESTS=OFF -DFAIRING_OPENMESH_SOURCE="$cross/openmesh" \
        -DEigen3_DIR=/usr/share/eigen3/cmake -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)"
    quietly "compile-$platform-$version" cmake --build "$folder" --target _core --parallel "$(nproc)"
    rm -rf "$stage"
    cmake --install "$folder" --component python --prefix "$stage" >"$build/log/install-$platform-$version.log"
    cp -r native/python/fairing/. "$stage/fairing"
    printf '%s' "$inputs" >"$stage.inputs"
}
