"""The window shows a lens with surfaces that are not of revolution: every panel answers or says why it cannot."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.lens.freeform import XYPolynomial, ZernikeStandardSag
from p2sf.lens.lens import Aperture
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.state.panels import REGISTRY, view_of
from p2sf_explorer.state.state import change


@pytest.fixture(scope="module")
def text() -> str:
    """Return a Double Gauss with two weak freeform surfaces."""
    lens = replace(find_lens("double_gauss_28"), aperture=Aperture("f_number", 5.6))
    surfaces = list(lens.surfaces)
    surfaces[2] = replace(surfaces[2], shape=XYPolynomial((0, 0, 2e-4, 1e-4, -1e-4, 3e-4, 0, 0, 1e-4), 15.0))
    surfaces[6] = replace(surfaces[6], shape=ZernikeStandardSag((0, 0, 0, 1e-4, 1e-4, -1e-4, 0, 1e-4, 5e-5), 15.0))
    return lens_to_toml(replace(lens, surfaces=tuple(surfaces)))


@pytest.mark.parametrize("method", ["fitted", "auto", "seidel"])
def test_every_panel_answers(text, method):
    state = change(default_state("lens", text), field_deg=5.0, method=method)
    found = live(state, views={entry.key: view_of(entry) for entry in REGISTRY if entry.view})
    rows = found.views["lens"].found.beside
    assert [row["aspheric"].short for row in rows].count((Message("XY polynomial"),)) == 1
    assert [row["aspheric"].short for row in rows].count((Message("Zernike standard sag"),)) == 1
    if method != "seidel":
        assert np.isfinite(found.psf.values).all()
