"""The functions of ``import p2sf``; each imports the modules that it needs when it is first called.

These functions take degrees and nanometres; inside, slopes and micrometres are used (`p2sf.conventions`). An astropy
quantity is converted to the unit that the name of its parameter ends in.

``camera`` is a `Camera`, and a keyword by the name of one of its numbers, such as ``f_number``, sets that number alone.
"""

import os
from typing import TYPE_CHECKING, Literal

from p2sf.arguments import check_arguments
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.setting import AS_IN_FILE, AimChoice, CameraData, StopChoice, set_up_source, with_camera
from p2sf.threads import using_threads

if TYPE_CHECKING:
    from p2sf.psf.result import Psf

Path = str | os.PathLike[str]
Method = Literal["auto", "seidel", "fitted", "traced", "huygens", "spherical", "gaussian"]
PupilMethod = Literal["auto", "seidel", "fitted", "traced", "huygens", "spherical"]


@check_arguments
def load_lens(name_or_path: Path) -> Lens:
    """Load a shipped lens or a lens file.

    Parameters
    ----------
    name_or_path : str or path
        The name of a shipped lens, such as "double_gauss_28" (``p2sf lenses`` lists them), or a file of P2SF (TOML),
        Zemax, CODE V, OSLO, ray-optics, ray-optics-web, Optiland, DeepLens, ISET, the Optical Bench or a renderer, a
        patent's prescription or a CSV table; the content decides which.

    Returns
    -------
    Lens
        The prescription, frozen.

    Raises
    ------
    LensFileError
        If the name is neither a shipped lens nor a file, if the file cannot be read, or if no catalogue has one of its
        glasses; the message names the line.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.load_lens("double_gauss_28")
    <Lens double_gauss_28: 11 surfaces, stop_semi_diameter 10.5673, aim stop>
    """
    from p2sf.lensfile.library import find_lens

    return find_lens(name_or_path)


@check_arguments
@with_camera
def render(
    lens: Lens,
    source: Source | None = None,
    method: Method = "auto",
    *,
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: Literal["settled", "preview"] = "settled",
    min_r2: float = 0.99,
    clip: bool = False,
    integrated: bool | None = None,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
    threads: int | None = None,
) -> "Psf":
    """Compute the point spread function of one source.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    source : Source, optional
        The point source; by default on the axis, at the distance of the lens's object, of its reference wavelength.
    method : {"auto", "seidel", "fitted", "traced", "huygens", "spherical", "gaussian"}
        How the PSF is computed; "auto" takes the cheapest method whose predicted R² is at least ``min_r2``.
    pixels : int
        Samples along each side.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    quality : {"settled", "preview"}
        Converged (relative L2 error of the sum at most 1e-4), or fast.
    min_r2 : float
        Smallest R² against the exact reference that "auto" accepts.
    clip : bool
        Stop rays at every clear semi-diameter, not only at the aperture stop.
    integrated : bool, optional
        Whether a sample is the light on the pixel around it; by default where pixels are wider than λ/(4 NA).
    camera : Camera
        How the camera is set; by default as the lens file has it. The keywords ``focus_mm``, ``sensor_shift_um``,
        ``f_number``, ``stop`` and ``aim`` set one of its numbers each.
    threads : int, optional
        For a sum of many rays; by default P2SF_THREADS or the number of cores. No result depends on it.

    Returns
    -------
    Psf
        Samples with unit sum, rows towards the field. A ``P2SFWarning`` says where the window holds too little light,
        but not of a "preview" whose samples are too far apart to tell.

    Raises
    ------
    RequestError, GeometryError, GlassError, SamplingError
        For an invalid value or one stated twice; a lens that forms no image of this source; a wavelength outside the
        data of a glass; a grid too coarse or too large for the PSF.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> p2sf.render(lens, p2sf.Source(field_deg=10), camera=p2sf.Camera(focus_mm=3000, f_number=5.6)).method
    'spherical'
    """
    from p2sf.psf.methods import PsfOptions
    from p2sf.psf.pixel_integrals import render_setup
    from p2sf.psf.result import warn_of_window

    setup = set_up_source(lens, source, camera)
    with using_threads(threads):
        options = PsfOptions(quality, min_r2, clip)
        psf = render_setup(setup, method, pixels, pixel_um, options, integrated)
    return warn_of_window(psf, 5)
