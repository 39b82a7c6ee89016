"""Jobs of every kind, each from its family and a seed alone: what is selected on which mesh, and what is run on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

import scenes
import selections
from scenes import Ints, Mask, Scene

KINDS = 4  # of jobs in each family
PARTS = {
    "first": (0, 1),
    "second": (2, 3),
    "third": (4,),
    "fourth": (5, 6),
    "fifth": (7, 8),
}  # seeds; what each part was for is in judged.txt
SCANS = ("demosthenes-low-res", "boot", "skull_low_resolution", "hammer")
CHARACTERS = (
    "ict_head",
    "mh_body",
    "stuffedtoy",
    "penguin",
    "goathead",
    "cat-low-resolution",
    "scorpion_low_resolution",
)
COARSE = ("hand_lowres", "spot_low_resolution", "fish_low_resolution", "spot_control_mesh")
SOLIDS = ("wingnut", "cycloidal", "featuretype")


@dataclass(frozen=True)
class Job:
    """A mesh, the faces that are selected (f,), or the vertices where a border is; what is run, with which options."""

    scene: Scene
    chosen: Mask
    options: dict[str, Any] = field(default_factory=dict)
    rim: Ints | None = None  # where a hole is filled: its border
    face_set: tuple[Any, Any] | None = None  # of a hole: the old mesh and what was deleted, for the pictures


def filling(scene: Scene, chosen: Mask, **options: Any) -> Job:
    """Delete the faces, fill the hole."""
    open_mesh, rim = selections.border(scene, chosen)
    return Job(open_mesh, np.zeros(len(open_mesh.faces), dtype=bool), options, rim, (scene, chosen))


def _anywhere(names: tuple[str, ...], low: float, high: float, **options: Any) -> Callable[[Any, int], Job]:
    def made(rng: Any, seed: int) -> Job:
        scene = scenes.real(names[seed % len(names)])
        return Job(scene, selections.anywhere(scene, rng, low, high), options)

    return made


def _tip(names: tuple[str, ...], low: float, high: float, shift: int = 0, **options: Any) -> Callable[[Any, int], Job]:
    def made(rng: Any, seed: int) -> Job:
        scene = scenes.real(names[(seed + shift) % len(names)])
        return Job(scene, selections.tip(scene, rng, low, high), options)

    return made


def _filled(
    names: tuple[str, ...], low: float, high: float, shift: int = 0, **options: Any
) -> Callable[[Any, int], Job]:
    def made(rng: Any, seed: int) -> Job:
        scene = scenes.real(names[(seed + shift) % len(names)])
        pick = selections.tip if seed % 2 else selections.anywhere
        return filling(scene, pick(scene, rng, low, high), **options)

    return made


def limb(rng: Any, seed: int) -> Job:
    """A length of an arm or a leg, all around."""
    body = scenes.real("mh_body")
    axis, middle = ((1, -3.5), (0, 3.6), (1, -5.2), (0, 4.6))[seed]
    width = float(rng.uniform(0.5, 1.4))
    return Job(body, selections.band(body, rng, axis, middle, width))


def cut_limb(rng: Any, seed: int) -> Job:
    """All of an arm or a leg from somewhere on: a stump."""
    body = scenes.real("mh_body")
    places = selections.centres(body)
    axis, least = ((0, 3.0), (1, -4.0), (0, 4.4), (1, -2.0))[seed]
    chosen = places[:, axis] > least if axis == 0 else (places[:, 1] < least) & (places[:, 0] > 0)
    return Job(body, chosen) if seed % 2 else filling(body, chosen)


def cage(rng: Any, seed: int) -> Job:
    """A part of a monkey, as a cage or subdivided."""
    head = scenes.suzanne(seed % 3)
    return Job(head, selections.tip(head, rng, 0.12, 0.25) if seed % 2 else selections.anywhere(head, rng, 0.15, 0.3))


def dented_box(rng: Any, seed: int) -> Job:
    """A dent in a side of a box, selected generously; its edges outside, or across them."""
    solid = scenes.box(20)
    at = np.array([1.0, rng.uniform(-0.2, 0.2), (0.2, 0.25, 0.95, 1.0)[seed]])
    dented = scenes.bump(solid, at, 0.15, -0.12)
    return Job(dented, selections.ball(dented, at, 0.5))


def bevel_dent(rng: Any, seed: int) -> Job:
    """A dent beside or on a bevelled edge."""
    solid = scenes.bevelled_box(14, 0.2, 4)
    at = np.array([1.0, rng.uniform(-0.3, 0.3), (0.5, 0.95, 0.6, 0.9)[seed]])
    dented = scenes.bump(solid, at, 0.12, -0.1)
    return Job(dented, selections.ball(dented, at, 0.42))


def bevel_hole(rng: Any, seed: int) -> Job:
    """A hole beside, in or across a bevelled edge."""
    solid = scenes.bevelled_box(14, 0.2, 4)
    at = np.array([1.0, rng.uniform(-0.3, 0.3), (0.95, 0.4, 0.98, 0.7)[seed]])
    return filling(solid, selections.ball(solid, at, 0.42))


def box_hole(rng: Any, seed: int) -> Job:
    """A hole across a hard edge, or over a corner, of a box."""
    solid = scenes.box(20)
    at = ([1, 0.1, 1], [1, 1, 1], [1, -0.3, 1], [1, 0.2, 0.5])[seed]
    return filling(solid, selections.ball(solid, at, float(rng.uniform(0.3, 0.5))))


def boss(rng: Any, seed: int) -> Job:
    """A boss on a plate: the whole top around it, or a disc with it."""
    plate = scenes.box(24, (1, 1, 0.3))
    top = scenes.moved(scenes.tube(np.array([[0, 0, z] for z in (0.1, 0.35, 0.55)]), np.array([0.25, 0.25, 0.25]), 32))
    centre = rng.uniform(-0.3, 0.3, 2)
    lid = scenes.Scene(
        np.vstack([top.vertices, [[0, 0, 0.1], [0, 0, 0.55]]]),
        [
            *top.faces,
            *[[(j + 1) % 32, j, 96] for j in range(32)],
            *[[64 + j, 64 + (j + 1) % 32, 97] for j in range(32)],
        ],
    )
    whole = scenes.joined(plate, scenes.moved(lid, by=(*centre, 0)))
    places = selections.centres(whole)
    near = np.linalg.norm(places[:, :2] - centre, axis=1) < rng.uniform(0.42, 0.6)
    return Job(whole, (places[:, 2] > 0.295) & (near | (seed % 2 == 0)))


def lathe(rng: Any, seed: int) -> Job:
    """A dent in a turned part: in its side, or over the rim of its lid."""
    z = np.linspace(-1, 1, 40)
    rim = (
        np.concatenate([[0.05], np.full(40, 0.6), [0.05]])
        if seed % 2
        else 0.6 + 0.15 * np.cos(2 * np.pi * np.r_[-1, z, 1] / 2)
    )
    path = np.column_stack([np.zeros((42, 2)), np.r_[-1.001, z, 1.001] if seed % 2 else np.r_[-1.05, z, 1.05]])
    solid = scenes.tube(path, rim, 64)
    at = np.array([0.6, 0, rng.uniform(-0.3, 0.3)])
    dented = scenes.bump(solid, at, 0.12, -0.1 if seed < 2 else 0.15)
    return Job(dented, selections.ball(dented, at, 0.4))


def union(rng: Any, seed: int) -> Job:
    """A ball and a pipe joined by a boolean: what is near the seam."""
    ball = scenes.sphere(4)
    leaning, shift = rng.uniform(0, 0.6), rng.uniform(0, 0.4)
    path = np.array([[0, 0, z] for z in np.linspace(0.0, 2.2, 30)])
    pipe = scenes.tube(path, np.full(30, rng.uniform(0.25, 0.5)), 32)
    count = len(pipe.vertices)
    lids = [
        *[[(j + 1) % 32, j, count] for j in range(32)],
        *[[count - 32 + j, count - 32 + (j + 1) % 32, count + 1] for j in range(32)],
    ]
    pipe = Scene(np.vstack([pipe.vertices, path[[0, -1]]]), [*pipe.faces, *lids])
    whole = scenes.joined(ball, scenes.moved(pipe, (0, leaning, 0), (shift, 0, 0)))
    on_ball = np.abs(np.linalg.norm(whole.vertices, axis=1) - 1) < 0.012
    return Job(whole, selections.seam_band(whole, on_ball, float(rng.uniform(0.12, 0.3))), {"remesh": seed == 3})


def voxel_letter(rng: Any, _seed: int) -> Job:
    """A letter off a voxel mesh: what stands over the plate, and a rim of it."""
    plate = scenes.letter(rng)
    top = plate.vertices[:, 2] > -0.04
    from scipy.spatial import cKDTree

    near = cKDTree(plate.vertices[top][:, :2]).query(plate.vertices[:, :2])[0] < rng.uniform(0.06, 0.14)
    return Job(plate, selections.within(plate, near & (plate.vertices[:, 2] > -0.1)))


def voxel_blob(rng: Any, seed: int) -> Job:
    """A knob on a voxel mesh, or the neck between two balls."""
    first, second = scenes.sphere(3), scenes.moved(scenes.sphere(3), by=(1.2 + 0.5 * rng.random(), 0.2, 0))
    small = Scene(second.vertices[:, :] * 0.6 + np.array([0.45, 0, 0]), second.faces)
    blob = scenes.voxels(scenes.joined(first, small), 0.06)
    if seed % 2:
        return Job(blob, selections.within(blob, np.linalg.norm(blob.vertices, axis=1) > 1.08))
    return Job(blob, selections.seam_band(blob, np.linalg.norm(blob.vertices, axis=1) < 1.03, 0.25))


def neck(rng: Any, seed: int) -> Job:
    """A pipe whose upper part was moved aside: the stretch between."""
    z = np.linspace(0, 4, 60)
    pipe = scenes.tube(np.column_stack([0 * z, 0 * z, z]), 0.5 + 0.1 * np.sin(z), 40)
    aside = (0.2, 0.5, 0.35, 0.8)[seed]
    pipe.vertices[:, 0] += aside * np.clip((pipe.vertices[:, 2] - 1.6) / 0.8, 0, 1)
    places = selections.centres(pipe)[:, 2]
    return Job(pipe, np.abs(places - 2.0) < rng.uniform(0.5, 0.9))


def pipes(rng: Any, seed: int) -> Job:
    """Two tubes at an angle, bridged."""
    angle, radius = np.radians((40, 70, 25, 90)[seed]), rng.uniform(0.6, 1.0)
    z = np.linspace(0, 2, 20)
    first = scenes.tube(np.column_stack([0 * z, 0 * z, z - 3.2]), np.full(20, 0.8), 32)
    second = scenes.moved(scenes.tube(np.column_stack([0 * z, 0 * z, z + 1.2]), np.full(20, radius), 32), (0, angle, 0))
    both = Scene(
        np.vstack([first.vertices, second.vertices]),
        first.faces + [[v + len(first.vertices) for v in f] for f in second.faces],
    )
    count = len(first.vertices)
    rim = np.concatenate([np.arange(count - 32, count), count + np.arange(32)])
    return Job(both, np.zeros(len(both.faces), dtype=bool), {"bridge": True}, rim)


def elbow(rng: Any, seed: int) -> Job:
    """A bent hose with a kink, or a bump, selected all around; a tube's girth counts."""
    t = np.linspace(0, (1.6, 2.6, 1.2, 2.2)[seed], 70)
    hose = scenes.tube(np.column_stack([1.5 * np.cos(t), 1.5 * np.sin(t), 0 * t]), np.full(70, 0.5), 32)
    rings = np.repeat(np.arange(69), 32)
    width = int(rng.integers(10, 22))
    hose = scenes.bump(hose, hose.vertices[32 * 35 + 5], 0.2, 0.25)
    return Job(hose, np.abs(rings - 35) < width)


