"""The caption of the stage: lens, field, depth, f-number, wavelength and two figures. Uses no Qt."""

from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.pupil import written_rms
from p2sf_explorer.compute.quantities import DEPTH, F_NUMBER, WAVELENGTH, Quantity
from p2sf_explorer.compute.setup import ranges
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.state import State

Parts = dict[str, str]
"""The texts by their names in `CAPTION`, numbers as English writes them; the lens by its whole title."""


def caption(live: Live) -> Parts:
    """Return the chosen parts in their order, figures to two digits; unknown ones are omitted."""
    state = live.state
    found = {
        "lens": live.setup.lens.title or live.setup.lens.name,
        "field": field_text(state),
        "depth": _text_of(DEPTH, live),
        "f_number": _text_of(F_NUMBER, live),
        "wavelength": _text_of(WAVELENGTH, live).replace(".0 nm", " nm"),
        "rms": f"RMS {written_rms(live.pupil)} λ",
        "strehl": "" if live.psf.strehl is None else f"Strehl {significant(float(live.psf.strehl), 2)}",
    }
    return {name: found[name] for name in found if found[name] and name in state.display.caption}


def without_figures(parts: Parts) -> Parts:
    """Return the parts without those that a question may ask for: RMS and Strehl ratio."""
    return {name: text for name, text in parts.items() if name not in ("rms", "strehl")}


def field_text(state: State) -> str:
    """Return the field angle, with that along x where there is one."""
    aside, up = (f"{angle:.4g}°".replace("-", "−") for angle in (state.optics.field_x_deg, state.optics.field_deg))
    return f"({aside}, {up})" if state.optics.field_x_deg else up


def _text_of(quantity: Quantity, live: Live) -> str:
    return quantity.write(quantity.shown(live.state, ranges(live.setup.prescription)))
