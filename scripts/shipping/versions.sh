# shellcheck shell=bash disable=SC2034
# What scripts/package takes besides scripts/setup's environments; scripts/pin writes down, with hashes, what PyPI has.

zig_version=0.17.1
lld='lld-19' # Debian's package, the newest of Debian 12: links for macOS
all_bpy_of_python313=(5.2.3 5.3.0)
platforms_of_python313=(
    --platform manylinux_2_28_x86_64 --platform manylinux_2_27_x86_64
    --platform manylinux_2_17_x86_64 --platform manylinux2014_x86_64
)
# what reads the modules of all platforms, and CycloneDX
checking_tools=('cyclonedx-python-lib[json-validation]==11.12.0' macholib==1.16.4 pefile==2024.8.26 pyelftools==0.33)
# what pip installs to build and use the sdist
sdist_needs=(cmake==4.4.4 ninja==1.13.2 numpy==2.1.0 pybind11==3.1.0 scikit-build-core==1.1.2)
# what makes the site of docs/
site_needs=(mkdocs-material==9.8.2 'mkdocstrings[python]==1.0.8')
# A real CPython for Windows that PyPI has: inside the wheels of an engine that ships it with games.
panda3d_version=1.10.16
declare -A windows_numpy=([3.11]=1.26.4 [3.13]=2.1.0) # the newest that need nothing wine 8 lacks
windows_bpy=5.0.1
cibuildwheel_version=4.3.5
workflow_checkers=(zizmor==1.32.0 check-jsonschema)
# whose meshes the module takes, for scripts/test --libraries
mesh_libraries=(
    plyfile==1.1.3 trimesh==5.2.0 meshio==5.3.5 pyvista==0.49.1 open3d==0.20.0 distributed==2026.8.0 numpy==1.26.4
    pytest==9.2.0 hypothesis scipy
)
