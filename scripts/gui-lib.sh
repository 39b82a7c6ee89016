# shellcheck shell=bash disable=SC2034
# What the GUI scripts share; sourced, never run.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

gui=$build/gui
gui_root=$gui/root
gui_suite=trixie

# Runs a command in build/gui/root, this folder mounted at /src; the mounts end with the command.
in_root() {
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
    ' in_root "$gui_root" "$root" "$@"
}
