# shellcheck shell=bash disable=SC2034,SC2154,SC2164
# The golden set (benchmarks/golden.py) by every compiler here, on Windows' Python under wine and on Debian's for ARM
# under qemu; sourced by scripts/package after checks.sh.

golden=$build/golden
wine=/usr/lib/wine/wine64 # Debian's wrapper wants 32-bit wine too

check_golden() {
    local version
    local -a found=("$golden/zig.npz")
    rm -rf "$golden"
    "$python" benchmarks/golden.py inputs "$golden/inputs"
    install_module "$(wheels_of "$native" 3.11)"
    PYTHONPATH=$build/module solve_golden zig "$python"
    solve_golden g++ "$build/venv-g++/bin/python" && found+=("$golden/g++.npz")
    if get_debian clang++ clang; then
        install_sdist clang++ --config-settings=cmake.define.FAIRING_PRECOMPILE=OFF # each source asks for all it uses
        solve_golden clang++ "$build/venv-clang++/bin/python" && found+=("$golden/clang++.npz")
    fi
    if makes windows-x64 && get_debian "$wine" wine64; then
        for version in "${pythons[@]}"; do
            make_windows_python "$version"
            solve_golden_in_wine "$version" && found+=("$golden/windows-$version.npz")
        done
    fi
    if makes linux-arm64 && get_debian qemu-aarch64 qemu-user; then
        make_arm_python
        solve_golden linux-arm64 in_arm && found+=("$golden/linux-arm64.npz")
    fi
    say "Golden set: largest distances over D"
    "$python" benchmarks/golden.py compare "${found[@]}"
}

# usage: get_debian COMMAND PACKAGE: false, with a message, where it isn't there and can't be installed
get_debian() {
    command -v "$1" >/dev/null && return
    if ((EUID != 0)); then
        say "Left out of the golden set: $2 (as root: apt-get install $2)"
        return 1
    fi
    quietly "apt-$2" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "$2"
}

# usage: solve_golden NAME PYTHON
solve_golden() { quietly "golden-$1" "$2" benchmarks/golden.py solve "$golden/inputs" "$golden/$1.npz"; }

# A folder with python.exe for Windows, its library, numpy and the wheel's module.
make_windows_python() {
    local version=$1 digits=${1/./} folder=$build/wine/python$1 wheel
    rm -rf "$folder/site"
    if [[ ! -f $folder/.complete ]]; then
        rm -rf "$folder"
        mkdir -p "$folder/download"
        get_windows_headers "$version"
        quietly "windows-python-$version" "$python" -m pip download --no-deps --only-binary :all: \
            --platform win_amd64 --python-version "$version" --dest "$folder/download" \
            --require-hashes --requirement "scripts/locked/windows-$version.txt"
        "$python" -m zipfile --extract "$folder"/download/panda3d-*.whl "$folder/panda3d"
        mv "$folder"/panda3d/deploy_libs/* "$folder"
        rm -r "$folder/panda3d" "$folder"/api-ms-*
        cp -r "$cross/python$version/source/Lib" "$folder/Lib"
        # Elsewhere than above zig's own folder: its cache distinguishes relative paths, and would compile all anew.
        (cd "$folder" && "$zig" cc -target x86_64-windows-gnu -municode -O3 -s "$root/scripts/shipping/launcher.c" \
            "$cross/python$version/windows/python$digits.lib" -o python.exe)
        touch "$folder/.complete"
    fi
    mkdir "$folder/site"
    "$python" -m zipfile --extract "$folder"/download/numpy-*.whl "$folder/site"
    readarray -t wheel < <(wheels_of windows-x64 "$version")
    "$python" -m zipfile --extract "${wheel[0]}" "$folder/site"
}

solve_golden_in_wine() {
    local folder=$build/wine/python$1
    export WINEPREFIX=$build/wine/prefix WINEDEBUG=-all DISPLAY=
    in_wine reg add 'HKCU\Software\Wine' /v Version /d win10 /f
    PYTHONPATH="$folder/site" quietly "golden-windows-$1" in_wine "$folder/python.exe" \
        benchmarks/golden.py solve "$golden/inputs" "$golden/windows-$1.npz"
}

in_wine() { timeout --kill-after 10 900 "$wine" "$@" </dev/null 2>&1 | cat; }

# Debian's Python 3.11 for 64-bit ARM in a folder, numpy and the wheel's module.
make_arm_python() {
    local folder=$build/arm wheel file
    local -a debs=(python3.11-minimal libpython3.11-minimal libpython3.11-stdlib libc6 libexpat1 libffi8 libgcc-s1 zlib1g)
    rm -rf "$folder/site"
    if [[ ! -f $folder/.complete ]]; then
        rm -rf "$folder"
        download "$folder/debs" bookworm download "${debs[@]/%/:arm64}"
        for file in "$folder"/debs/*.deb; do dpkg-deb -x "$file" "$folder/root"; done
        quietly numpy-linux-arm64 "$python" -m pip download --no-deps --only-binary :all: \
            --platform manylinux2014_aarch64 --python-version 3.11 --dest "$folder/download" \
            --require-hashes --requirement scripts/locked/linux-arm64.txt
        touch "$folder/.complete"
    fi
    mkdir "$folder/site"
    readarray -t wheel < <(wheels_of linux-arm64 3.11)
    for file in "$folder"/download/*.whl "${wheel[0]}"; do "$python" -m zipfile --extract "$file" "$folder/site"; done
}

# usage: in_arm ARGUMENT…: of Python
in_arm() {
    PYTHONPATH=$build/arm/site qemu-aarch64 -L "$build/arm/root" "$build/arm/root/usr/bin/python3.11" "$@"
}
