# shellcheck shell=bash disable=SC2034,SC2154,SC2164
# Wheels, zips and the sdist; sourced by scripts/package after compile.sh.

declare -A wheel_platform=(
    [linux-x64]=manylinux_2_28_x86_64 [linux-arm64]=manylinux_2_28_aarch64 [windows-x64]=win_amd64
    [macos-arm64]=macosx_11_0_arm64 [macos-x64]=macosx_11_0_x86_64
)

# The licences of all that is linked into a platform's module.
gather_licences() {
    local platform=$1 folder=$cross/licences/$1 library
    rm -rf "$folder"
    mkdir -p "$folder/third-party"
    cp LICENSE "$folder/LICENSE"
    cd "$folder/third-party"
    cp "$cross/openmesh/LICENSE" OpenMesh.txt
    cp /usr/share/doc/libeigen3-dev/copyright Eigen.txt
    cp "$("$python" -c 'import pybind11; print(pybind11.__path__[0])')"-*.dist-info/licenses/LICENSE pybind11.txt
    for library in libcxx libcxxabi libunwind; do
        cp "$build/zig/ziglang/lib/$library/LICENSE.TXT" "$library.txt"
    done
    cp "$build/zig/ziglang/LICENSE" zig-compiler-rt.txt
    case $platform in
        linux-*) cp "$build/zig/ziglang/lib/libc/glibc/LICENSES" glibc.txt ;;
        windows-*) cp "$build/zig/ziglang/lib/libc/mingw/COPYING" mingw-w64.txt ;;
    esac
    cd "$root"
}

# usage: build_wheel PLATFORM PYTHON
build_wheel() {
    local tag=cp${2/./}
    build_module "$1" "$2"
    gather_licences "$1"
    mkdir -p "$build/wheelhouse"
    "$python" scripts/shipping/wheel.py --content "$cross/stage/$1-$2" --licences "$cross/licences/$1" \
        --tag "$tag-$tag-${wheel_platform[$1]}" --output "$build/wheelhouse"
}

# Wheels of the version in the manifest, for one platform; the wheel and the extension are one release.
# usage: wheels_of PLATFORM PYTHON…
wheels_of() {
    local platform=$1 version wheel
    shift
    for version in "$@"; do
        wheel=$build/wheelhouse/intrinsic_fairing-$(manifest_version)-cp${version/./}-cp${version/./}-${wheel_platform[$platform]}.whl
        [[ -f $wheel ]] || fail "the manifest says $(manifest_version), but $wheel is not there"
        printf '%s\n' "$wheel"
    done
}

# usage: make_zip PLATFORM LICENCES WHEEL…
make_zip() {
    local staging=$build/staging/$1 target
    target=$(zip_of "$packages" "$1")
    stage_extension "$staging" "$1" "${@:3}"
    cp -r "$2/." "$staging"
    mkdir -p "$packages"
    "$python" scripts/shipping/archive.py "$staging" "$target"
    "$python" "$(extension_tool)" validate "$target"
}

# From a copy: the backend walks all that lies beside the sources, build/ too. Eigen's headers and the part of OpenMesh
# that is used go with it, so that a compiler is all that it needs.
make_sdist() {
    local staging=$build/staging/sdist third=$build/staging/sdist/third_party
    rm -rf "$staging"
    mkdir -p "$staging" "$third/openmesh/src/OpenMesh/Tools" "$third/eigen/unsupported/Eigen/src"
    cp -r "${engine[@]}" README.md CHANGELOG.md tests docs "$staging"
    rm -r "$staging"/docs/{pictures,dev} "$staging"/tests/{blender,addon_core}
    cp -r "$cross/openmesh/src/OpenMesh/Core" "$third/openmesh/src/OpenMesh"
    cp -r "$cross"/openmesh/src/OpenMesh/Tools/{Decimater,Utils} "$third/openmesh/src/OpenMesh/Tools"
    cp -r /usr/include/eigen3/Eigen "$third/eigen"
    cp -r /usr/include/eigen3/unsupported/Eigen/BVH "$third/eigen/unsupported/Eigen"
    cp -r /usr/include/eigen3/unsupported/Eigen/src/BVH "$third/eigen/unsupported/Eigen/src"
    cp "$cross/openmesh/LICENSE" "$staging/LICENSE.OpenMesh"
    cp /usr/share/doc/libeigen3-dev/copyright "$staging/LICENSE.Eigen"
    find "$staging" -name __pycache__ -prune -exec rm -r {} +
    cd "$staging"
    quietly sdist "$python" -c "from scikit_build_core.build import build_sdist; build_sdist('$packages')"
    cd "$root"
}

# A repository of all zips, for a static host: build/repository.
make_repository() {
    quietly repository "$python" scripts/shipping/repository.py "$build/repository" "$packages"/*.zip
}

# Blender's own command-line tool for extensions, out of the bpy at hand.
extension_tool() { find "$build/venv-$bpy/" -path '*/bl_pkg/cli/blender_ext.py' -print -quit; }
