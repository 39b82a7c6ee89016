"""Our pictures for Figs. 1, 2 and 7 to 10 of the paper; each function returns what it measured on the way."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import curved
import fairing
from blend_study import blend_study
from cases import Case, corner_case, tetrathing_case, thinned_tetrathing
from linear_bilaplacian import linear_bilaplacian
from picture_sheet import Panel, save_sheet
from polygon_mesh import FloatArray
from rasteriser import View
from shading import Look, Model, draw

PIXELS = 400
FLAT = Look("flat", 0.35)
STRIPES = Look("stripes")
FINE = Look("flat", 0.15)
BLEND_VIEW = View((0.0, 0.38, 0.0), (0.15, -0.5, 1.0), 5.0, aspect=0.9)
TETRA_VIEW = View((0.0, 0.0, 0.0), (0.55, 0.35, 1.0), 3.0)


def model_of(case: Case, points: FloatArray) -> Model:
    """The faired part alone."""
    return Model(points, case.triangles, case.surface_normals(points), np.arange(len(case.triangles)), None, case.fixed)


def original_of(case: Case) -> Model:
    """M0, uncoloured."""
    return Model(case.reference, case.triangles, case.surface_normals(case.reference), np.zeros(0, dtype=np.int64))


def scene_of(case: Case, points: FloatArray, uv: FloatArray | None = None) -> Model:
    """The head with the region at these points."""
    region = case.region
    assert region is not None
    used = np.unique(region.triangles[region.own])
    vertices = region.vertices.copy()
    vertices[used] = points
    normals = region.normals.copy()
    normals[used] = case.surface_normals(points)
    return Model(vertices, region.triangles, normals, region.own, uv, region.loop)


def figure_1(folder: Path) -> str:
    """The linear bilaplacian under two parameterisations on two meshes."""
    study = blend_study()
    fine, coarse = max(study.cases), min(study.cases)
    first: list[Panel] = [
        (draw(original_of(study.cases[fine]), BLEND_VIEW, PIXELS, FLAT), f"(a) original mesh, {fine} vertices"),
        (draw(original_of(study.cases[coarse]), BLEND_VIEW, PIXELS, FLAT), f"(b) reduced, {coarse} vertices"),
        _linear(coarse, "uniform", "(c) Δ²f = 0, uniform, reduced mesh", FLAT),
    ]
    second = [
        _linear(fine, "uniform", "(d) Δ²f = 0, uniform, original mesh", FLAT),
        _linear(fine, "uniform", "(e) the same, reflection lines", STRIPES),
        _linear(fine, "conformal", "(f) Δ²f = 0, conformal", FLAT),
    ]
    save_sheet([first, second], folder / "paper_fig1.webp")
    gap = curved.distance(
        study.cases[fine], study.linear[fine, "uniform"], study.cases[coarse], study.linear[coarse, "uniform"]
    )
    other = curved.distance(
        study.cases[fine], study.linear[fine, "uniform"], study.cases[fine], study.linear[fine, "conformal"]
    )
    skew = curved.asymmetry(study.cases[fine], study.linear[fine, "uniform"])
    return (
        f"(c) and (d) lie up to {gap:.1%} of D apart, (d) and (f) {other:.1%}; "
        f"(d) lies {skew:.1%} away from its own mirror image in the plane of the axes."
    )


def _linear(count: int, weights: str, caption: str, look: Look) -> Panel:
    study = blend_study()
    return draw(model_of(study.cases[count], study.linear[count, weights]), BLEND_VIEW, PIXELS, look), caption


def figure_2(folder: Path) -> str:
    """The same by Δ_B H = 0."""
    study = blend_study()
    fine, coarse = max(study.cases), min(study.cases)
    rows = []
    for letters, weights in (("abc", "uniform"), ("def", "conformal")):
        panels = (
            (coarse, FLAT, f"{weights}, {coarse} vertices"),
            (fine, FLAT, f"{weights}, {fine} vertices"),
            (fine, STRIPES, "reflection lines"),
        )
        row: list[Panel] = []
        for letter, (count, look, text) in zip(letters, panels, strict=True):
            model = model_of(study.cases[count], study.ours((count, weights)))
            row.append((draw(model, BLEND_VIEW, PIXELS, look), f"({letter}) {text}"))
        rows.append(row)
    save_sheet(rows, folder / "paper_fig2.webp")
    gap = curved.distance(
        study.cases[fine], study.ours((fine, "uniform")), study.cases[coarse], study.ours((coarse, "uniform"))
    )
    other = curved.distance(
        study.cases[fine], study.ours((fine, "uniform")), study.cases[fine], study.ours((fine, "conformal"))
    )
    skew = curved.asymmetry(study.cases[fine], study.ours((fine, "uniform")))
    return (
        f"(a) and (b) lie up to {gap:.2%} of D apart, (b) and (e) {other:.3%}; "
        f"(b) lies {skew:.3%} away from its own mirror image."
    )


def figure_7(folder: Path) -> str:
    """Linear start, improved start, result: regular connectivity above, sparse and irregular below."""
    study = blend_study()
    rows, words = [], []
    for name, case in (("regular", corner_case()), ("sparse", study.cases[min(study.cases)])):
        result = case.fair().vertices
        starts = {
            "linear bilaplacian": linear_bilaplacian(case, "uniform"),
            "improved start": case.fair(method="paper", levels=1, max_iterations=1).vertices,
        }
        away = [np.linalg.norm(points - result, axis=1).max() / case.diameter for points in starts.values()]
        words.append(f"{name} ({len(result)} vertices): {away[0]:.1%} and {away[1]:.1%}")
        rows.append([
            (draw(model_of(case, points), BLEND_VIEW, PIXELS, FLAT), f"{name}: {text}")
            for text, points in {**starts, "Δ_B H = 0": result}.items()
        ])  # fmt: skip
    save_sheet(rows, folder / "paper_fig7.webp")
    return f"Linear and improved start are away from the result by, in D: {'; '.join(words)}."


def figure_8(folder: Path) -> str:
    """The tetrathing with 500 and 13308 vertices."""
    coarse, fine = thinned_tetrathing(500), tetrathing_case()
    results = [case.fair() for case in (coarse, fine)]
    small, large = (model_of(case, run.vertices) for case, run in zip((coarse, fine), results, strict=True))
    row = [
        (draw(small, TETRA_VIEW, PIXELS, FLAT), f"(a) {len(coarse.vertices)} vertices"),
        (draw(large, TETRA_VIEW, PIXELS, FINE), f"(b) {len(fine.vertices)} vertices"),
        (draw(large, TETRA_VIEW, PIXELS, Look("stripes", 0.0, 12.0)), "(c) reflection lines of (b)"),
    ]
    save_sheet([row], folder / "paper_fig8.webp")
    gap = curved.distance(coarse, results[0].vertices, fine, results[1].vertices)
    return (
        f"(a) and (b) lie up to {gap:.1%} of D apart as curved surfaces; "
        f"on (b) the angle at the circles is at most {results[1].boundary_angle.max():.1f}°."
    )


def _close_up(case: Case, direction: tuple[float, float, float], margin: float) -> View:
    """The boundary fills the picture but for the margin."""
    rim = case.vertices[case.fixed]
    centre = rim.mean(axis=0)
    width = 2 * margin * np.linalg.norm(rim - centre, axis=1).max()
    return View((float(centre[0]), float(centre[1]), float(centre[2])), direction, float(width))


def figure_9(folder: Path, ear: Case) -> str:
    """The ear before, by the linear bilaplacian and by Δ_B H = 0."""
    view = _close_up(ear, (1.0, 0.05, 0.25), 1.35)
    result, linear = ear.fair(), linear_bilaplacian(ear, "uniform")
    shown = ((ear.vertices, "before"), (linear, "linear bilaplacian"), (result.vertices, "Δ_B H = 0"))
    looks = (("flat shaded", FINE), ("reflection lines", Look("stripes", 0.0, 26.0)))
    rows = [
        [(draw(scene_of(ear, points), view, PIXELS, look), f"{text}, {name}") for points, text in shown]
        for name, look in looks
    ]
    save_sheet(rows, folder / "paper_fig9.webp")
    gap = np.linalg.norm(linear - result.vertices, axis=1).max() / ear.diameter
    return (
        f"Vertices of the linear bilaplacian and ours lie up to {gap:.0%} of D apart; "
        f"our largest angle at the boundary is {result.boundary_angle.max():.1f}°."
    )


def figure_10(folder: Path, face: Case) -> str:
    """The face before and after; a checkerboard projected on the original, kept by conformal inner fairness."""
    assert face.region is not None
    view = _close_up(face, (0.45, 0.1, 1.0), 1.45)
    even, conformal = (face.fair(inner_fairness=kind).vertices for kind in ("uniform", "conformal"))
    uv = face.region.vertices[:, :2] * 14.0 / face.diameter
    checker = Look("checker")
    first = [
        (draw(scene_of(face, face.vertices), view, PIXELS, FINE), "(a) before"),
        (draw(scene_of(face, conformal), view, PIXELS, FINE), "(b) Δ_B H = 0, conformal"),
        (draw(scene_of(face, conformal), view, PIXELS, Look("stripes", 0.0, 16.0)), "(c) reflection lines"),
    ]
    second = [
        (draw(scene_of(face, points, uv), view, PIXELS, checker), text)
        for points, text in ((face.vertices, "checker, before"), (conformal, "(d) conformal"), (even, "uniform"))
    ]
    save_sheet([first, second], folder / "paper_fig10.webp")
    words = [
        f"{name} {np.median(ratio):.2f} (in 5 % of the triangles above {np.quantile(ratio, 0.95):.1f})"
        for name, ratio in (
            (kind, fairing.conformal_distortion(face.reference, points, face.triangles))
            for kind, points in (("conformal", conformal), ("uniform", even))
        )
    ]
    return f"Ratio of the stretches of the map from the original, 1 being conformal, median: {', '.join(words)}."