def skin(rng: Any, seed: int) -> Job:
    """A swelling on skin with pores; every other time the pores are to be kept."""
    head = scenes.sphere(6)
    at = rng.normal(size=3)
    at /= np.linalg.norm(at)
    swollen = scenes.grain(scenes.bump(head, at, 0.2, 0.15), rng, 0.09, 0.006)
    return Job(swollen, selections.ball(swollen, at, 0.55), {"detail": 1.0} if seed % 2 else {})


def fine_skin(rng: Any, seed: int) -> Job:
    """Fine grain on a bent sheet, weak or strong, with a scar across it."""
    strength = (0.0015, 0.006, 0.003, 0.01)[seed]
    cloth = scenes.grain(scenes.sheet(90, lambda x, y: 0.3 * np.cos(x + 0.4 * y)), rng, 0.12, strength)
    scarred = scenes.bump(cloth, np.array([0.1, 0, 0.3]), 0.1, 0.08)
    return Job(scarred, selections.ball(scarred, [0.1, 0, 0.37], 0.4))


def noise(rng: Any, seed: int) -> Job:
    """A ball as a rough scan has it, with a swelling."""
    ball = scenes.noisy(scenes.sphere(5), rng, (0.03, 0.12, 0.06, 0.2)[seed])
    swollen = scenes.bump(ball, np.array([0, 0, 1.0]), 0.2, 0.2)
    return Job(
        swollen, selections.ball(swollen, [0, 0, 1.0], 0.6), ({}, {"smooth_boundary": True}, {}, {"falloff": 0.2})[seed]
    )


