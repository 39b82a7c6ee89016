"""What a module for macOS shows, binds and signs: parts of Mach-O that macholib leaves as bytes.

`content` is the whole file, `header` macholib's view of its only architecture.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterator
from typing import Any

from macholib import mach_o
from macholib.MachO import MachOHeader

DEFINED, STAB = 0x0E, 0xE0  # masks of a symbol's n_type
CODE_DIRECTORY, SHA256 = 0, 2
DYNAMIC_LOOKUP = 0xFE


def command(header: MachOHeader, number: int) -> Any:
    """Return the load command of a number, None where there is none."""
    return next((data for load, data, _ in header.commands if load.cmd == number), None)


def variable_length(content: bytes, at: int) -> tuple[int, int]:
    """Return a number in LEB128 and where the next one begins."""
    value = shift = 0
    while True:
        value |= (content[at] & 0x7F) << shift
        shift += 7
        at += 1
        if content[at - 1] < 0x80:
            return value, at


def names_in_trie(trie: bytes, node: int = 0, prefix: bytes = b"") -> Iterator[str]:
    """Yield the names below a node of the export trie, where the system looks for them."""
    size, at = variable_length(trie, node)
    if size:
        yield prefix.decode()
    at += size
    children, at = trie[at], at + 1
    for _ in range(children):
        end = trie.index(0, at)
        edge = trie[at:end]
        child, at = variable_length(trie, end + 1)
        yield from names_in_trie(trie, child, prefix + edge)


def exported(content: bytes, header: MachOHeader) -> set[str]:
    """Return the names that other modules can find."""
    info = command(header, mach_o.LC_DYLD_INFO_ONLY)
    return set(names_in_trie(content[info.export_off : info.export_off + info.export_size]))


def binds_weakly(content: bytes, header: MachOHeader) -> bool:
    """True where the system picks one of several modules' definitions of a name."""
    info = command(header, mach_o.LC_DYLD_INFO_ONLY)
    return any(content[info.weak_bind_off : info.weak_bind_off + info.weak_bind_size])


def names_left_in(symbols: list[tuple[Any, bytes]], shown: set[str]) -> set[str]:
    """Return names of what is defined and not shown."""
    return {(name or b"").decode() for symbol, name in symbols if symbol.n_type & (DEFINED | STAB)} - shown


def asked_of_all(symbols: list[tuple[Any, bytes]]) -> set[str]:
    """Return names that any loaded module may bring, not a certain library."""
    undefined = [(symbol, name) for symbol, name in symbols if not symbol.n_type & (DEFINED | STAB)]
    return {name.decode() for symbol, name in undefined if symbol.n_desc >> 8 & 0xFF == DYNAMIC_LOOKUP}


def is_signed(content: bytes, header: MachOHeader) -> bool:
    """True where every page hashes to what the signature says; Apple's own processors load nothing else."""
    place = command(header, mach_o.LC_CODE_SIGNATURE)
    if place is None:
        return False
    start = place.dataoff
    (count,) = struct.unpack_from(">I", content, start + 8)
    parts = dict(struct.iter_unpack(">2I", content[start + 12 : start + 12 + 8 * count]))
    directory = start + parts[CODE_DIRECTORY]
    fields = struct.unpack_from(">9I4B", content, directory)
    hashes, slots, end, length, kind, page = (fields[index] for index in (4, 7, 8, 9, 10, 12))
    pages = [content[at : min(at + (1 << page), end)] for at in range(0, end, 1 << page)]
    found = b"".join(hashlib.sha256(part).digest() for part in pages)
    said = content[directory + hashes : directory + hashes + slots * length]
    return kind == SHA256 and end == start and found == said
