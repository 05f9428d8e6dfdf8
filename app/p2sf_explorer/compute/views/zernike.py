"""The wavefront that makes the picture as Zernike terms, in both orders."""

from dataclasses import dataclass

import numpy as np

from p2sf.disc.zernike_terms import ORDERS, ZernikeOrder, zernike_terms
from p2sf.messages import Message, Number
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.pupil.wavefront_map import RAYS
from p2sf.pupil.zernike_fit import USUAL_TERMS, ZernikeFit, decompose, path_waves, pupil_opd
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.views.first_order import NONE, Row
from p2sf_explorer.state.scales import with_sign


@dataclass(frozen=True)
class ZernikeView:
    """The terms by order, "noll" and "fringe", of "exact rays", the "six coefficients" or a "what-if"."""

    fits: dict[ZernikeOrder, ZernikeFit]
    kind: str


def zernike(live: Live) -> View[ZernikeView]:
    """Return the terms of the wavefront over the part of the pupil that passes light (handbook 3.4)."""
    lens, source, counts = live.setup.lens, live.setup.source, RAYS[live.quality]
    if live.pupil.kind == "exact rays":
        nodes, waves = pupil_opd(lens, source, live.state.optics.clip, counts)
    else:
        nodes = pupil_nodes(lens, source, counts)
        waves = np.asarray(wavefront(live.setup.coefficients, nodes.xi, nodes.eta))
        waves -= path_waves(mask_seen(lens, source), source, nodes)
    fits = {order: decompose(nodes, waves, order, zernike_terms(order, USUAL_TERMS)) for order in ORDERS}
    return View(ZernikeView(fits, live.pupil.kind))


def rows(fit: ZernikeFit) -> tuple[Row, ...]:
    """Return name, value and degree of the terms that are even in ξ, and of others that a misaligned lens has."""
    found = zip(fit.terms, fit.waves.tolist(), fit.share.tolist(), strict=True)
    return tuple(
        (
            term.name,
            Message(
                "Z{number}: {waves} λ · {share}", number=term.number, waves=_waves(waves), share=_share(term.n, part)
            ),
            f"n = {term.n}, m = {term.m}".replace("-", "−"),
        )
        for term, waves, part in found
        if term.even or waves
    )


def _waves(waves: float) -> Number:
    return Number(with_sign(waves, 4))


def _share(n: int, part: float) -> Message:
    """Return a share in percent; piston and tilt have none."""
    return NONE if n < 2 else Message("{percent:.1f} %", percent=100 * part)


def csv_rows(fit: ZernikeFit) -> list[list[str]]:
    """Return every term as a row: number, n, m, name, waves, share of the variance without piston and tilt."""
    found = zip(fit.terms, fit.waves.tolist(), fit.share.tolist(), strict=True)
    body = [[str(t.number), str(t.n), str(t.m), t.name, f"{waves:.9g}", f"{share:.9g}"] for t, waves, share in found]
    unit = "waves RMS" if fit.basis == "noll" else "waves peak"
    return [[f"{fit.basis} term", "n", "m", "name", unit, "share of variance"], *body]
