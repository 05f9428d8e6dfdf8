"""What the entries of a State may be: choices, ranges, kinds. No Qt in here."""

from math import inf

from p2sf_explorer.state.terms import TERMS

CHOICES = {
    "stop": ("file", "auto"),
    "method": ("auto", "seidel", "fitted", "traced", "huygens"),
    "psf_scale": ("linear", "sqrt", "log"),
    "psf_units": ("sum", "peak", "strehl"),
    "phase": ("waves", "contour", "surface", "wrapped"),
    "theme": ("system", "light", "dark"),
    "shown": ("a", "b", "difference"),
    "photo_show": ("lens", "sharpened", "axis"),
    "colours": ("standard", "viridis", "cividis", "grey"),
}
# Smallest and largest value that can mean something, and how a sentence writes the quantity.
RANGES = {
    "depth_mm": (1e-3, inf, "source depth", "mm"),
    "focus_mm": (1e-3, inf, "focus distance", "mm"),
    "sensor_shift_um": (-1e6, 1e6, "sensor shift", "µm"),
    "field_deg": (-89.0, 89.0, "field angle", "°"),
    "wavelength_nm": (100.0, 20000.0, "wavelength", "nm"),
    "f_number": (0.2, 1000.0, "f-number", ""),
    "tolerance": (0.0, 1.0, "tolerance R²", ""),
    "pixel_um": (0.01, 1000.0, "pixel", "µm"),
    "blur_um": (0.01, 10000.0, "blur to tolerate", "µm"),
    "play_seconds": (0.1, 600.0, "duration of a sweep", "s"),
    "photo_pixel_um": (0.1, 1000.0, "pixel of the photo", "µm"),
    "photo_split": (0.0, 1.0, "split of the photo", ""),
    "lesson_step": (0, 1000, "step of the lesson", ""),
    "eye_turn_deg": (-360.0, 360.0, "turn of the 3D view", "°"),
    "eye_tilt_deg": (-89.0, 89.0, "tilt of the 3D view", "°"),
    "eye_near": (0.2, 50.0, "enlargement of the 3D view", ""),
    "relief_turn_deg": (-360.0, 360.0, "turn of the wavefront's surface", "°"),
    "relief_tilt_deg": (0.0, 90.0, "tilt of the wavefront's surface", "°"),
}
MOST_WAVES = 1000.0
DRAGGED = ("depth_mm", "field_deg", "wavelength_nm", "focus_mm", "sensor_shift_um", "f_number")
LINKABLE = (*DRAGGED, "method", "added_waves")
ADDED = "added_"  # before a term's name: the slider that adds waves to it
PLAYABLE = ("", *DRAGGED, *(ADDED + term for term in TERMS))
KINDS = {str: "a text", bool: "true or false", int: "a whole number"}
OPTIONAL = ("focus_mm", "f_number", "photo_pixel_um")
PLAIN = {"language": str, "photo": str, "lesson": str, "lesson_told": bool, "lesson_step": int}
