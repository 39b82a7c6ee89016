# shellcheck shell=bash disable=SC2034
# Shared by the scripts beside it; sourced, never run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
default_bpy=5.0.1
all_bpy=(4.2.23 4.5.15 5.0.1)
export PIP_DISABLE_PIP_VERSION_CHECK=1
cd "$root"

say() { printf '\n== %s\n' "$*"; }

fail() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}

# Runs a long command quietly, with a sign of life every 20 seconds; its output goes to a log
# that is shown when it fails.
# usage: quietly NAME COMMAND…
quietly() {
    local name=$1 log start pid status=0
    shift
    log=$build/log/$name.log
    mkdir -p "$build/log"
    start=$SECONDS
    "$@" >"$log" 2>&1 &
    pid=$!
    while kill -0 "$pid" 2>/dev/null; do
        sleep 1
        if ((SECONDS > start && (SECONDS - start) % 20 == 0)); then
            printf '   %s: %d s, %s\n' "$name" $((SECONDS - start)) "$(tail -n 1 "$log" | cut -c 1-80)"
        fi
    done
    wait "$pid" || status=$?
    if ((status != 0)); then
        tail -n 60 "$log" >&2
        fail "$name failed; all of its output is in $log"
    fi
    printf '   %s: done in %d s\n' "$name" $((SECONDS - start))
}

# Prints one hash of the files and folders given, and of the words after --.
fingerprint() {
    local -a paths=() words=()
    while (($#)) && [[ $1 != -- ]]; do
        paths+=("$1")
        shift
    done
    words=("$@")
    {
        find "${paths[@]}" -type f ! -path '*/__pycache__/*' -print0 | sort -z | xargs -0 sha256sum
        printf '%s\n' "${words[@]}"
    } | sha256sum | cut -d ' ' -f 1
}

# True when the stamp file says that this very input has been dealt with.
is_done() { [[ -f $1 && $(<"$1") == "$2" ]]; }

venv_python() { printf '%s/venv-%s/bin/python' "$build" "$1"; }

# The Python that bpy's wheels are for, preferably Debian's own: its headers come with python3-dev.
find_python() {
    local candidate
    for candidate in /usr/bin/python3.11 python3.11 python3; do
        if "$candidate" -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null; then
            command -v "$candidate"
            return
        fi
    done
    fail "bpy needs Python 3.11, which is not here (Debian 12 has it)"
}

is_installed() { [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

# Installs those of these Debian packages that are missing, as root or with sudo.
install_packages() {
    local -a missing=() sudo=()
    local package
    command -v dpkg-query >/dev/null ||
        fail "this set-up knows Debian's packages only; install by hand: $*"
    for package in "$@"; do
        is_installed "$package" || missing+=("$package")
    done
    if ((${#missing[@]} == 0)); then return; fi
    if ((EUID != 0)); then
        command -v sudo >/dev/null || fail "as root, install first: ${missing[*]}"
        sudo=(sudo)
    fi
    say "Installing Debian packages: ${missing[*]}"
    quietly apt-update "${sudo[@]}" apt-get update
    quietly apt-install "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --yes --no-install-recommends "${missing[@]}"
}

# Puts the module that a preset has built beside its Python package: build/PRESET/package.
stage_module() {
    local package=$build/$1/package
    rm -rf "$package"
    mkdir -p "$package"
    cp -r native/python/fairing "$package"
    cp "$build/$1"/native/_core.*.so "$package/fairing"
}

# The zip that scripts/package has built for the version in the manifest.
zip_path() {
    local version
    version=$(sed -n 's/^version = "\(.*\)"/\1/p' addon/blender_manifest.toml)
    printf '%s/package/intrinsic_fairing-%s.zip' "$build" "$version"
}

# Debian's copyright files hold the licences of the two libraries that the wheel contains.
copy_licences() {
    mkdir "$1/licenses"
    cp LICENSE "$1/LICENSE"
    cp /usr/share/doc/libopenmesh-dev/copyright "$1/licenses/OpenMesh.txt"
    cp /usr/share/doc/libeigen3-dev/copyright "$1/licenses/Eigen.txt"
}

# Lays out the folder that Blender's tool zips: the add-on with these wheels.
# usage: stage_extension FOLDER WHEEL…
stage_extension() {
    local staging=$1 wheel
    shift
    rm -rf "$staging"
    mkdir -p "$staging/wheels"
    cp -r addon/. "$staging"
    find "$staging" -name __pycache__ -prune -exec rm -r {} +
    cp "$@" "$staging/wheels"
    copy_licences "$staging"
    {
        printf '\nwheels = [\n'
        for wheel in "$@"; do
            printf '  "./wheels/%s",\n' "$(basename "$wheel")"
        done
        printf ']\n'
    } >>"$staging/blender_manifest.toml"
}
