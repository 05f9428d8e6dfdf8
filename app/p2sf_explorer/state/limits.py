"""Allowed values of the entries of a State: choices, ranges, kinds. Uses no Qt."""

from math import inf

from p2sf.disc.mask import CLEAR
from p2sf.disc.zernike_terms import ORDERS
from p2sf.io.depth_files import MEANINGS
from p2sf.lens.lens import AIMS
from p2sf.messages import Message
from p2sf.parameters import CAMERA_PARAMETERS, MASK_PARAMETERS, PARAMETERS, SOURCE_PARAMETERS
from p2sf.psf.methods import AUTO, METHODS
from p2sf.tolerance.criteria import CRITERIA
from p2sf.tolerance.errors_of_build import GRADES
from p2sf_explorer.state.terms import TERMS

CHOICES = {
    "stop": ("file", "auto"),
    "aim": AIMS,
    "method": (AUTO, *(method.name for method in METHODS if method.over_frequency)),
    "psf_scale": ("linear", "sqrt", "log", "log8"),
    "psf_units": ("sum", "peak", "strehl"),
    "phase": ("waves", "contour", "surface", "wrapped"),
    "theme": ("system", "light", "dark"),
    "shown": ("a", "b", "difference", "both"),
    "rays_coloured": ("kind", "field", "wavelength"),
    "keep_focus": ("off", "paraxial", "rms"),
    "photo_show": ("lens", "sharpened", "axis", "taken", "psfs"),
    "photo_look": ("split", "side", "blink"),
    "photo_depth_meaning": MEANINGS,
    "measured_encoding": ("automatic", "srgb", "linear"),
    "rail_side": ("right", "bottom"),
    "colours": ("standard", "viridis", "cividis", "grey"),
    "matrix_what": ("psf", "spot", "ray_fan", "opd_fan", "mtf", "pupil"),
    "matrix_across": ("wavelength_nm", "depth_mm", "sensor_shift_um", "side"),
    "tolerances_grade": tuple(GRADES),
    "tolerances_criterion": CRITERIA,
    "playback_subject": ("stack", "stage", "psf", "pupil", "layout", "coefficients", "tabs"),
    "seidel_sum": ("all", "w40", "w31", "w22", "petzval", "w20", "w11", "c1", "c2"),
    "zernike_order": ORDERS,
    "database_coefficient": ("w40", "w31", "w22", "w20", "w11", "wd"),
    "database_rule": ("table1", "linear"),
    "accuracy_plot": ("here", "bytes", "time"),
    "exactness_measure": ("r2", "mtf", "r80", "hdr", "time"),
    "curves_of": (
        "fields",
        "colours",
        "field",
        "focus",
        "lateral",
        "distortion",
        "illumination",
        "transmission",
        "transmission_of_colours",
    ),
}
MOST_LISTED = 5  # values of a list
MOST_FIELDS = 12  # of curves and of the table of figures
# The smallest and the largest meaningful value, and the name and unit of the quantity in a sentence.
RANGES: dict[str, tuple[float, float, Message, str]] = {
    **{each.name: (*each.typed, each.words, each.unit) for each in PARAMETERS.values() if each.typed and each.words},
    "tolerance": (0.0, 1.0, Message("tolerance R²"), ""),
    "stage_share": (0.1, 0.95, Message("share of the stage"), ""),
    "scale_percent": (50.0, 300.0, Message("size of type"), "%"),
    "pixel_um": (0.01, 1000.0, Message("pixel"), "µm"),
    "blur_um": (0.01, 10000.0, Message("blur to tolerate"), "µm"),
    "playback_seconds": (0.1, 600.0, Message("duration of a sweep"), "s"),
    "photo_pixel_um": (0.1, 1000.0, Message("pixel of the photo"), "µm"),
    "photo_near_mm": (1.0, inf, Message("nearest depth of the photo"), "mm"),
    "photo_far_mm": (1.0, inf, Message("farthest depth of the photo"), "mm"),
    "measured_pixel_um": (0.05, 1000.0, Message("pixel of the measured picture"), "µm"),
    "photo_split": (0.0, 1.0, Message("split of the photo"), ""),
    "exaggerated": (1, 1000, Message("exaggeration of tilts and decentres"), ""),
    "rays_count": (3, 41, Message("number of rays drawn from a point"), ""),
    "lesson_step": (0, 1000, Message("step of the lesson"), ""),
    "matrix_rows": (2, MOST_LISTED, Message("number of rows"), ""),
    "matrix_columns": (2, MOST_LISTED, Message("number of columns"), ""),
    "curves_count": (2, MOST_FIELDS, Message("number of fields"), ""),
    "frequency_per_mm": (1e-3, 1e5, Message("spatial frequency"), "1/mm"),
    "tolerances_frequency_per_mm": (1e-3, 1e5, Message("spatial frequency"), "1/mm"),
    "tolerances_limit": (0.0, 1e6, Message("limit of the criterion"), ""),
    "tolerances_draw": (0, 10**6, Message("number of the draw"), ""),
    "tolerances_build": (0, 10**6, Message("number of the build"), ""),
    "camera_turn_deg": (-360.0, 360.0, Message("turn of the 3D view"), "°"),
    "camera_tilt_deg": (-89.0, 89.0, Message("tilt of the 3D view"), "°"),
    "camera_zoom": (0.2, 50.0, Message("enlargement of the 3D view"), ""),
    "camera_surface_turn_deg": (-360.0, 360.0, Message("turn of the wavefront's surface"), "°"),
    "camera_surface_tilt_deg": (0.0, 90.0, Message("tilt of the wavefront's surface"), "°"),
}
# Entries that are lists of values, and the quantity of each in RANGES.
LISTED = {
    "matrix_fields_deg": "field_deg",
    "matrix_wavelengths_nm": "wavelength_nm",
    "matrix_depths_mm": "depth_mm",
    "matrix_shifts_um": "sensor_shift_um",
    "curves_fields_deg": "field_deg",
    "curves_frequencies_per_mm": "frequency_per_mm",
}
HOLDABLE = {
    "psf": ("xy", (1e-3, 1e6)),
    "spot": ("xy", (1e-3, 1e6)),
    "ray_fan": ("y", (1e-3, 1e6)),
    "opd_fan": ("y", (1e-4, 1e6)),
}
"""Panels whose scale a state can hold: the axes that then run from −end to end, and the limits of the end.

The end is in the axes' unit, µm or waves.
"""
MOST_WAVES = 1000.0
MASK = tuple(each.name for each in MASK_PARAMETERS if each.typed)
"""Entries named as the fields of `p2sf.disc.mask.PupilMask`; None: as the lens file has it."""
# Whole numbers are those whose range is stated in whole numbers.
COUNTS = tuple(each.name for each in MASK_PARAMETERS if each.typed and isinstance(each.typed[0], int))
SMOOTH_MASK = tuple(name for name in MASK if name not in COUNTS)
CLEAR_PUPIL = {each.name: getattr(CLEAR, each.name) for each in MASK_PARAMETERS if each.typed and not each.needs}
RINGS = ("zoom", "focus_position")
"""Where the rings of a lens stand that zooms or focuses inside; None: where the file begins."""
# The source and the camera without rings and pupil mask.
SET = tuple(each.name for each in (*SOURCE_PARAMETERS, *CAMERA_PARAMETERS) if each.typed and each.name not in RINGS)
DRAGGED = (*SET, *RINGS, *SMOOTH_MASK)
SLIDERS = (*DRAGGED, *COUNTS)
LINKABLE = (*SLIDERS, "method", "added_waves", "errors")
ADDED = "added_"  # before a term's name: the slider that adds waves to it
PLAYABLE = ("", *DRAGGED, *(ADDED + term for term in TERMS))
KINDS = {str: Message("a text"), bool: Message("true or false"), int: Message("a whole number")}
OPTIONAL = ("focus_mm", "f_number", *RINGS, *MASK, "photo_pixel_um", "scale_percent", "tolerances_limit")
PLAIN: dict[str, type] = {
    "clip": bool,
    **dict.fromkeys(COUNTS, int),
    "show_pupil_shape": bool,
    "show_more": bool,
    "full_bleed": bool,
    "tab": str,
    "stage": str,
    "workspace": str,
    "show_rail": bool,
    "show_controls": bool,
    "free_pupil": bool,
    "language": str,
    "photo_source": str,
    "photo_full": bool,
    "photo_depths": str,
    "measured_picture": str,
    "measured_beside": bool,
    "lesson_name": str,
    "lesson_told": bool,
    "lesson_step": int,
    "rays_count": int,
    "exaggerated": int,
    "show_field_x": bool,
    "matrix_rows": int,
    "matrix_columns": int,
    "matrix_shared": bool,
    "curves_count": int,
    "tolerances_draw": int,
    "tolerances_build": int,
}
