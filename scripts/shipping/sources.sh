# shellcheck shell=bash disable=SC2034,SC2154,SC2164
# What the wheels are made from besides this repository; sourced by scripts/package.
# All of it lies under build/cross: compiler from PyPI, sources and headers from Debian.

cross=$build/cross
zig=$build/zig/ziglang/zig
declare -A suite_of=([3.11]=bookworm [3.13]=trixie) # Debian's release with that Python

get_zig() {
    if [[ -x $zig ]] && is_done "$build/zig/.version" "$zig_version"; then return; fi
    rm -rf "$build/zig"
    quietly zig "$python" -m pip install --progress-bar off --target "$build/zig" \
        --require-hashes --requirement scripts/locked/zig.txt
    printf '%s' "$zig_version" >"$build/zig/.version"
}

# Debian's mirror as this machine knows it.
mirror() {
    local found
    # shellcheck disable=SC2016 # apt expands this
    found=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Origin: Debian' |
        head -n 1)
    printf '%s' "${found:-http://deb.debian.org/debian}"
}

# apt-get on one release with lists of its own: neither root's rights nor the machine's lists are touched.
# usage: apt_of SUITE ARGUMENT…
apt_of() {
    local suite=$1 apt=$cross/apt/$1 options wanted
    shift
    options='[arch=amd64,arm64 signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]'
    wanted=$(printf "%s $options $(mirror) $suite main\n" deb deb-src)
    if ! is_done "$apt/sources.list" "$wanted"; then
        mkdir -p "$apt/state/lists/partial" "$apt/cache/archives/partial"
        printf '%s\n' "$wanted" >"$apt/sources.list.new"
        run_apt "$apt" -o "Dir::Etc::sourcelist=$apt/sources.list.new" update
        mv "$apt/sources.list.new" "$apt/sources.list"
    fi
    run_apt "$apt" "$@"
}

run_apt() {
    local apt=$1
    shift
    apt-get -o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State=$apt/state" \
        -o "Dir::Cache=$apt/cache" -o APT::Architectures::=amd64 -o APT::Architectures::=arm64 \
        -o "APT::Sandbox::User=$(id -un)" -o Dpkg::Use-Pty=0 "$@"
}

# usage: download FOLDER SUITE APT-ARGUMENT…: into a new folder
download() {
    local folder=$1
    shift
    rm -rf "$folder"
    mkdir -p "$folder"
    (cd "$folder" && quietly "download-$(basename "$folder")" apt_of "$@")
}

get_openmesh() {
    local folder=$cross/openmesh
    if [[ -f $folder/.complete ]]; then return; fi
    download "$cross/download/openmesh" bookworm source --download-only openmesh
    rm -rf "$folder"
    mkdir -p "$folder"
    tar -xf "$cross"/download/openmesh/openmesh_*.orig.tar.* --strip-components 1 -C "$folder"
    touch "$folder/.complete"
}

# Python's headers as Linux and macOS see them, in build/cross/python3.x/unix.
get_headers() {
    local version=$1 folder=$cross/python$1/unix debs=$cross/download/python$1-dev
    if [[ -f $folder/.complete ]]; then return; fi
    download "$debs" "${suite_of[$version]}" download "libpython$version-dev"
    dpkg-deb -x "$debs"/*.deb "$debs/root"
    rm -rf "$folder"
    mkdir -p "$folder"
    cp -r "$debs/root/usr/include/python$version/." "$folder"
    # Debian's own picks by processor, and knows no macOS; both are 64-bit Unix.
    cp "$debs/root/usr/include/x86_64-linux-gnu/python$version/pyconfig.h" "$folder"
    rm -r "$debs/root"
    touch "$folder/.complete"
}

get_python_source() {
    local version=$1 folder=$cross/python$1/source
    if [[ -f $folder/.complete ]]; then return; fi
    download "$cross/download/python$version" "${suite_of[$version]}" source --download-only "python$version"
    rm -rf "$folder"
    mkdir -p "$folder"
    tar -xf "$cross/download/python$version"/python*.orig.tar.?z --strip-components 1 -C "$folder" \
        --wildcards '*/PC/pyconfig.h*' '*/Lib/*'
    touch "$folder/.complete"
}

# The headers with Windows' configuration, and an import library for its DLL.
get_windows_headers() {
    local version=$1 folder=$cross/python$1/windows dll=python${1/./}
    if [[ -f $folder/.complete ]]; then return; fi
    get_headers "$version"
    get_python_source "$version"
    rm -rf "$folder"
    cp -r "$cross/python$version/unix" "$folder"
    cp "$cross/python$version/source/PC"/pyconfig.h* "$folder/pyconfig.h"
    "$python" scripts/shipping/definition_file.py "$folder" "$dll.dll" >"$folder/$dll.def"
    "$zig" dlltool -m i386:x86-64 -d "$folder/$dll.def" -l "$folder/$dll.lib"
    touch "$folder/.complete"
}

get_sources() {
    local platform version
    get_zig
    get_openmesh
    if [[ ${platforms[*]} == *macos-* ]]; then install_packages "$lld"; fi
    for platform in "${platforms[@]}"; do
        for version in "${pythons[@]}"; do
            if [[ $platform == windows-* ]]; then get_windows_headers "$version"; else get_headers "$version"; fi
        done
    done
}
