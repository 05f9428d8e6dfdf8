"""How many kernels the forming of a picture computes."""

from collections.abc import Iterator
from contextlib import contextmanager
from unittest import mock

from p2sf.image import form


@contextmanager
def counted_kernels() -> Iterator[list[int]]:
    """Yield a list to which each request for kernels adds their number."""
    numbers: list[int] = []
    of_nodes = form.node_kernels

    def counted(*given):
        nodes = of_nodes(*given)
        kernels_at = nodes.kernels_at

        def at(rows, columns):
            numbers.append(len(rows))
            return kernels_at(rows, columns)

        nodes.kernels_at = at
        return nodes

    with mock.patch.object(form, "node_kernels", counted):
        yield numbers
