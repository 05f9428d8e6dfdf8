"""The y–ȳ diagram of the present source."""

from p2sf.paraxial.ybar import YBar
from p2sf.paraxial.ybar import ybar as ybar_of
from p2sf_explorer.compute.live import Live, View


def ybar(live: Live) -> View[YBar]:
    """Return the diagram of the setup."""
    return View(ybar_of(live.setup.lens, live.setup.source, live.setup.stop, live.setup.rays))
