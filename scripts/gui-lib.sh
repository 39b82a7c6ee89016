# shellcheck shell=bash disable=SC2034
# What the GUI scripts share; sourced, never run.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

gui=$build/gui
gui_root=$gui/root
gui_suite=trixie

# Runs a command in build/gui/root, this folder mounted at /src.
in_root() { in_folder "$gui_root" "$@"; }

# Empties what the last window left; a zip has to be there.
fresh_window() {
    zip=$(find "$gui/package" -name '*.zip' -print -quit 2>/dev/null || true)
    [[ -n $zip ]] || fail "run scripts/gui-setup first"
    out=$gui/out
    rm -rf "$out" "$gui/resources"
    mkdir -p "$out" "$gui/resources"
}

# usage: blender_in_root ARGUMENT…
blender_in_root() {
    in_root env BLENDER_USER_RESOURCES=/src/build/gui/resources FAIRING_ZIP="/src/${zip#"$root"/}" \
        FAIRING_GUI_OUT=/src/build/gui/out LIBGL_ALWAYS_SOFTWARE=1 FAIRING_CHAPTERS="${chapters-}" \
        timeout --kill-after 10 1200 "$@"
}

# Runs a script of ours in a Blender with a window; usage: play_script NAME SCRIPT
play_script() {
    local name=$1 status=0
    blender_in_root xvfb-run -a -s "-screen 0 1600x1000x24" blender --factory-startup \
        --enable-event-simulate -p 0 0 1600 1000 --python "/src/$2" >"$out/$name.log" 2>&1 || status=$?
    if ((status != 0)); then
        cat "$out/record.txt" >&2
        fail "$name ended with $status; see $out"
    fi
}
