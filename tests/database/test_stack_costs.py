"""The count of products follows the pupil samples that a sum really takes, and the order of chunks follows it."""

from itertools import combinations, product
from math import inf

import pytest

from p2sf.database.files.stack_work import StackProgress, StackWork
from p2sf.database.files.stack_write import write_stack
from p2sf.database.render import fine_sampling
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.seidel_stack import stack_parts
from p2sf.psf.seidel_sum import shape_terms
from p2sf.pupil.cost import separable_products
from tests.database.test_stack import SAMPLING, small

ROUNDED = (1 + 1 / 8) ** 2  # counts of rows and of columns are rounded up to four significant bits


def summed(c, pixels, pixel_um) -> float:
    """Return the products of one PSF from the nodes of its sum."""
    ((_, rows),) = stack_parts(shape_terms(c).reshape(1, 5), pixels, pixel_um, "settled")
    quarter_rows, quarter_columns = rows.weight.shape
    half = pixels // 2 + 1  # samples from the chief ray to one side
    return 4 * quarter_rows * half * (quarter_columns + half)  # real and imaginary; even and odd in y


@pytest.mark.parametrize(("pixels", "pixel_um"), [(32, 0.5), (64, 1.0), (129, 2.0)])
@pytest.mark.parametrize(("depth_mm", "field"), [(inf, 0.0), (inf, 0.25), (20_000.0, 0.1), (3_000.0, 0.2)])
def test_the_products_are_those_of_the_rows_and_columns_that_are_summed(depth_mm, field, pixels, pixel_um):
    c = coefficients(find_lens("double_gauss_28"), depth_mm, field, 0.55)
    assert 1 <= summed(c, pixels, pixel_um) / float(separable_products(c, pixels, pixel_um)) <= ROUNDED


def test_the_costliest_chunks_come_first(tmp_path):
    """No chunk takes more than one before it, but for the counts' rounding."""
    stack = write_stack(*small(), tmp_path / "a.zarr", SAMPLING, StackProgress(cancelled=lambda: True))
    work, database = StackWork(stack, stack.missing, StackProgress()), stack.stored.database
    assert sorted(work.chunks) == stack.chunks
    fine = fine_sampling(SAMPLING, stack.grid) if stack.grid else stack.sampling
    true = []
    for chunk in work.chunks:
        axes = database.space.depths_mm, database.space.field_slopes, database.space.wavelengths_um
        points = product(*(axis[part].tolist() for axis, part in zip(axes, stack.region(chunk), strict=True)))
        true.append(sum(summed(database.coefficients(*point), fine.pixels, fine.pixel_um) for point in points))
    assert max(true) > 1.05 * min(true)
    assert all(later <= ROUNDED * earlier for earlier, later in combinations(true, 2))
