# shellcheck shell=bash disable=SC2034,SC2154,SC2164
# What scripts/package does with the zips once they are there; sourced by it after build.sh.

checking=$cross/checking
wheel_limit=$((2 * 1024 * 1024))

# What reads modules of all platforms and CycloneDX, in an environment of its own.
make_checking_tools() {
    local wanted
    wanted=$(fingerprint scripts/locked/checking.txt)
    if is_done "$checking/.requirements" "$wanted"; then return; fi
    rm -rf "$checking"
    "$python" -m venv "$checking"
    quietly pip-checking "$checking/bin/python" -m pip install --progress-bar off \
        --require-hashes --only-binary :all: --requirement scripts/locked/checking.txt
    printf '%s' "$wanted" >"$checking/.requirements"
}

# Fails where the module needs more than manylinux_2_28 has.
check_manylinux() {
    local scratch=$cross/auditwheel
    rm -rf "$scratch"
    quietly auditwheel "$python" -m auditwheel repair --plat manylinux_2_28_x86_64 --wheel-dir "$scratch" "$1"
    if "$python" -m zipfile --list "$scratch"/*.whl | grep -q '\.libs/'; then
        fail "$1 needs libraries of this machine"
    fi
}

check_wheels() {
    local wheel
    for wheel in "$build"/wheelhouse/*.whl; do
        (($(stat -c %s "$wheel") <= wheel_limit)) || fail "$wheel is larger than 2 MB"
        # auditwheel reads this machine's kind alone; check_modules.py looks at glibc's version in all.
        if [[ $wheel == *manylinux*x86_64* ]]; then check_manylinux "$wheel"; fi
    done
    make_checking_tools
    "$checking/bin/python" scripts/shipping/check_modules.py "$build"/wheelhouse/*.whl
}

# SBOM and checksums, beside the zips.
write_lists() {
    "$python" scripts/shipping/sbom.py --zig "$zig_version" --openmesh "$cross"/download/openmesh \
        "$packages"/*.zip >"$packages/intrinsic_fairing-$(manifest_version).cdx.json"
    (cd "$packages" && sha256sum -- *.zip *.tar.gz *.json >SHA256SUMS)
}

list_zips() {
    say "Packages"
    (cd "$packages" && stat -c '%9s  %n' -- *)
}

check_everything() {
    local version
    check_sbom
    for version in "${all_bpy[@]}"; do
        scripts/setup --bpy "$version"
        say "One solve in bpy $version"
        use_zip "$(venv_python "$version")" "$(zip_of "$packages" "$native")"
    done
    use_zip_in_python313
    say "The source distribution, by this machine's compiler"
    install_sdist g++
    check_golden
    use_zip_in_windows
}

# usage: use_zip PYTHON ZIP: bpy may hang at its end
use_zip() { timeout --kill-after 10 300 "$1" scripts/shipping/use_zip.py "$2"; }

check_sbom() {
    make_checking_tools
    "$checking/bin/python" scripts/shipping/check_sbom.py "$packages"/*.cdx.json
}

# Debian 12 has no Python 3.13; Debian 13 in a folder has.
use_zip_in_python313() {
    local folder=$build/trixie version
    if ((EUID != 0)); then
        say "Left out: bpy ${all_bpy_of_python313[*]} (its Python 3.13 is installed with debootstrap, as root)"
        return
    fi
    if ! unshare --mount true 2>/dev/null; then
        say "Left out: bpy ${all_bpy_of_python313[*]} (nothing can be mounted here; in a container: --privileged)"
        return
    fi
    make_trixie "$folder"
    for version in "${all_bpy_of_python313[@]}"; do
        install_in_trixie "$folder" "$version"
        say "One solve in bpy $version, Python 3.13"
        in_folder "$folder/root" bash -c "cd /src && timeout --kill-after 10 300 /venv-$version/bin/python \
            scripts/shipping/use_zip.py '$(zip_of build/release "$native")'"
    done
}

make_trixie() {
    local folder=$1 packages
    if [[ -f $folder/.root ]]; then return; fi
    packages=ca-certificates,python3-venv,libx11-6,libxrender1,libxfixes3,libxi6,libxkbcommon0,libsm6,libgl1
    packages+=,libegl1,libxxf86vm1,libgomp1
    mkdir -p "$folder"
    command -v debootstrap >/dev/null || quietly apt-debootstrap apt-get install --yes debootstrap
    rm -rf "$folder/root"
    quietly trixie debootstrap --variant=minbase "--include=$packages" trixie "$folder/root" "$(mirror)"
    touch "$folder/.root"
}

# usage: install_in_trixie FOLDER VERSION: bpy, into /venv-VERSION there
install_in_trixie() {
    local folder=$1 version=$2
    if [[ -f $folder/root/venv-$version/.complete ]]; then return; fi
    # Fetched from outside: certificates and settings of the network are this machine's.
    quietly "download-bpy-$version" "$python" -m pip download --progress-bar off --only-binary :all: \
        --python-version 3.13 "${platforms_of_python313[@]}" --dest "$folder/root/wheels" \
        --require-hashes --requirement "scripts/locked/bpy-$version.txt"
    in_folder "$folder/root" python3 -m venv --clear "/venv-$version"
    quietly "pip-bpy-$version" in_folder "$folder/root" "/venv-$version/bin/python" -m pip install \
        --progress-bar off --no-index --find-links /wheels \
        --require-hashes --requirement "/src/scripts/locked/bpy-$version.txt"
    rm -r "$folder/root/wheels"
    touch "$folder/root/venv-$version/.complete"
}

# Runs a command where, as root, neither a network nor this machine's Eigen and OpenMesh are to be seen.
alone() {
    if ! unshare --mount --net true 2>/dev/null; then
        "$@"
        return
    fi
    # shellcheck disable=SC2016 # the inner shell is the one that expands these
    unshare --mount --net bash -c '
        mount --make-rprivate /
        for folder in /usr/include/eigen3 /usr/share/eigen3 /usr/include/OpenMesh; do
            [[ ! -d $folder ]] || mount -t tmpfs none "$folder"
        done
        exec "$@"' alone "$@"
}

# usage: install_sdist COMPILER [PIP-OPTION…]: into build/venv-COMPILER, with build tools of known hashes
install_sdist() {
    local venv=$build/venv-$1
    rm -rf "$venv"
    "$python" -m venv "$venv"
    quietly "pip-$1" "$venv/bin/python" -m pip install --progress-bar off \
        --require-hashes --only-binary :all: --requirement scripts/locked/sdist.txt
    CXX=$1 quietly "install-$1" alone "$venv/bin/python" -m pip install \
        --no-index --no-deps --no-build-isolation "${@:2}" "$packages"/*.tar.gz
    "$venv/bin/python" -c 'import fairing' # a static library doesn't ask whether all that it calls is there
    if ldd "$venv"/lib/python*/site-packages/fairing/_core.*.so | grep -q OpenMesh; then
        fail "the sdist's module was built with this machine's OpenMesh, not with the one that it brings"
    fi
}

# Packages once more, from a copy of the tree in another folder and as a user with other habits: the bytes are the same.
check_reproduced() {
    local copy=$build/packaged-again/from-a-copy platform
    local -a choice=()
    for platform in "${platforms[@]}"; do choice+=(--platform "$platform"); done
    say "Everything once more, in $copy"
    rm -rf "$copy"
    mkdir -p "$copy"
    git -c safe.directory="$root" ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents --target-directory "$copy"
    (
        umask 077
        TZ=Asia/Kathmandu LC_ALL=C "$copy/scripts/package" "${choice[@]}" --zips-only
    )
    diff --recursive --brief "$packages" "$copy/build/release" || fail "the second build's bytes differ: see $copy/build"
    diff --recursive --brief "$build/repository" "$copy/build/repository" || fail "the second repository differs"
    say "The same bytes from both builds"
    rm -rf "$copy"
}
