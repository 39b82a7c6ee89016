# shellcheck shell=bash disable=SC2154
# The zip for Windows in bpy's wheel for Windows, under wine; sourced by scripts/package after golden.sh.

windows_site=$build/wine/bpy-$windows_bpy # what pip would have installed

use_zip_in_windows() {
    makes windows-x64 && get_debian "$wine" wine64 || return 0
    make_windows_bpy
    say "One solve in bpy $windows_bpy for Windows, under wine"
    in_bpy_for_windows scripts/shipping/use_zip.py "$(zip_of "$packages" windows-x64)"
}

# bpy, and what it and its tests import; Python itself is the golden set's.
make_windows_bpy() {
    local wanted wheel
    wanted=$(fingerprint "scripts/locked/windows-bpy-$windows_bpy.txt")
    if is_done "$windows_site/.requirements" "$wanted"; then return; fi
    rm -rf "$windows_site" "$windows_site-wheels"
    quietly "windows-bpy-$windows_bpy" "$python" -m pip download --no-deps --only-binary :all: --progress-bar off \
        --platform win_amd64 --python-version 3.11 --dest "$windows_site-wheels" \
        --require-hashes --requirement "scripts/locked/windows-bpy-$windows_bpy.txt"
    mkdir -p "$windows_site"
    for wheel in "$windows_site-wheels"/*.whl; do "$python" -m zipfile --extract "$wheel" "$windows_site"; done
    rm -r "$windows_site-wheels"
    printf '%s' "$wanted" >"$windows_site/.requirements"
}

# usage: in_bpy_for_windows ARGUMENT…: of Python; the first call loads all of Blender's libraries, which takes a while
in_bpy_for_windows() {
    WINEPREFIX=$build/wine/prefix WINEDEBUG=-all DISPLAY='' PYTHONPATH=$windows_site \
        in_wine "$build/wine/python3.11/python.exe" "$@"
}
