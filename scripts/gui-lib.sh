# shellcheck shell=bash disable=SC2034
# What the GUI scripts share; sourced, never run.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

gui=$build/gui
gui_root=$gui/root
gui_suite=trixie

# Runs a command in build/gui/root, this folder mounted at /src.
in_root() { in_folder "$gui_root" "$@"; }
