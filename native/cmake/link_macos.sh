#!/usr/bin/env bash
# Links a Python module for macOS by LLVM's linker, from what zig has compiled and the libraries that zig links to.
# usage: link_macos.sh LINKER OUTPUT COMPILER… -- OBJECT…
set -euo pipefail

linker=$1 output=$2
shift 2
compiler=()
while [[ $1 != -- ]]; do
    compiler+=("$1")
    shift
done
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# zig compiles its C++ library, and says where that lies, when it links something itself.
touch "$scratch/empty.cpp"
said=$("${compiler[@]}" -dynamiclib -s --verbose "$scratch/empty.cpp" -o "$scratch/empty.dylib" 2>&1) || {
    printf '%s\n' "$said" >&2
    exit 1
}
readarray -t libraries < <(tr ' ' '\n' <<<"$said" | grep -E '/lib(c\+\+|c\+\+abi|compiler_rt)\.a$')

# zig's list of what the system has names the newest processors alone, and some that LLVM doesn't know; all bind alike.
sed 's/arm64e\(\.x1\)\?-/arm64-/g' "$(dirname "${compiler[0]}")/lib/libc/darwin/libSystem.tbd" >"$scratch/libSystem.tbd"

case ${compiler[*]} in
    *--target=aarch64-*) architecture=arm64 ;;
    *) architecture=x86_64 ;;
esac
"$linker" -arch "$architecture" -platform_version macos 11.0 11.0 -bundle -undefined dynamic_lookup \
    -exported_symbol _PyInit__core -dead_strip -S -x -adhoc_codesign \
    "$@" "${libraries[@]}" "$scratch/libSystem.tbd" -o "$output"