def pins(rng: Any, seed: int) -> Job:
    """A head or a ball, three vertices of it pinned after they were pulled out or in by a tenth."""
    head = scenes.suzanne(3) if seed % 2 else scenes.sphere(5)
    centre = head.vertices.mean(axis=0)
    chosen = selections.centres(head)[:, 1] < centre[1] + 0.1
    inside = np.unique(np.concatenate([face for face, taken in zip(head.faces, chosen, strict=True) if taken]))
    places = rng.choice(inside[head.vertices[inside, 1] < centre[1] - 0.25], 3, replace=False)
    vertices = head.vertices.copy()
    pulled = 1 + 0.1 * rng.choice([-1.0, 1.0], 3)
    vertices[places] = centre + pulled[:, None] * (vertices[places] - centre)
    weights = np.isin(np.arange(len(vertices)), places).astype(float)
    return Job(Scene(vertices, head.faces, groups={"Pins": weights}), chosen, {"pin_group": "Pins"})


def pin_out(rng: Any, seed: int) -> Job:
    """One pinned vertex pulled out of a bent sheet."""
    cloth = scenes.sheet(40, lambda x, y: 0.2 * x * x - 0.1 * y)
    vertex = scenes.nearest(cloth, np.array([*rng.uniform(-0.2, 0.2, 2), 0.0]))
    cloth.vertices[vertex, 2] += (0.15, 0.4, 0.25, 0.6)[seed]
    weights = (np.arange(len(cloth.vertices)) == vertex).astype(float)
    chosen = selections.ball(cloth, cloth.vertices[vertex] * [1, 1, 0], 0.75)
    return Job(replace(cloth, groups={"Pins": weights}), chosen, {"pin_group": "Pins"})


