"""A report has the library's figures in every form, opens again what it is of, and is written whole or not at all."""

import json
import re
import zlib
from html import unescape

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.errors import Cancelled, P2SFError
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.setting import Request, set_up
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.report.contents import LensReport, report_of, requested_state
from p2sf_explorer.report.writing import html_report, report_record, write_report
from p2sf_explorer.state.link import state_of_link
from p2sf_explorer.state.state import change
from tests.long.crash import small_disk
from tests.support.tiers import in_tiers

FIELDS = (0.0, 12.0)


@pytest.fixture(scope="module")
def report() -> LensReport:
    state = requested_state("tessar", Request(f_number=5.6, wavelength_nm=550.0))
    return report_of(change(state, curves_fields_deg=FIELDS))


def expected() -> p2sf.NamedArrays:
    camera = p2sf.Camera("tessar", f_number=5.6)
    return camera.at(field_deg=FIELDS, wavelength_nm=550.0).performance()


def test_the_figures_are_the_librarys_to_the_last_digit(report):
    found, told = expected(), report_record(report)["performance"]
    for name in ("rms_waves", "radius_80_um", "distortion", "illumination", "lateral_colour_um"):
        np.testing.assert_allclose(told[name], found[name], rtol=1e-12, err_msg=name)
    np.testing.assert_allclose(told["strehl"], found["strehl"], rtol=1e-9)
    np.testing.assert_allclose(told["tangential"], found["tangential"], rtol=1e-12)


def test_the_table_of_the_page_shows_the_same_digits(report):
    found, page = expected(), html_report(report)
    rows = [re.findall(r"<td>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", page)]
    rows = [row for row in rows if len(row) == 11]
    for number, row in enumerate(rows):
        contrasts = [f"{found[s][number, k]:.3f}" for k in (0, 1) for s in ("sagittal", "tangential")]
        figures = [f"{found['rms_waves'][number]:.3f}", f"{found['strehl'][number]:.3f}", *contrasts]
        behind = [f"{100 * found['illumination'][number]:.1f}", f"{found['lateral_colour_um'][number]:+z.2f}"]
        assert row[1:7] == figures
        assert row[9:] == [text.replace("-", "−") for text in behind]
    assert len(rows) == len(FIELDS)


def test_a_report_says_what_is_misaligned_by_the_file_or_by_errors_of_the_build():
    decentre = (("decentre_y", 3, 4, 0.2),)
    found = report_of(change(requested_state("cooke_triplet", Request()), errors=decentre, curves_fields_deg=FIELDS))
    words = "before surface 3: axes decentred by (0, 0.2, 0) mm and tilted by (0, 0, 0)°"
    assert words in report_record(found)["misalignment"] and words in unescape(html_report(found))


def test_the_page_needs_nothing_beside_it_and_its_link_opens_the_lens_again(report):
    page = html_report(report)
    assert not re.findall(r'(?:src|href)="(?!data:)', page)
    link = unescape(re.search(r'class="link">(.*?)<', page)[1])
    again = state_of_link(link)
    assert paraxial_setup(again).lens == report.lens
    assert again.optics.wavelength_nm == 550.0 and again.curves.fields_deg == FIELDS


def test_what_the_window_has_no_control_for_is_part_of_the_lens_of_the_link():
    request = Request(obscuration=0.2, obscuration_x=0.1, depth_mm=5000.0, field_deg=3.0)
    state = requested_state("tessar", request)
    own = set_up(p2sf.load_lens("tessar"), request)
    assert lens_to_toml(paraxial_setup(state).lens) == lens_to_toml(own.lens)
    assert (state.optics.depth_mm, state.optics.field_deg) == pytest.approx((5000.0, 3.0), rel=1e-15)


@pytest.mark.parametrize("language", in_tiers(["en", "de"], ["de"]))
def test_the_pdf_has_four_pages_of_a4(report, tmp_path, language):
    set_language(language)
    try:
        write_report(report, tmp_path / "page.pdf", WINDOW)
    finally:
        set_language("en")
    document = (tmp_path / "page.pdf").read_bytes()
    assert document.startswith(b"%PDF-")
    boxes = re.findall(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", document)
    assert len(boxes) == 4
    for box in boxes:
        assert [float(side) for side in box] == pytest.approx([595.3, 841.9], abs=1.0)  # A4 in points, ISO 216
    assert len(re.findall(rb"/Subtype\s*/Image", document)) >= 2 * len(FIELDS)
    drawn = b"".join(inflated(part) for part in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", document, re.DOTALL))
    assert drawn.count(b" l\n") > 200, "outlines and rays are lines"


def inflated(stream: bytes) -> bytes:
    try:
        return zlib.decompress(stream)
    except zlib.error:
        return b""


def test_what_cannot_be_written_is_a_sentence_and_the_old_file_stays(report, tmp_path):
    with pytest.raises(P2SFError, match="unknown"):
        write_report(report, tmp_path / "page.doc")
    with pytest.raises(P2SFError):
        write_report(report, tmp_path / "no" / "page.html")
    old = tmp_path / "page.json"
    old.write_bytes(b"old")
    with small_disk(2000), pytest.raises(P2SFError, match="cannot be written"):
        write_report(report, old)
    assert (list(tmp_path.iterdir()), old.read_bytes()) == ([old], b"old")


def test_it_tells_how_much_is_done_and_can_be_stopped():
    told: list[float] = []
    with pytest.raises(Cancelled):
        report_of(requested_state("singlet_f6", Request()), told.append, lambda: bool(told))
    assert told and told == sorted(told) and told[-1] < 1


@pytest.mark.slow
def test_a_part_that_cannot_be_has_its_reason_in_its_place():
    found = report_of(requested_state("phone_f28", Request(field_deg=30.0)))  # at 30° its pupil folds
    assert found.performance.reasons
    assert str(found.performance.reasons[0]) in html_report(found)


def test_the_command_prints_the_table_and_writes_the_file(capsys, tmp_path):
    assert main(["report", "tessar", "--fields-deg", "0", "12", "--f-number", "5.6", "--wavelength-nm", "550"]) == 0
    printed = capsys.readouterr().out
    assert f"{expected()['rms_waves'][1]:.3f}" in printed
    path = tmp_path / "report.json"
    assert main(["report", "singlet_f6", "--fields-deg", "0", "-o", str(path)]) == 0
    assert json.loads(path.read_text())["performance"]["field_deg"] == [0]
    assert main(["report", "singlet_f6", "-o", str(tmp_path / "report.doc")]) == 2
