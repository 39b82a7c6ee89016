"""Checks the native modules in wheels: what they ask of the system, what they show of themselves, what was left in.

check_modules.py WHEEL…

Each shows Python's entry point alone, holds no symbols for a debugger and no path of the machine that
compiled it, and needs nothing that the oldest system it is for doesn't bring.
"""

from __future__ import annotations

import io
import re
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pefile
from elftools.elf.elffile import ELFFile
from macholib import mach_o
from macholib.MachO import MachO, MachOHeader
from macholib.SymbolTable import SymbolTable

import macos_module

ROOT = Path(__file__).parents[2]
ENTRY = {"PyInit__core"}
LIBRARIES = {
    "linux": re.compile(r"(libc|libm|libdl|libpthread|librt)\.so\.\d+|ld-linux-(x86-64\.so\.2|aarch64\.so\.1)"),
    "win": re.compile(r"python3\d+\.dll|(kernel32|ntdll|advapi32)\.dll|api-ms-win-crt-[a-z]+-l1-1-0\.dll", re.I),
    "macosx": re.compile(r"/usr/lib/libSystem\.B\.dylib"),
}
GLIBC = (2, 28)
MACOS = (11, 0)


class Module:
    """What a module asks for and shows; `faults` are the peculiarities of its format."""

    def __init__(self, libraries: list[str], shown: set[str], faults: list[str]) -> None:
        self.libraries, self.shown, self.faults = libraries, shown, faults


def read_elf(content: bytes) -> Module:
    """Linux: also the newest version of glibc's symbols that are asked for."""
    file = ELFFile(io.BytesIO(content))
    symbols = file.get_section_by_name(".dynsym").iter_symbols()
    shown = {symbol.name for symbol in symbols if symbol.name and symbol["st_shndx"] != "SHN_UNDEF"}
    asked = [
        tuple(map(int, version.name.removeprefix("GLIBC_").split(".")))
        for _, versions in file.get_section_by_name(".gnu.version_r").iter_versions()
        for version in versions
    ]
    faults = [f"glibc {max(asked)} instead of {GLIBC}"] if max(asked) > GLIBC else []
    faults += [f"{name} is left in" for name in (".symtab", ".debug_info") if file.get_section_by_name(name)]
    tags = file.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")
    return Module([tag.needed for tag in tags], shown, faults)


def read_pe(content: bytes) -> Module:
    """Windows."""
    file = pefile.PE(data=content)
    debug = [section.Name for section in file.sections if section.Name.startswith(b".debug")]
    faults = [f"{name!r} is left in" for name in debug]
    if file.FILE_HEADER.NumberOfSymbols:
        faults.append("a symbol table is left in")
    shown = {symbol.name.decode() for symbol in file.DIRECTORY_ENTRY_EXPORT.symbols}
    return Module([entry.dll.decode() for entry in file.DIRECTORY_ENTRY_IMPORT], shown, faults)


def oldest_macos(header: MachOHeader) -> tuple[int, int] | None:
    """The version of macOS that the module says it needs."""
    for _, command, _ in header.commands:
        if isinstance(command, mach_o.build_version_command):
            number = int(command.minos)
        elif isinstance(command, mach_o.version_min_command):
            number = int(command.version)
        else:
            continue
        return number >> 16, number >> 8 & 0xFF
    return None


def read_macho(content: bytes) -> Module:
    """macOS: also the signature, and that no other module's functions can take the place of its own."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(content)
        file.flush()
        image = MachO(file.name)
        (header,) = image.headers
        symbols = SymbolTable(image).nlists
    shown = macos_module.exported(content, header)
    left = sorted(macos_module.names_left_in(symbols, shown))
    faults = [f"{left[:5]}, {len(left)} in all, are left in"] if left else []
    oldest = oldest_macos(header)
    if oldest != MACOS:
        faults.append(f"macOS {oldest} instead of {MACOS}")
    if not macos_module.is_signed(content, header):
        faults.append("no signature that fits")
    if macos_module.binds_weakly(content, header):
        faults.append("shares functions with other modules")
    asked = macos_module.asked_of_all(symbols)
    faults += [f"asks for {name}" for name in asked if not name.startswith(("_Py", "__Py"))]
    libraries = [name for _, _, name in header.walkRelocatables()]
    return Module(libraries, {name.removeprefix("_") for name in shown}, faults)


READERS: dict[str, Callable[[bytes], Module]] = {"linux": read_elf, "win": read_pe, "macosx": read_macho}


def faults(system: str, content: bytes, module: Module) -> Iterator[str]:
    """Yield what is wrong with a module."""
    yield from module.faults
    for library in module.libraries:
        if not LIBRARIES[system].fullmatch(library):
            yield f"needs {library}"
    if module.shown != ENTRY:
        yield f"shows {sorted(module.shown)[:5]}, {len(module.shown)} in all, instead of {sorted(ENTRY)}"
    if bytes(ROOT) in content:
        yield f"names {ROOT}"


def check(wheel: Path) -> bool:
    """Print what a wheel's module needs and what is wrong with it; true where nothing is."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith((".so", ".pyd")))
        content = archive.read(name)
    (system,) = (system for system in READERS if re.search(rf"-(many)?{system}[^-]*$", wheel.stem))
    module = READERS[system](content)
    print(f"{wheel.name} needs {', '.join(sorted(module.libraries))}")
    wrong = list(faults(system, content, module))
    for fault in wrong:
        print(f"   {fault}")
    return not wrong


if __name__ == "__main__":
    failed = [path for path in sys.argv[1:] if not check(Path(path))]
    sys.exit(1 if failed else 0)