def weighted(rng: Any, seed: int) -> Job:
    """A painted group that fades, on a character."""
    body = scenes.real(CHARACTERS[seed])
    chosen = selections.tip(body, rng, 0.05, 0.1)
    middle = selections.centres(body)[chosen].mean(axis=0)
    away = np.linalg.norm(body.vertices - middle, axis=1)
    reach = away[np.unique(np.concatenate([f for f, c in zip(body.faces, chosen, strict=True) if c]))].max()
    weights = np.clip(1.4 - away / reach, 0, 1)
    return Job(replace(body, groups={"Fade": weights}), chosen, {"vertex_group": "Fade"})


def keyed(rng: Any, seed: int) -> Job:
    """A basis with a bump, and a key shown on top of it: next to the selection, across it, inside it, far away."""
    head = scenes.sphere(5)
    swollen = scenes.bump(head, np.array([0, 0, 1.0]), 0.15, 0.2)
    at = np.array(([0.5, 0, 0.85], [0, 0.1, 1.0], [0.7, 0, 0.7], [0, 0, -1.0])[seed])
    key = scenes.bump(swollen, at, 0.25, float(rng.uniform(0.2, 0.5))).vertices
    return Job(
        replace(swollen, keys={"Basis": swollen.vertices, "Big": key}), selections.ball(swollen, [0, 0, 1.1], 0.55)
    )


