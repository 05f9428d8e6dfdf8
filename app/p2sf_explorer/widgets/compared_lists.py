"""The fields and frequencies that curves and figures are compared at, which several panels share."""

from collections.abc import Sequence

from PySide6.QtWidgets import QWidget

from p2sf_explorer.compute.quantities import FIELD
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import MOST_FIELDS
from p2sf_explorer.state.scales import read_number
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.value_edit import ValueList

PER_MM = {"": 1.0, "/mm": 1.0, "1/mm": 1.0}


class FieldList(ValueList):
    """How many fields, or which."""

    def __init__(self, store: Store, parent: QWidget | None = None):
        super().__init__(range(2, MOST_FIELDS + 1), parent)
        self.name(tr("Fields"), FIELD.read)
        self.counted.connect(lambda count: store.update(curves_count=count, curves_fields_deg=()))
        self.listed.connect(lambda values: store.update(curves_fields_deg=values))
        self.refused.connect(store.refused)

    def show_fields(self, fields_deg: Sequence[float]) -> None:
        """Show fields in degrees."""
        self.show_values(_with_unit([f"{angle:.4g}".replace("-", "−") for angle in fields_deg], "°"))


class FrequencyList(ValueList):
    """Spatial frequencies on the sensor."""

    def __init__(self, store: Store, parent: QWidget | None = None):
        super().__init__((), parent)
        self.name(tr("At"), lambda text: read_number(text, "spatial frequency", PER_MM))
        self.listed.connect(lambda values: store.update(curves_frequencies_per_mm=values))
        self.refused.connect(store.refused)

    def show_frequencies(self, per_mm: Sequence[float]) -> None:
        """Show frequencies per mm."""
        self.show_values(_with_unit([f"{frequency:g}" for frequency in per_mm], "/mm"))


def _with_unit(texts: list[str], unit: str) -> list[str]:
    """Return texts with the unit behind the last alone."""
    return [*texts[:-1], texts[-1] + unit]
