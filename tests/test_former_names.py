"""A file of version 0.2 is read by the names that it has."""

import numpy as np

import p2sf
from p2sf.figures.psf_data import facts
from p2sf.psf.reading import psf_from


def test_a_file_with_a_former_field_is_read():
    known = facts(p2sf.render(p2sf.load_lens("landscape"), method="seidel", pixels=8))
    del known["error"]
    assert psf_from(np.ones((8, 8)), known | {"tolerance": 1e-4}).error == 1e-4