def tight(rng: Any, seed: int) -> Job:
    """A bump with a selection that is too small for it, or runs over its root."""
    at, width = np.array([0, 0, 1.0]), rng.uniform(0.12, 0.2)
    ball = scenes.bump(scenes.sphere(5), at, width, (0.3, 0.3, 0.15, 0.4)[seed])
    aside = np.array([width * (1.3, 0.0, 1.5, 0.8)[seed], 0, 0])
    away = np.linalg.norm(selections.centres(ball) * [1, 1, 0] - aside, axis=1)
    chosen = (away < width * (2.2, 1.2, 2.4, 1.8)[seed]) & (selections.centres(ball)[:, 2] > 0)
    return Job(ball, chosen)


def toothed(rng: Any, seed: int) -> Job:
    """A selection whose boundary has teeth, and with faces left out."""
    scene = scenes.real(("penguin", "cat-low-resolution", "demosthenes-low-res", "stuffedtoy")[seed])
    chosen = selections.anywhere(scene, rng, 0.08, 0.12)
    return Job(scene, selections.ragged(chosen, rng, scene, (0.08, 0.2, 0.12, 0.25)[seed]))


def hill(rng: Any, seed: int) -> Job:
    """A hill of a terrain, or a flat cap: what is around decides."""
    waves = rng.uniform(0.02, 0.08)
    land = scenes.sheet(60, lambda x, y: waves * np.sin(4 * x + 1) * np.cos(3 * y) + 0.3 * np.exp(-8 * (x * x + y * y)))
    if seed % 2:
        land.vertices[:, 2] = np.minimum(land.vertices[:, 2], 0.12)  # a flat cap with a rim
    return Job(land, selections.ball(land, [0, 0, 0.2], float(rng.uniform(0.3, 0.75))))


def crease_near(rng: Any, seed: int) -> Job:
    """A badge on a panel with a crease one, two or more rings outside the selection."""
    panel = scenes.sheet(60, lambda x, y: -0.2 * x * x - 0.1 * y * y - 0.8 * np.maximum(x - 0.4, 0))
    badge = scenes.bump(panel, np.array([0, 0.05, 0]), 0.1, 0.08)
    reach = 0.4 - (1, 2, 1, 4)[seed] / 30
    places = selections.centres(badge)
    chosen = (np.abs(places[:, 0] - 0.0) < reach) & (np.abs(places[:, 1]) < 0.35)
    return Job(badge, chosen, ({}, {"continuity": "G2"}, {"falloff": 0.15}, {})[seed])


