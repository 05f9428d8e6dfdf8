"""`p2sf nodes`: what it prints is what the library finds, and bad input is a sentence."""

import numpy as np
import pytest

from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml


@pytest.fixture
def bad(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text(lens_to_toml(displaced(find_lens("cassegrain_f10"), 2, 2, Placement(0.08, 0.2))), encoding="utf-8")
    return path


def test_nodes_lie_along_the_decentre(answer, bad):
    found = answer("nodes", bad, "--fields", 3, "--wavelength-nm", 587.5618)
    (node,) = found["coma_nodes_deg"]
    assert np.array(found["coma_waves"]).shape == (3, 3, 2)
    x, y = found["third_order"]["coma_node_deg"]
    assert node == pytest.approx([x, y], rel=0.05) and x / y == pytest.approx(0.4, rel=1e-3)
    moves = {(row["kind"], *row["surfaces"]): row for row in found["sensitivities"]}
    per_mm = moves["decentre_y", 2, 2]["coma_node_deg"]
    assert per_mm == pytest.approx([0.0, 5 * y], rel=0.01, abs=1e-3)


def test_a_person_reads_a_table(said, refused, bad):
    shown = said("nodes", bad, "--fields", 3)
    assert "coma, exact rays" in shown and "decentre x, per mm" in shown
    assert "--fields is 2" in refused("nodes", bad, "--fields", 2)
