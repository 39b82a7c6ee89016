"""Texts in other languages, for `bpy.app.translations`. Another language is another column here.

Labels, tooltips and menu entries are looked up by Blender itself; sentences that are put together
at run time stay English.
"""

from __future__ import annotations

import bpy

_GERMAN = {
    "Fair Region": "Region glätten",
    "Before / After": "Vorher / Nachher",
    "Write Curvature Attribute": "Krümmung als Attribut schreiben",
    "Look at Selection": "Auswahl ansehen",
    "Intrinsic Fairing": "Intrinsisches Glätten",
    "Selection": "Auswahl",
    "Last Run": "Letzter Lauf",
    "Live": "Mitlaufend",
    "Live Region": "Mitlaufende Region",
    "Select Live Region": "Mitlaufende Region auswählen",
    "Forget Live Region": "Mitlaufende Region vergessen",
    "Quality Overlay": "Qualitätsanzeige",
    "Free Vertices": "Freie Vertices",
    "Outlines": "Umrisse",
    "Islands": "Inseln",
    "Factor": "Faktor",
    "Shape": "Form",
    "Bulge": "Wölbung",
    "Vertices": "Vertices",
    "Tangent To": "Tangential zu",
    "Pin Group": "Fixierte Gruppe",
    "Pin Edges": "Fixierte Kanten",
    "Inner Fairness": "Innere Glätte",
    "At the Outline": "Am Umriss",
    "Solver": "Löser",
    "Harmonic": "Harmonisch",
    "Minimal Energy": "Kleinste Energie",
    "Soap Film": "Seifenhaut",
    "Even Curvature": "Gleichmäßige Krümmung",
    "Otherwise": "Sonst",
    "Stop": "Anhalten",
    "Even": "Gleichmäßig",
    "Keep Texture": "Textur erhalten",
    "Keep Spacing": "Abstände erhalten",
    "Keep Proportions": "Proportionen erhalten",
    "Surroundings": "Umgebung",
    "Average": "Mittel",
    "Equation solved": "Gleichung gelöst",
    "Angle at the outline": "Winkel am Umriss",
    "Curvature inside": "Krümmung innen",
    "Residual": "Residuum",
    "Flipped triangles": "Umgeklappte Dreiecke",
    "Degenerate triangles": "Entartete Dreiecke",
    "Self-intersections": "Selbstdurchdringungen",
    "Texture distortion": "Texturverzerrung",
    "Reflection Lines": "Spiegellinien",
    "Mean Curvature": "Mittlere Krümmung",
    "Show Quality": "Qualität anzeigen",
    "Stripes": "Streifen",
    "Direction": "Richtung",
    "No face is selected: select the faces to be faired; vertices or edges alone don't count": (
        "Keine Fläche ausgewählt: die zu glättenden Flächen auswählen; Vertices oder Kanten allein zählen nicht"
    ),
    "No vertex is free to move: a vertex is when all its faces are selected and visible, and it is not pinned": (
        "Kein Vertex ist frei: das ist er, wenn all seine Flächen ausgewählt und sichtbar sind und er nicht fixiert ist"
    ),
    "The mesh is linked from another file: make it local first": (
        "Das Netz ist aus einer anderen Datei verknüpft: zuerst lokal machen"
    ),
    "Select faces of a mesh in edit mode": "Im Bearbeitungsmodus Flächen eines Netzes auswählen",
}

_CONTEXTS = ("*", "Operator")


def table() -> dict[str, dict[tuple[str, str], str]]:
    """Return the texts in the form that Blender asks for."""
    german = {(context, text): translation for text, translation in _GERMAN.items() for context in _CONTEXTS}
    return {"de_DE": german, "de": german}


def translated(text: str) -> str:
    """Return the text in the language of the interface."""
    found: str = bpy.app.translations.pgettext_iface(text)
    return found


def register() -> None:
    """Hand the texts to Blender."""
    bpy.app.translations.register(__package__, table())


def unregister() -> None:
    """Take them back."""
    bpy.app.translations.unregister(__package__)
