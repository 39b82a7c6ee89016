"""The engine's errors and warnings as sentences for a person in front of a mesh. Plain Python, no bpy.

The engine reports a code, elements and figures; every sentence is made here. Codes and the engine's own
numbers, those of the patch and its triangles, don't show.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

import fairing

from ..arrays.types import Ints
from .findings import Finding, Origin, found
from .words import Message, case_of, names_islands, said

# Of several islands: the figures of which the largest stands for all. Others are added.
_LARGEST = ("degrees", "load_share", "spacing", "edge", "distance", "largest_coordinate")


class MeshRefusal(fairing.MeshError):
    """A mesh that can't be faired. Reads as a sentence; `elements` are vertices of the mesh."""

    def __str__(self) -> str:
        return self.diagnostic.message


def doubled(vertices: Sequence[int]) -> MeshRefusal:
    """Return the exception for a new face with the corners of one that stays."""
    text, named = said("NONMANIFOLD_EDGE.doubles"), np.asarray(vertices, np.int32)
    return MeshRefusal(fairing.Diagnostic("NONMANIFOLD_EDGE", text, named, "vertex"))


def refusal(finding: Finding) -> MeshRefusal:
    """Return the exception for a finding."""
    text = _sentence([finding])
    vertices = finding.vertices.astype(np.int32)
    return MeshRefusal(fairing.Diagnostic(finding.code, text, vertices, "vertex", finding.figures))


@contextmanager
def in_mesh_words(origin: Origin) -> Iterator[None]:
    """Let the engine's MeshErrors speak of the mesh."""
    try:
        yield
    except fairing.MeshError as error:
        raise refusal(found(error.diagnostic, origin)) from error


@contextmanager
def in_numbers_of(named: Callable[[Ints], Ints]) -> Iterator[None]:
    """Let errors about a mesh made from another one name the other's vertices, as `named` gives them for its own."""
    try:
        yield
    except MeshRefusal as error:
        there = named(error.elements.astype(np.int64)).astype(np.int32)
        raise MeshRefusal(replace(error.diagnostic, elements=there)) from error
    except (ValueError, fairing.SolverError) as error:
        if hasattr(error, "elements"):
            error.elements = named(error.elements)
        raise


def sentences(warnings: tuple[fairing.Diagnostic, ...], origin: Origin) -> tuple[Message, ...]:
    """Return one sentence for each kind of warning, however many islands have it, in the order of their first."""
    alike: dict[str, list[Finding]] = {}
    for warning in warnings:
        finding = found(warning, origin)
        if finding.code == "NOT_CONVERGED" and "folds" in finding.figures:
            continue  # FOLDED names the faces
        alike.setdefault(case_of(finding.code, finding.figures), []).append(finding)
    return tuple(_sentence(findings) for findings in alike.values())


def _sentence(findings: Sequence[Finding]) -> Message:
    """Return the sentence for findings of one case, each of an island of its own."""
    islands, whole = len(findings), _pooled(findings)
    ends = whole.named[:2].tolist()
    fields = {"n": whole.count, "islands": islands, "first": ends[0] if ends else "", "ends": "–".join(map(str, ends))}
    key = case_of(whole.code, whole.figures)
    text = said(key, **{**whole.figures, **fields})  # figures may have such names
    return text if islands == 1 or names_islands(key) else said("of_islands", text=text, islands=islands)


def _pooled(findings: Sequence[Finding]) -> Finding:
    names = dict.fromkeys(name for finding in findings for name in finding.figures)
    figures = {
        name: (max if name in _LARGEST else sum)(finding.figures.get(name, 0.0) for finding in findings)
        for name in names
    }
    return replace(
        findings[0],
        figures=figures,
        named=np.concatenate([finding.named for finding in findings]),
        faces=np.unique(np.concatenate([finding.faces for finding in findings])),
        gone=sum(finding.gone for finding in findings),
    )
