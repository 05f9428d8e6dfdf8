"""Colorimetry: tristimulus values of a spectrum, and the colours of a screen."""

import numpy as np
from numpy.typing import ArrayLike

from p2sf.colour.spectrum import Spectrum, relative_power
from p2sf.conventions import NM_PER_UM
from p2sf.errors import RequestError

VISIBLE_UM = (0.36, 0.83)
STEP_UM = 0.001
# Lobes a·exp(−(s(λ − µ))²/2), s one of two values on either side of µ: a, µ (nm), s below and above (1/nm).
# Wyman, Sloan, Shirley, "Simple analytic approximations to the CIE XYZ color matching functions",
# Journal of Computer Graphics Techniques 2(2), 2013, listing 1.
LOBES = (
    ((0.362, 442.0, 0.0624, 0.0374), (1.056, 599.8, 0.0264, 0.0323), (-0.065, 501.1, 0.0490, 0.0382)),
    ((0.821, 568.8, 0.0213, 0.0247), (0.286, 530.9, 0.0613, 0.0322)),
    ((1.217, 437.0, 0.0845, 0.0278), (0.681, 459.0, 0.0385, 0.0725)),
)
# Linear sRGB of XYZ (IEC 61966-2-1:1999, eq. 7).
RGB_OF_XYZ = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # Y of linear sRGB (IEC 61966-2-1:1999)


def matching(wavelength_um: ArrayLike) -> np.ndarray:
    """Return x̄, ȳ, z̄ of the CIE 1931 observer as Wyman, Sloan and Shirley (2013) fit them, (…, 3)."""
    nm = np.asarray(wavelength_um, dtype=float) * NM_PER_UM
    return np.stack([np.sum([_lobe(nm, *lobe) for lobe in lobes], axis=0) for lobes in LOBES], axis=-1)


def _lobe(nm: np.ndarray, height: float, centre: float, below: float, above: float) -> np.ndarray:
    slope = np.where(nm < centre, below, above)
    lobe: np.ndarray = height * np.exp(-0.5 * (slope * (nm - centre)) ** 2)
    return lobe


def bands(spectrum: Spectrum, count: int, limits_um: tuple[float, float] = VISIBLE_UM) -> tuple[np.ndarray, np.ndarray]:
    """Return ``count`` wavelengths (µm) and the X, Y, Z that each represents, (count,) and (count, 3), ΣY = 1.

    Each is the centroid of its band and carries all light of the band, summed every nm, so that the total colour does
    not depend on the count. Lines are returned unchanged. Raises RequestError for a spectrum without visible light.
    """
    if spectrum.kind == "lines":
        wavelength = np.array(spectrum.numbers) / NM_PER_UM
        weights = np.array(spectrum.weights or (1.0,) * len(wavelength))
        return wavelength, _normalise(weights[:, None] * matching(wavelength), spectrum)
    low, high = max(limits_um[0], VISIBLE_UM[0]), min(limits_um[1], VISIBLE_UM[1])
    fine = low + (np.arange(max(1, round((high - low) / STEP_UM))) + 0.5) * STEP_UM
    light = relative_power(spectrum, fine)[:, None] * matching(fine)
    # Bands of equal Y + (X + Z)/2: most wavelengths lie where the eye is most sensitive, and some in violet and red.
    weight = np.cumsum(light @ (0.5, 1.0, 0.5))
    edges = np.searchsorted(weight, weight[-1] * np.arange(1, count) / count)
    parts = [part for part in np.split(np.arange(fine.size), edges) if part.size]
    sums = np.array([light[part].sum(0) for part in parts])
    centres = np.array([np.average(fine[part], weights=light[part].sum(1)) for part in parts])
    return centres, _normalise(sums, spectrum)


def _normalise(light: np.ndarray, spectrum: Spectrum) -> np.ndarray:
    total = light[:, 1].sum()
    if not total > 1e-6:
        raise RequestError("the spectrum {name} has no visible light; choose another", name=spectrum.name)
    shares: np.ndarray = light / total
    return shares


def tristimulus(spectrum: Spectrum) -> np.ndarray:
    """Return X, Y, Z of a spectrum, Y = 1."""
    xyz: np.ndarray = bands(spectrum, 1)[1].sum(0)
    return xyz


def chromaticity(xyz: ArrayLike) -> np.ndarray:
    """Return x and y, (…, 2), of X, Y, Z, (…, 3) (ISO/CIE 11664-3)."""
    xyz = np.asarray(xyz, dtype=float)
    xy: np.ndarray = xyz[..., :2] / xyz.sum(-1, keepdims=True)
    return xy


def linear_rgb(xyz: ArrayLike) -> np.ndarray:
    """Return linear sRGB, (…, 3), of X, Y, Z; negative where the screen has no such colour."""
    rgb: np.ndarray = np.asarray(xyz, dtype=float) @ RGB_OF_XYZ.T
    return rgb


def displayable(rgb: ArrayLike) -> np.ndarray:
    """Return linear sRGB, (…, 3), desaturated until no channel is negative: hue and luminance stay."""
    rgb = np.asarray(rgb, dtype=float)
    grey = np.maximum(rgb @ LUMINANCE, 0.0)[..., None]
    lowest = rgb.min(-1, keepdims=True)
    share = np.divide(grey, grey - lowest, out=np.ones_like(grey), where=lowest < 0)
    shown: np.ndarray = np.maximum(grey + share * (rgb - grey), 0.0)
    return shown


def linear_from_srgb(values: ArrayLike) -> np.ndarray:
    """Return linear light of sRGB values, both 0…1, shape kept (IEC 61966-2-1); float32 stays float32."""
    values = np.asarray(values)
    low = np.maximum(values, 0) / 12.92 + np.minimum(values, 0)
    linear = np.where(values <= 0.04045, low, ((np.maximum(values, 0) + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear, dtype=values.dtype)


def srgb_from_linear(values: ArrayLike) -> np.ndarray:
    """Return sRGB values of linear light, shape kept (IEC 61966-2-1); negative light stays as it is."""
    values = np.asarray(values)
    low = 12.92 * np.maximum(values, 0) + np.minimum(values, 0)
    encoded = np.where(values <= 0.0031308, low, 1.055 * np.maximum(values, 0) ** (1 / 2.4) - 0.055)
    return np.asarray(encoded, dtype=values.dtype)
