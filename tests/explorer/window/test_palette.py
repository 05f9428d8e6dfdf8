"""Ctrl+K: sixty things that a person types, and what has to come first."""

import pytest

from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.window.commands.command_palette import full_name, rank, typing_errors

FIRST_WORDS = {
    "mtf": "Panel: MTF",
    "psf": "Panel: PSF",
    "spot": "Panel: Spot",
    "zernike": "Panel: Zernike",
    "performance": "Panel: Performance",
    "overlays": "Panel: Overlays",
    "tolerances": "Panel: Tolerances",
    "misalign": "Panel: Misalign",
    "layout": "Panel: Layout",
    "matrix": "Panel: Matrix",
    "image": "Panel: Image",
    "3d": "Panel: 3D",
    "ray fan": "Panel: Ray fan",
    "field map": "Panel: Field map",
    "through focus": "Panel: Through focus",
    "first order": "Panel: First order",
    "seidel": "Panel: Seidel per surface",
    "report": "Files: Report as PDF, HTML or JSON…",
    "pdf": "Files: Report as PDF, HTML or JSON…",
    "film": "Sweep: Film of the sweep…",
    "present": "View: Present: the stage on the full screen, or back (Esc)",
    "lesson list": "Lessons: List of lessons…",
    "make lesson": "Lessons: Make a lesson of this…",
    "undo": "Steps: Undo",
    "autofocus": "Lens: Autofocus: best RMS wavefront",
    "dark": "Theme: Dark",
    "german": "Language: Deutsch",
    "grey": "Colours: Grey",
    "pin b": "Compare: Pin what is on screen as B, or take B away",
    "clear pupil": "Lens: Clear pupil: no obscuration, blades, vanes, apodisation or cubic phase",
}
PARTS_AND_DESCRIPTIONS = {
    "coma": "Lesson: Coma",
    "distortion": "Lesson: Distortion",
    "what is a psf": "Lesson: What a point spread function is",
    "spectacles": "Lesson: Hubble's mirror and its spectacles",
    "zoom": "Lens: Zoom lens 3×, 20 to 60 mm",
    "phone": "Lens: Phone camera lens f/2.8, 3.6 mm",
    "plastic aspheres": "Lens: Phone camera lens f/2.8, 3.6 mm",
    "human eye": "Lens: Navarro wide-angle schematic eye, 543 nm",
    "fewest elements": "Lens: Cooke triplet, f/5, 50 mm, 40 degree field",
    "menisci": "Lens: Periskop-type symmetric lens, f/11, 100 mm",
    "floating": "Lens: Macro lens f/3.8, 60 mm, with floating focus",
    "cassegrain": "Lens: Cassegrain telescope f/10, 200 mm",
    "hubble": "Lens: Hubble Space Telescope as built, f/24",
    "microscope": "Lens: Microscope objective 10×, NA 0.25",
    "telephoto": "Lens: Telephoto f/5.6, 127 mm",
}
MISTYPED = {
    "zernicke": "Panel: Zernike",
    "perfomance": "Panel: Performance",
    "telephto": "Lens: Telephoto f/5.6, 127 mm",
    "dubble gauss": "Lens: Double Gauss, 28 degree field, f/3, 100 mm",
    "cook triplet": "Lens: Cooke triplet, f/5, 50 mm, 40 degree field",
    "tolerences": "Panel: Tolerances",
}
GERMAN = {
    "bericht": "Dateien: Bericht als PDF, HTML oder JSON …",
    "lektionen": "Lernen: Liste der Lektionen …",
    "koma": "Lektion: Koma",
    "leistung": "Ansicht: Leistung",
    "rückgängig": "Schritte: Rückgängig",
    "film": "Durchlauf: Film des Durchlaufs …",
    "dunkel": "Aussehen: Dunkel",
    "performance": "Ansicht: Leistung",
    "spiegelteleskop": "",
}


def first(window, sought: str) -> str:
    """Return the name of what stands first in the palette."""
    commands = window.commands.everything()
    names = [full_name(command) for command in commands]
    english = [f"{command.group}: {command.title}" for command in commands]
    further = [command.further for command in commands] * 2
    found = rank(sought, [*names, *english], further)
    return names[found[0] % len(names)] if found else ""


@pytest.mark.parametrize(("sought", "expected"), [*(FIRST_WORDS | PARTS_AND_DESCRIPTIONS | MISTYPED).items()])
def test_what_is_typed_finds_what_is_meant(window, sought, expected):
    assert first(window, sought) == expected


@pytest.fixture(scope="module")
def german(only_window) -> dict[str, str]:
    """Return what stands first for each query in a German window."""
    set_language("de")
    only_window.teaching._lessons = {}
    try:
        return {sought: first(only_window, sought) for sought in GERMAN}
    finally:
        set_language("en")
        only_window.teaching._lessons = {}


@pytest.mark.parametrize(("sought", "expected"), [*GERMAN.items()])
def test_german_words_find_what_is_meant(german, sought, expected):
    assert german[sought] == expected


def test_there_are_sixty_queries():
    assert len(FIRST_WORDS) + len(PARTS_AND_DESCRIPTIONS) + len(MISTYPED) + len(GERMAN) >= 60


@pytest.mark.parametrize(
    ("one", "other", "errors"),
    [
        ("coma", "coma", 0),
        ("coma", "koma", 1),
        ("coma", "cmoa", 1),
        ("coma", "com", 1),
        ("", "abc", 3),
        ("ab", "cd", 2),
    ],
)
def test_typing_errors_are_counted_both_ways(one, other, errors):
    assert typing_errors(one, other) == typing_errors(other, one) == errors
