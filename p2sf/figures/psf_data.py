"""What a point spread function is, as data: samples, scale, and how they were computed."""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, fields, replace
from typing import Any, Generic, Self, TypeVar, overload

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.figures.record import true_of_all
from p2sf.files.writing import plain
from p2sf.messages import Message

UNSTATED = Message("")

Value = TypeVar("Value")
Figure = float | np.ndarray | None
Number = float | None
Facts = Mapping[str, Any] | None
Place = tuple[float, float] | np.ndarray | None


class Later(Generic[Value]):
    """A value that is computed when it is first asked for, and once; the function is then let go.

    ``estimate``: of a value that costs as much as the picture, for warnings, which are not worth that.
    """

    def __init__(self, compute: Callable[[], Value], estimate: Callable[[], Value] | None = None) -> None:
        self._compute: Callable[[], Value] | None = compute
        self._estimate = Later(estimate) if estimate else None

    @property
    def costly(self) -> bool:
        """Return whether it costs as much as the picture and is not computed yet."""
        return self._estimate is not None and self._compute is not None

    def roughly(self) -> Value:
        """Return the estimate while it is `costly`, else the value."""
        return self._estimate() if self._estimate and self.costly else self()

    def __call__(self) -> Value:
        """Return the value. Raises what its computation raises."""
        compute = self._compute
        if compute is not None:
            self._value, self._compute = compute(), None
        return self._value

    def __deepcopy__(self, memo: dict[int, Any]) -> Value:
        """Return the value, which is plain data."""
        return deepcopy(self(), memo)


@dataclass(frozen=True, eq=False)
class PsfFigures:
    """What is read off the pupil of a PSF, and its provenance: values, or functions that are called when first read.

    During dragging few figures of a picture are shown, and some take as long as the picture. `p2sf.Psf` describes them.
    """

    strehl: Figure | Callable[[], Figure] = None
    peak_um: Place | Callable[[], Place] = None
    other_peaks: int | np.ndarray | Callable[[], int | np.ndarray] = 0
    energy: Figure | Callable[[], Figure] = None
    predicted_error: Number | Callable[[], Number] = None
    fresnel_number: Number | Callable[[], Number] = None
    plane_wave_error: Number | Callable[[], Number] = None
    provenance: Facts | Callable[[], Facts] = None

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if callable(value) and not isinstance(value, Later):
                object.__setattr__(self, name, Later(value))

    def value(self, name: str) -> Any:
        """Return one of them, which is computed now if it was not before."""
        found = getattr(self, name)
        return found() if callable(found) else found

    def __reduce__(self) -> tuple[Any, ...]:
        return PsfFigures, tuple(self.value(each.name) for each in fields(self))


UNKNOWN = PsfFigures()


class Read(Generic[Value]):
    """An attribute of `PsfData` that is one of its `PsfFigures`, of the same name."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, psf: None, owner: type) -> "Read[Value]": ...

    @overload
    def __get__(self, psf: "PsfData", owner: type) -> Value: ...

    def __get__(self, psf: "PsfData | None", owner: type) -> "Value | Read[Value]":
        if psf is None:
            return self
        found: Value = psf.figures.value(self.name)
        return found


@dataclass(frozen=True, eq=False)
class PsfData:
    """A point spread function, or a stack of them, as data; `p2sf.Psf` describes it and adds what is asked of it."""

    values: np.ndarray
    pixel_um: float
    wavelength_um: float | np.ndarray
    method: str
    figures: PsfFigures = UNKNOWN
    numbers: int = 0
    rays: int = 0
    sampling: Message = UNSTATED
    seconds: float = 0.0
    error: float | None = None
    azimuth_deg: float = 0.0
    integrated: bool = False
    sum_over_peak: float | np.ndarray | None = None
    asked_error: float | None = None

    strehl = Read[Figure]()
    peak_um = Read[Place]()
    other_peaks = Read[int | np.ndarray]()
    energy = Read[Figure]()
    predicted_error = Read[Number]()
    fresnel_number = Read[Number]()
    plane_wave_error = Read[Number]()
    provenance = Read[Facts]()

    def with_figures(self, **figures: Any) -> Self:
        """Return the same PSF with these of its `PsfFigures` in place of its own; the others stay uncomputed."""
        return replace(self, figures=replace(self.figures, **figures))

    @property
    def record(self) -> dict[str, Any]:
        """Return what a file states beside the samples: `provenance`, how they were computed, units and versions."""
        known = plain(self.provenance or {})
        beside = {name: value for name, value in true_of_all().items() if name not in known}
        return {**known, **beside, "psf": facts(self)}

    @property
    def x_um(self) -> np.ndarray:
        """Return the positions of the columns, shape (x,), µm from the chief ray."""
        return centred_axis(self.values.shape[-1], self.pixel_um)

    @property
    def y_um(self) -> np.ndarray:
        """Return the positions of the rows, shape (y,), µm from the chief ray, towards the field."""
        return centred_axis(self.values.shape[-2], self.pixel_um)


OWN = tuple(each.name for each in fields(PsfData))
FIGURES = tuple(each.name for each in fields(PsfFigures))


def facts(psf: PsfData) -> dict[str, Any]:
    """Return what a PSF says about itself but its samples, as JSON can carry it; its azimuth where it has one."""
    left_out = {"values", "figures", "provenance", *(() if psf.azimuth_deg else ("azimuth_deg",))}
    known = {name: getattr(psf, name) for name in (*OWN, *FIGURES) if name not in left_out}
    window = [psf.pixel_um * count for count in psf.values.shape[:-3:-1]]
    known |= {"sampling": str(psf.sampling), "window_um": window}
    return {name: plain(value) for name, value in known.items()}
