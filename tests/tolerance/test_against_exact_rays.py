"""What one error adds to the RMS of the worst field, against rays of the referee's own through the iris as it is."""

import numpy as np
import pytest

from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.tolerance.builds import by_form
from p2sf.tolerance.criteria import harms
from p2sf.tolerance.differentials import differentials, usual_sources
from p2sf.tolerance.errors_of_build import GRADES, Tolerance, build
from p2sf.tolerance.files import back_focus, with_compensators
from p2sf.tolerance.single import form_errors, sensitivities
from tests.support.depths import RELAYS_MM
from tests.support.pupil_sums import LostRays
from tests.support.rays.perturbed_rays import harm
from tests.support.tiers import in_tiers
from tests.support.tolerances import exact_quality

RELATIVE = 1e-4  # of the harm
ROUNDING = 1e-8  # waves, of the referee's sphere about a pupil 20 m away
UNEVEN = 5e-4  # the same of irregularities, which the referee adds to first order in their height
FORM = 2e-3  # the same of the quadratic form, of a small error of a lens with much aberration


@pytest.mark.slow
def test_one_error_at_a_time():
    lens = find_lens("cooke_triplet")
    errors = (
        Tolerance("thickness", 3, 0.05),
        Tolerance("radius", 6, 0.1),
        Tolerance("index", 1, 5e-4),
        Tolerance("decentre_y", 3, 0.03),
        Tolerance("tilt_x", 3, 0.017),
        Tolerance("irregularity", 4, 0.5),
    )
    sources = usual_sources(lens, Source(wavelength_um=lens.reference_wavelength_um))
    listed, places = with_compensators(errors, (back_focus(lens),))
    found = harms(sensitivities(differentials(lens, sources, listed), places), "rms_waves", places)
    for one, value in zip(errors, found, strict=False):
        rel = UNEVEN if one.kind == "irregularity" else RELATIVE
        assert harm(lens, sources, one) == pytest.approx(value, rel=rel), one


@pytest.mark.parametrize(
    ("name", "surface"), in_tiers([("achromat_f6", 1), ("double_gauss_28", 7)], [("achromat_f6", 1)])
)
def test_an_irregularity_that_is_refocused(name, surface):
    """It bends rays, and so changes what a shift of the sensor does: 1 to 2 % of the harm."""
    lens = find_lens(name)
    one = Tolerance("irregularity", surface, 0.5)
    sources = usual_sources(lens, Source(wavelength_um=lens.reference_wavelength_um))
    listed, places = with_compensators((one,), (back_focus(lens),))
    found = harms(sensitivities(differentials(lens, sources, listed), places), "rms_waves", places)
    assert harm(lens, sources, one) == pytest.approx(found[0], rel=UNEVEN)


def told(name, *errors):
    """Return what errors add, by exact rays, and what the quadratic form says; the referee's arguments."""
    lens = find_lens(name)
    sources = usual_sources(lens, Source(wavelength_um=lens.reference_wavelength_um))
    listed, places = with_compensators(errors, (back_focus(lens),))
    known = differentials(lens, sources, listed)
    alone, form = sensitivities(known, places), by_form(known, places)
    exact = harms(alone, "rms_waves", places)
    return exact, exact + form_errors(form, alone, "rms_waves", places), lens, sources


@pytest.mark.parametrize(
    ("kind", "surface", "amount"),
    in_tiers([("thickness", 6, 0.05), ("radius", 3, 0.1), ("index", 2, 5e-4)], [("radius", 3, 0.1)]),
)
def test_an_object_at_a_finite_depth_stays_where_it_is(kind, surface, amount):
    """Errors move the entrance pupil of a nearly telecentric lens by metres; a field angle there was another object."""
    lens, one = find_lens("telecentric_relay"), Tolerance(kind, surface, amount)
    sources = usual_sources(lens, Source(RELAYS_MM["telecentric_relay"], wavelength_um=lens.reference_wavelength_um))
    listed, places = with_compensators((one,), (back_focus(lens),))
    known = differentials(lens, sources, listed)
    true = harm(lens, sources, one)
    assert harms(sensitivities(known, places), "rms_waves", places)[0] == pytest.approx(
        true, rel=RELATIVE, abs=ROUNDING
    )
    assert harms(by_form(known, places), "rms_waves", places)[0] == pytest.approx(true, rel=FORM, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "surface", "off"), in_tiers([("phone_f28", 3, 0.1), ("tessar", 2, -0.03)], [("tessar", 2, -0.03)])
)
def test_an_error_beyond_the_quadratic_form_is_of_exact_rays(name, surface, off):
    """The form said 0.336 waves for 0.269, without a word."""
    one = Tolerance("thickness", surface, 0.05)
    exact, form, lens, sources = told(name, one)
    assert exact[0] == pytest.approx(harm(lens, sources, one), rel=RELATIVE)
    assert abs(form[0] / exact[0] - 1) > abs(off) and (form[0] > exact[0]) == (off > 0)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "kind", "surface"), [("phone_f28", "decentre_y", 4), ("petzval", "thickness", 2)])
def test_a_wavefront_that_is_steep_at_the_rim_has_as_many_rays_as_it_needs(name, kind, surface):
    """With 16 × 40 rays the phone's decentre is 2e-4 off. Of the Petzval's rays none are lost, near the rim at 7°."""
    one = Tolerance(kind, surface, GRADES["precision"]["decentre_x" if kind == "decentre_y" else kind])
    exact, _, lens, sources = told(name, one)
    assert exact[0] == pytest.approx(harm(lens, sources, one), rel=RELATIVE)


@pytest.mark.slow
def test_the_form_takes_tilts_along_the_frequencies_of_the_perturbed_lens():
    """At 30° the phone's image lies far from its chief ray: a percent of its radius made 0.9 % of the harm too much."""
    one = Tolerance("radius", 2, 0.1)
    _, form, lens, sources = told("phone_f28", one)
    assert form[0] == pytest.approx(harm(lens, sources, one), rel=FORM)


def test_an_error_that_loses_rays_has_no_figure():
    """The form said 5.88 waves."""
    one = Tolerance("decentre_y", 3, 0.03)
    exact, _, lens, sources = told("phone_f28", one)
    assert np.isnan(exact[0])
    with pytest.raises(LostRays):
        harm(lens, sources, one)


def test_tilts_of_the_sensor_are_set_by_exact_rays_too():
    """Setting them again from elsewhere changes nothing."""
    lens = find_lens("cooke_triplet")
    sources = usual_sources(lens, Source(wavelength_um=lens.reference_wavelength_um))
    focus, tilt = back_focus(lens), Tolerance("tilt_x", 7, 0.05)
    listed, places = with_compensators((Tolerance("tilt_x", 3, 0.1),), (focus, tilt))
    found = sensitivities(differentials(lens, sources, listed), places)
    best = found.errors[0]

    def mean_square(errors):
        quality = exact_quality(build(lens, listed, errors), sources)[0]
        return float((quality**2).sum())

    least = mean_square(best)
    assert np.sqrt(least) == pytest.approx(np.linalg.norm(found.rms_waves[0]), rel=1e-3)
    for place, step in zip(places, (0.002, 0.005), strict=True):
        for sign in (1, -1):
            moved = best.copy()
            moved[place] += sign * step
            assert mean_square(moved) > least
