"""Prints the software bill of materials of the packages, CycloneDX 1.5 in JSON.

    sbom.py --zig VERSION --openmesh FOLDER ZIP…

It lists what is linked into the modules, with versions, licences and where it came from, and the
zips with their hashes. No date and no random number: the same packages give the same bytes.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.metadata
import json
import re
import subprocess
import tomllib
import uuid
from pathlib import Path
from typing import Any


def digest(path: Path) -> list[dict[str, str]]:
    """Return CycloneDX's hashes of a file."""
    return [{"alg": "SHA-256", "content": hashlib.sha256(path.read_bytes()).hexdigest()}]


def component(name: str, version: str, licence: str, purl: str, **more: Any) -> dict[str, Any]:
    """Return a library that is linked in."""
    reference = {"type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl}
    return {**reference, "licenses": [{"expression": licence}], **more}


def eigen() -> dict[str, Any]:
    """Eigen, as Debian's package manager knows it."""
    version = subprocess.run(
        ["dpkg-query", "-W", "-f", "${Version}", "libeigen3-dev"], check=True, capture_output=True, text=True
    ).stdout
    return component("Eigen", version, "MPL-2.0", f"pkg:deb/debian/libeigen3-dev@{version}")


def openmesh(folder: Path) -> dict[str, Any]:
    """OpenMesh, from Debian's source package in a folder."""
    (description,) = folder.glob("openmesh_*.dsc")
    (archive,) = folder.glob("openmesh_*.orig.tar.*")
    found = re.search(r"^Version: (\S+)", description.read_text(encoding="utf-8"), re.M)
    if not found:
        raise ValueError(f"{description} names no version")
    purl = f"pkg:deb/debian/openmesh@{found[1]}?arch=source"
    return component("OpenMesh", found[1], "BSD-3-Clause", purl, hashes=digest(archive))


def compiler(version: str) -> list[dict[str, Any]]:
    """What zig links in: its C++ library and run-time libraries, and the start-up code of the platform's C library."""
    purl = f"pkg:pypi/ziglang@{version}"
    parts = {
        "libc++, libc++abi, libunwind": "Apache-2.0 WITH LLVM-exception",
        "compiler-rt of zig": "MIT",
        "mingw-w64 (Windows)": "ZPL-2.1",
        "glibc start-up code (Linux)": "LGPL-2.1-or-later",
    }
    return [
        component(name, f"zig {version}", licence, purl, **{"bom-ref": f"{purl}#{number}"})
        for number, (name, licence) in enumerate(parts.items())
    ]


def packages(zips: list[Path]) -> list[dict[str, Any]]:
    """The zips themselves."""
    return [{"type": "file", "bom-ref": path.name, "name": path.name, "hashes": digest(path)} for path in zips]


def bill(given: argparse.Namespace) -> dict[str, Any]:
    """Return the document."""
    manifest = tomllib.loads(Path("addon/blender_manifest.toml").read_text(encoding="utf-8"))
    pybind11 = importlib.metadata.version("pybind11")
    libraries = [
        openmesh(given.openmesh),
        eigen(),
        component("pybind11", pybind11, "BSD-3-Clause", f"pkg:pypi/pybind11@{pybind11}"),
        *compiler(given.zig),
    ]
    product = {
        "type": "application", "bom-ref": manifest["id"], "name": manifest["id"], "version": manifest["version"],
        "licenses": [{"license": {"id": "GPL-3.0-or-later"}}],
    }  # fmt: skip
    content = {
        "metadata": {"component": product},
        "components": libraries + packages(sorted(given.zips)),
        "dependencies": [{"ref": manifest["id"], "dependsOn": [library["bom-ref"] for library in libraries]}],
    }
    serial = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(content, sort_keys=True))
    head = {"bomFormat": "CycloneDX", "specVersion": "1.5", "serialNumber": f"urn:uuid:{serial}", "version": 1}
    return {**head, **content}


def main() -> None:
    """Print it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--zig", required=True, help="version of ziglang on PyPI")
    parser.add_argument("--openmesh", type=Path, required=True, help="folder with Debian's source package")
    parser.add_argument("zips", type=Path, nargs="+")
    print(json.dumps(bill(parser.parse_args()), indent=2))


if __name__ == "__main__":
    main()
