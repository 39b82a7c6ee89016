"""Names that options had before: they go on in scripts, with a warning at the script's own line."""

from __future__ import annotations

import warnings
from typing import Any

import pytest

import meshes
from extension import module

# The same run, as it was and as it is written.
PAIRS: list[tuple[dict[str, Any], dict[str, Any]]] = [
    ({"equation": "SOAP_FILM"}, {"continuity": "G0"}),
    ({"equation": "SOAP_FILM", "continuity": "G2"}, {"continuity": "G0"}),
    ({"equation": "CONSTANT", "bulge": 0.3}, {"bulge": 0.3}),
    ({"equation": "HARMONIC", "bulge": 0.3}, {"shape": "HARMONIC"}),
    ({"equation": "MINIMAL_ENERGY"}, {"shape": "MINIMAL_ENERGY"}),
    ({"mesh": "NEW", "inner": "EVEN"}, {"remesh": True, "equal_edges": True}),
    ({"feather": 0.2}, {"falloff": 0.2}),
    ({"outline": "MENDED"}, {"smooth_boundary": True}),
    ({"open_border": "FAIRED", "otherwise": "STOP"}, {"fair_open_borders": True, "fallback": False}),
    ({"pin_edges": "SHARP", "pinned_as": "AS_IS"}, {"pin_edges": "SHARP", "fair_pinned_edges": False}),
    ({"pin_curve": "HELD"}, {"fair_pinned_edges": False}),
    ({"method": "PAPER", "tolerance": 0.01}, {"multigrid": True, "tolerance": 0.01}),
    ({"accept": "ALL", "factor_mask": "USED"}, {"allow_folds": True, "use_mask": True}),
    ({"factor_group": "Weights"}, {"vertex_group": "Weights"}),
]


def ids(pair: Any) -> str:
    return ",".join(pair) if isinstance(pair, dict) else ""


@pytest.mark.parametrize(("before", "now"), PAIRS, ids=ids)
def test_both_come_to_the_same(before: dict[str, Any], now: dict[str, Any]) -> None:
    options = module("core.options").FairOptions
    with pytest.warns(DeprecationWarning, match="fair_mesh: .* now"):
        old = options.named(before)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        new = options.named(now)
        assert options.named(new.chosen) == new
    if before != {"equation": "HARMONIC", "bulge": 0.3}:
        assert old == new
    assert options.named(old.chosen) == old
    assert (old.equation, old.continuity) == (new.equation, new.continuity)


@pytest.mark.parametrize(("before", "now"), PAIRS[:7], ids=ids)
def test_operator_moves_them_over(before: dict[str, Any], now: dict[str, Any]) -> None:
    """The redo panel shows them under the names of now, and the mesh is the same to the bit."""
    results = []
    for options in (before, now):
        obj, faces = meshes.domed_grid()
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            assert meshes.fair(obj, faces, **options) == {"FINISHED"}
        results.append(meshes.positions(obj).tobytes())
        told = [warning for warning in said if warning.category is DeprecationWarning]
        old = {*before} & {*module("core.option_table").names_before(module("core.fair_options").FAIR)}
        assert len(told) == (len(old) if options is before else 0)
        assert all(warning.filename.endswith("meshes.py") for warning in told)  # the line that has used it
        assert all(str(warning.message).startswith("bpy.ops.mesh.fair_region: ") for warning in told)
    assert results[0] == results[1]


def test_fill_and_fillet_know_theirs() -> None:
    pieces, rounding = module("core.fill_pieces"), module("core.rounding")
    with pytest.warns(DeprecationWarning, match="run_on"):
        assert pieces.FillOptions.named({"hard_edges": "IGNORED"}) == pieces.FillOptions.named({"run_on": False})
    with pytest.warns(DeprecationWarning, match="continuity='G0'"):
        assert pieces.FillOptions.named({"equation": "SOAP_FILM"}) == pieces.FillOptions.named({"continuity": "G0"})
    assert rounding.FilletOptions.named({}) == rounding.FilletOptions()


def test_a_wrong_value_is_refused_by_the_name_that_was_used() -> None:
    options = module("core.options").FairOptions
    with pytest.raises(ValueError, match="mesh: expected one of KEEP, NEW, got 'OTHER'"), pytest.warns():
        options.named({"mesh": "OTHER"})
    with pytest.raises(TypeError, match="remesh: expected True or False"):
        options.named({"remesh": "NEW"})
    with pytest.raises(TypeError, match="did you mean 'remesh'"):
        options.named({"remsh": True})


def test_defaults_of_both_sides_agree() -> None:
    """The list of options, and what the engine's side takes where nothing is said."""
    for table, options in (
        (module("core.fair_options").FAIR, module("core.options").FairOptions),
        (module("core.fill_options").FILL, module("core.fill_pieces").FillOptions),
        (module("core.fill_options").FILLET, module("core.rounding").FilletOptions),
    ):
        assert options.named({}) == options()
        assert {option.target for option in table} == {*vars(options())}


def test_command_knows_them(capsys: pytest.CaptureFixture[str]) -> None:
    parse = module("run.cli_parser").parse
    arguments = ["--object", "Grid", "--output", "x.blend"]
    with pytest.warns(DeprecationWarning, match="fair: mesh"):
        assert parse([*arguments, "--mesh", "NEW", "--feather", "0.5"]).remesh is True
    chosen = parse([*arguments, "--remesh", "--no-fallback", "--falloff", "0.25"])
    assert (chosen.remesh, chosen.fallback, chosen.falloff) == (True, False, 0.25)
    with pytest.raises(SystemExit):
        parse(["--help"])
    assert "--continuity" in capsys.readouterr().out
