"""Runs a Python script on Linux with the engine's module for macOS on Intel.

    darwin.py FUNCTIONS MODULE SCRIPT ARGUMENT…

FUNCTIONS is darwin.c, compiled. It is no macOS: Linux' C library stands for Apple's, and a C++ exception ends the
process, since Linux can't read how the module unwinds. It tells that the module is whole and computes what others do.
"""

from __future__ import annotations

import ctypes
import importlib.machinery
import mmap
import os
import runpy
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

from macholib import mach_o
from macholib.MachO import MachO

import macos_module

ADDRESSES = 1 << 64
POINTER = 8
OWN = "fairing._core"
C_INTERFACE = 1013  # of Python's modules, "PYTHON_API_VERSION"


def rebased(opcodes: bytes, segments: list[int]) -> Iterator[int]:
    """Yield the places of the module's pointers into itself."""
    at = address = 0
    while at < len(opcodes):
        opcode, low = opcodes[at] & 0xF0, opcodes[at] & 0x0F
        count, skip, at = 0, 0, at + 1
        if opcode in (0x20, 0x30, 0x60, 0x70, 0x80):
            number, at = macos_module.variable_length(opcodes, at)
        match opcode:
            case 0x20:
                address = segments[low] + number
            case 0x30:
                address += number
            case 0x40:
                address += POINTER * low
            case 0x50:
                count = low
            case 0x60:
                count = number
            case 0x70:
                count, skip = 1, number
            case 0x80:
                count = number
                skip, at = macos_module.variable_length(opcodes, at)
        for _ in range(count):
            yield address % ADDRESSES
            address += POINTER + skip


def bound(opcodes: bytes, segments: list[int]) -> Iterator[tuple[int, str]]:
    """Yield the places of its pointers to what others bring, and what that is called."""
    at = address = 0
    name = ""
    while at < len(opcodes):
        opcode, low = opcodes[at] & 0xF0, opcodes[at] & 0x0F
        count, skip, at = 0, 0, at + 1
        if opcode in (0x20, 0x70, 0x80, 0xA0, 0xC0):
            number, at = macos_module.variable_length(opcodes, at)
        match opcode:
            case 0x40:
                end = opcodes.index(0, at)
                name, at = opcodes[at:end].decode(), end + 1
            case 0x60:
                raise ValueError(f"{name} is bound with an offset")
            case 0x70:
                address = segments[low] + number
            case 0x80:
                address += number
            case 0x90:
                count = 1
            case 0xA0:
                count, skip = 1, number
            case 0xB0:
                count, skip = 1, POINTER * low
            case 0xC0:
                count = number
                skip, at = macos_module.variable_length(opcodes, at)
        for _ in range(count):
            yield address % ADDRESSES, name
            address += POINTER + skip


class Image:
    """A module in memory."""

    def __init__(self, functions: Path, module: Path) -> None:
        self.functions = ctypes.CDLL(str(functions))
        self.others = [ctypes.CDLL(name) for name in (None, "libm.so.6", "libgcc_s.so.1")]
        self.kept: list[Any] = []
        self.content = module.read_bytes()
        (self.header,) = MachO(str(module)).headers
        self.segments = [data for load, data, _ in self.header.commands if load.cmd == mach_o.LC_SEGMENT_64]
        self.sections = {
            section.sectname.rstrip(b"\0").decode(): section
            for load, _, sections in self.header.commands
            if load.cmd == mach_o.LC_SEGMENT_64
            for section in sections
        }
        self.base = self.place()
        self.connect()
        self.start()

    def place(self) -> int:
        """Copy the segments to where they are to run; return where that is."""
        size = max(segment.vmaddr + segment.vmsize for segment in self.segments)
        self.memory = mmap.mmap(-1, size, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
        for segment in self.segments:
            part = self.content[segment.fileoff : segment.fileoff + segment.filesize]
            self.memory[segment.vmaddr : segment.vmaddr + len(part)] = part
        return ctypes.addressof(ctypes.c_char.from_buffer(self.memory))

    def pointer(self, address: int) -> ctypes.c_uint64:
        """Return the pointer at an address of the file, to read or to set."""
        return ctypes.c_uint64.from_address(self.base + address)

    def address_of(self, name: str) -> int:
        """Return where a function or variable of macOS is, by its name there."""
        for library, called in [(self.functions, f"mac{name}"), *((other, name[1:]) for other in self.others)]:
            if hasattr(library, called):
                return ctypes.cast(getattr(library, called), ctypes.c_void_p).value or 0
        return self.missing(name)

    def missing(self, name: str) -> int:
        """Return the address of a function that ends the process; most that neither library has are never called."""

        def end() -> None:
            os.write(2, f"darwin.c lacks {name}\n".encode())
            os.abort()

        self.kept.append(ctypes.CFUNCTYPE(None)(end))
        return ctypes.cast(self.kept[-1], ctypes.c_void_p).value or 0

    def connect(self) -> None:
        """Set all pointers that depend on where the module and others are."""
        info = macos_module.command(self.header, mach_o.LC_DYLD_INFO_ONLY)
        starts = [segment.vmaddr for segment in self.segments]
        for address in rebased(self.content[info.rebase_off : info.rebase_off + info.rebase_size], starts):
            self.pointer(address).value += self.base
        for offset, size in ((info.bind_off, info.bind_size), (info.lazy_bind_off, info.lazy_bind_size)):
            for address, name in bound(self.content[offset : offset + size], starts):
                self.pointer(address).value = self.address_of(name)

    def start(self) -> None:
        """Make room for the threads' variables and run what a module runs first."""
        if "__thread_data" in self.sections:
            raise ValueError("variables of a thread that begin with a value")
        if "__thread_bss" in self.sections:
            ctypes.c_size_t.in_dll(self.functions, "mac_thread_variables").value = self.sections["__thread_bss"].size
        if "__mod_init_func" in self.sections:
            first = self.sections["__mod_init_func"]
            for address in range(first.addr, first.addr + first.size, POINTER):
                ctypes.CFUNCTYPE(None)(self.pointer(address).value)()


class Importer:
    """Lets Python import the module as fairing._core."""

    def __init__(self, functions: Path, module: Path) -> None:
        self.files = functions, module

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> importlib.machinery.ModuleSpec | None:
        """Python asks for each module."""
        return importlib.machinery.ModuleSpec(name, self) if name == OWN else None  # type: ignore[arg-type]

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType:
        """Load it."""
        self.image = Image(*self.files)
        shown = macos_module.exported(self.image.content, self.image.header)
        entry = ctypes.PYFUNCTYPE(ctypes.c_void_p)(self.image.base + shown["_PyInit__core"])
        self.definition = ctypes.c_void_p(entry())
        create = ctypes.pythonapi.PyModule_FromDefAndSpec2
        create.restype = ctypes.py_object
        module: ModuleType = create(self.definition, ctypes.py_object(spec), C_INTERFACE)
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Fill it."""
        if ctypes.pythonapi.PyModule_ExecDef(ctypes.py_object(module), self.definition):
            raise ImportError(OWN)


if __name__ == "__main__":
    sys.meta_path.insert(0, Importer(Path(sys.argv[1]), Path(sys.argv[2])))
    sys.argv = sys.argv[3:]
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    # Python would free the module's memory before the objects whose destructors lie there.
    sys.stdout.flush()
    os._exit(status)