def cloth(rng: Any, seed: int) -> Job:
    """A torn border of a cloth, made fair or held."""
    piece = scenes.sheet(50, lambda x, y: 0.15 * np.sin(2 * x) * np.cos(y))
    at_border = piece.vertices[:, 1] > 0.999
    wild = rng.normal(size=(len(piece.vertices), 3)) * 0.015
    piece.vertices[at_border] += wild[at_border]
    places = selections.centres(piece)
    chosen = (places[:, 1] > 0.6) & (np.abs(places[:, 0]) < 0.6)
    return Job(piece, chosen, {"fair_open_borders": True} if seed < 3 else {})


def shaped(rng: Any, seed: int) -> Job:
    """Other shapes: soap film, minimal energy, bulge, least variation."""
    scene = scenes.real(("penguin", "ict_head", "stuffedtoy", "goathead")[seed])
    option = (
        {"continuity": "G0"},
        {"shape": "MINIMAL_ENERGY"},
        {"bulge": 0.1},
        {"shape": "LEAST_VARIATION"},
    )
    return Job(scene, selections.anywhere(scene, rng, 0.08, 0.14), option[seed])


def marked(_rng: Any, seed: int) -> Job:
    """The cases of an artist."""
    names = ("hammered_edge", "boolean_seam", "hole_over_bevel", "shown_key")
    scene, chosen, vertices = scenes.case(names[seed])
    if chosen.any():
        return Job(scene, chosen)
    return Job(scene, chosen, {}, vertices)


FAMILIES: dict[str, Callable[[Any, int], Job]] = {
    "scan": _anywhere(SCANS, 0.06, 0.16),
    "scan_tip": _tip(SCANS, 0.06, 0.12),
    "scan_feather": _anywhere(SCANS, 0.06, 0.13, falloff=0.15),
    "scan_detail": _tip(SCANS, 0.06, 0.12, detail=1.0),
    "scan_fill": _filled(SCANS, 0.06, 0.12),
    "scan_new": _tip(SCANS, 0.05, 0.1, remesh=True),
    "character": _anywhere(CHARACTERS, 0.06, 0.14),
    "character_tip": _tip(CHARACTERS, 0.05, 0.12),
    "character_more": _tip(CHARACTERS, 0.05, 0.12, shift=3),
    "character_g2": _anywhere(CHARACTERS, 0.06, 0.12, continuity="G2"),
    "character_fill": _filled(CHARACTERS, 0.05, 0.12, shift=3),
    "character_feather": _tip(CHARACTERS, 0.05, 0.1, shift=2, falloff=0.2),
    "coarse": _tip(COARSE, 0.12, 0.25),
    "coarse_fill": _filled(COARSE, 0.12, 0.22, quads=True),
    "coarse_new": _anywhere(COARSE, 0.15, 0.25, remesh=True),
    "solid": _anywhere(SOLIDS, 0.06, 0.14),
    "limb": limb, "cut_limb": cut_limb, "cage": cage, "dented_box": dented_box, "bevel_dent": bevel_dent,
    "bevel_hole": bevel_hole, "box_hole": box_hole, "boss": boss, "lathe": lathe, "union": union,
    "voxel_letter": voxel_letter, "voxel_blob": voxel_blob, "neck": neck, "pipes": pipes, "elbow": elbow,
    "skin": skin, "fine_skin": fine_skin, "noise": noise, "pins": pins, "pin_out": pin_out, "weighted": weighted,
    "keyed": keyed, "tight": tight, "toothed": toothed, "hill": hill, "crease_near": crease_near, "cloth": cloth,
    "shaped": shaped, "case": marked,
}  # fmt: skip


def names(*parts: str) -> Iterator[str]:
    """The jobs of these parts: the family and the seed."""
    seeds = [seed for part in parts for seed in PARTS[part]]
    return (f"{family}-{seed}" for family in FAMILIES for seed in seeds)


def make(name: str) -> Job:
    """The job of that name, the same each time."""
    family, seed = name.rsplit("-", 1)
    rng: Any = np.random.default_rng([list(FAMILIES).index(family), int(seed)])
    return FAMILIES[family](rng, int(seed) % KINDS)
