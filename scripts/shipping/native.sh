# shellcheck shell=bash disable=SC2154
# The zip that this machine's own compiler builds for its own bpy: what scripts/test tests; sourced by scripts/package.

engine=(native CMakeLists.txt pyproject.toml LICENSE)
native_wheels=$build/wheel/manylinux

# Bundles OpenMesh's library; Debian 12's compiler and C library set the floor. The module is the dev preset's: what the
# C++ tests test is what the zip ships.
build_native_wheel() {
    local content=$build/wheel/content tag
    configure dev
    compile dev --target _core
    rm -rf "$content" "$native_wheels" "$build"/wheel/*.whl
    cmake --install "$build/native" --component python --strip --prefix "$content" >"$build/log/install-native.log"
    cp -r native/python/fairing/. "$content/fairing"
    find "$content" -name __pycache__ -prune -exec rm -r {} +
    tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
    quietly wheel "$python" scripts/shipping/wheel.py --content "$content" --licences "$build/wheel/licences" \
        --tag "$tag-$tag-linux_x86_64" --output "$build/wheel"
    quietly auditwheel "$python" -m auditwheel repair --plat manylinux_2_36_x86_64 \
        --wheel-dir "$native_wheels" "$build"/wheel/*.whl
    install_module "$native_wheels"/*.whl
}

# Debian's copyright files hold the licences of the two libraries that the wheel contains.
gather_native_licences() {
    local folder=$build/wheel/licences
    rm -rf "$folder"
    mkdir -p "$folder/third-party"
    cp LICENSE "$folder/LICENSE"
    cp /usr/share/doc/libopenmesh-dev/copyright "$folder/third-party/OpenMesh.txt"
    cp /usr/share/doc/libeigen3-dev/copyright "$folder/third-party/Eigen.txt"
}

# The wheel and the extension are one release.
check_native_version() {
    compgen -G "$native_wheels/intrinsic_fairing-$(manifest_version)-*.whl" >/dev/null ||
        fail "the manifest says $(manifest_version), but the wheel is $(basename "$native_wheels"/*.whl)"
}

# The wheel takes minutes and changes with the engine alone; the zip takes a second.
package_native() {
    local wheel_stamp=$build/module/.stamp zip_stamp=$build/package/.stamp wheel_wanted zip_wanted
    wheel_wanted=$(fingerprint "${engine[@]}" CMakePresets.json scripts/shipping/{native.sh,wheel.py})
    zip_wanted=$(fingerprint "${engine[@]}" CMakePresets.json addon scripts/package scripts/shipping scripts/lib.sh)
    if ! is_done "$wheel_stamp" "$wheel_wanted"; then
        say "Building the module's wheel"
        gather_native_licences
        build_native_wheel
        printf '%s' "$wheel_wanted" >"$wheel_stamp"
    fi
    if is_done "$zip_stamp" "$zip_wanted" && [[ -f $(zip_path) ]]; then
        say "Package is up to date: $(zip_path)"
        return
    fi
    check_native_version
    say "Building the extension"
    rm -f "$packages"/*.zip
    make_zip "$native" "$build/wheel/licences" "$native_wheels"/*.whl
    printf '%s' "$zip_wanted" >"$zip_stamp"
}
