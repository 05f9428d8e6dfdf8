"""What the image panel tells of a plan: how many PSFs, and each decision in a sentence. No Qt in here."""

from p2sf.scene import Plan
from p2sf_explorer.results.photos import cut_away

SEEN = 0.005  # of a photo's side: less is a pixel or two


def count_words(made: Plan) -> tuple[str, str]:
    """Return how many PSFs make the picture, and the product that it is."""
    rows, columns = made.counts
    waves = sum(len(colour.wavelengths_um) for colour in made.colours)
    twins = made.scene.sensor.centred and rows * columns > 1
    once = (-(-rows // 2)) * (-(-columns // 2)) if twins else rows * columns
    text = f"{rows} × {columns} places × {waves} wavelengths"
    many = f"{once * waves} PSFs"
    return many, f"{text}, mirror images for nothing" if twins and once < rows * columns else text


PLAIN = {  # in the order they are told
    "field": "Places",
    "colour": "Colour",
    "rung": "Method",
    "terms": "Phase",
    "sampling": "Sampling",
    "depth": "Depths",
    "pupils": "Pupils",
}


def plan_words(made: Plan) -> tuple[tuple[str, str], ...]:
    """Return every decision of a plan as (what, sentence); rings of the field that agree are told once."""
    found: dict[tuple[str, str, str], list[float]] = {}
    for decision in made.decisions:
        kind, _, which = decision.what.partition(" ")
        name = f"{PLAIN[kind]} {which}" if kind == "colour" else PLAIN[kind]
        found.setdefault((name, decision.choice, decision.why), []).append(decision.error)
    rows = [(name, f"{choice}: {why} (error {max(errors):.1g})") for (name, choice, why), errors in found.items()]
    order = list(PLAIN.values())
    rows.sort(key=lambda row: order.index(row[0].split(" ")[0]))
    verdict = "keeps" if made.meets else "does not keep"
    saved = made.naive.kernel_seconds / made.cost.kernel_seconds
    kept = f"{made.predicted_error:.2g} relative, {verdict} {made.scene.relative_tolerance:g}"
    promise = f"{kept}; the full grid takes {saved:.0f} times as long"
    return (("Error", promise), *rows)


def frame_words(photo: str, shape: tuple[int, int]) -> tuple[str, str]:
    """Return what becomes of a photo of other proportions than the sensor's, in short and in a sentence; RequestError.

    Nothing where all of it is taken.
    """
    for share, side, ends in zip(cut_away(photo, shape), ("height", "width"), ("top and bottom", "sides"), strict=True):
        if share > SEEN:
            why = f"The sensor has {shape[1]} × {shape[0]} pixels and the photo other proportions"
            long = f"{why}, so that it fills the frame and its {ends} are cut off, {100 * share:.0f} % of its {side}."
            return f"{ends} of the photo cut off", long
    return "", ""
