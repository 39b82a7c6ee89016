# shellcheck shell=bash disable=SC2034,SC2154
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

# Runs a step, unless it has passed with this very input already.
# usage: once NAME INPUT COMMAND…
once() {
    local stamp=$build/stamps/$1 input=$2
    if is_done "$stamp" "$input"; then
        printf '   %s: passed before, and nothing has changed\n' "$1"
        return
    fi
    "${@:3}"
    mkdir -p "$build/stamps"
    printf '%s' "$input" >"$stamp"
}

venv_python() { printf '%s/venv-%s/bin/python' "$build" "$1"; }

manifest_version() { sed -n 's/^version = "\(.*\)"/\1/p' addon/blender_manifest.toml; }

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

# Of the two below: $python is the environment's, which knows where pybind11 is. Sources are compiled in groups, unless
# $unity says OFF: a fresh build takes three fifths of the time.
# usage: configure PRESET [OPTION…]
configure() {
    quietly "$1-configure" cmake --preset "$@" -DFAIRING_UNITY="${unity-ON}" \
        -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)" -DPython_EXECUTABLE="$python"
}

# usage: compile PRESET [OPTION…]
compile() { quietly "$1-compile" cmake --build --preset "$@" --parallel "$(nproc)"; }

# Puts the module that a preset has built beside its Python package: build/PRESET/package.
stage_module() {
    local package=$build/$1/package
    rm -rf "$package"
    mkdir -p "$package"
    cp -r native/python/fairing "$package"
    cp "$build/$1"/native/_core.*.so "$package/fairing"
}

# usage: zip_of FOLDER PLATFORM
zip_of() { printf '%s/intrinsic_fairing-%s-%s.zip' "$1" "$(manifest_version)" "${2//-/_}"; }

# The zip that scripts/package --bpy builds for this machine.
zip_path() { zip_of "$build/package" linux-x64; }

# Lays out the folder that becomes a platform's zip: the add-on with these wheels, renamed to be its own alone.
# usage: stage_extension FOLDER PLATFORM WHEEL…
stage_extension() {
    local staging=$1 platform=$2 wheel
    shift 2
    rm -rf "$staging"
    mkdir -p "$staging/wheels"
    cp -r addon/. "$staging"
    find "$staging" -name __pycache__ -prune -exec rm -r {} +
    cp "$@" "$staging/wheels"
    python3 scripts/shipping/private.py "$staging"
    sed -i "s/^platforms = .*/platforms = [\"$platform\"]/" "$staging/blender_manifest.toml"
    {
        printf '\nwheels = [\n'
        for wheel in "$staging"/wheels/*.whl; do
            printf '  "./wheels/%s",\n' "$(basename "$wheel")"
        done
        printf ']\n'
    } >>"$staging/blender_manifest.toml"
}

# Runs a command in a folder that holds another Debian, this one mounted at /src; the mounts end with the command.
# usage: in_folder FOLDER COMMAND…
in_folder() {
    # shellcheck disable=SC2016 # the inner shell is the one that expands these
    unshare --mount --fork -- bash -c '
        set -e
        mount --make-rprivate /
        chroot=$1 source=$2
        shift 2
        mount -t proc proc "$chroot/proc"
        mount --bind /dev "$chroot/dev"
        mkdir -p "$chroot/src"
        mount --bind "$source" "$chroot/src"
        exec chroot "$chroot" env HOME=/root LC_ALL=C.UTF-8 "$@"
    ' in_folder "$1" "$root" "${@:2}"
}
