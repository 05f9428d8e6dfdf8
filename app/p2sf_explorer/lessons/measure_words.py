"""What the measures of lessons are called on screen. No Qt in here."""

from p2sf.messages import Message
from p2sf_explorer.lessons.claims import SLIDERS_BY_KEY

WORDS = {
    "airy_radius_um": Message("radius of the Airy disc"),
    "numerical_aperture": Message("numerical aperture"),
    "focal_length_mm": Message("focal length"),
    "image_height_mm": Message("image height"),
    "stop_surface": Message("surface of the stop"),
    "w40_waves": Message("spherical aberration W40"),
    "w31_waves": Message("coma W31"),
    "w22_waves": Message("astigmatism W22"),
    "w20_waves": Message("field curvature W20"),
    "wd_waves": Message("defocus Wd"),
    "w11_waves": Message("distortion W11"),
    "rms_waves": Message("RMS wavefront error"),
    "left_out_waves": Message("RMS that six coefficients leave out"),
    "strehl": Message("Strehl ratio"),
    "centre_over_peak": Message("intensity in the centre over the peak"),
    "radius_80_um": Message("radius of 80 % of the light"),
    "dark_ring_um": Message("radius of the first dark ring"),
    "ring_over_peak": Message("brightest ring over the peak"),
    "spikes": Message("number of spikes"),
    "spike_over_gap": Message("spikes over the gaps between them"),
    "blur_corners": Message("number of corners of the blur"),
    "centroid_y_um": Message("centroid of the light in y"),
    "spread_x_um": Message("spread of the light in x"),
    "spread_y_um": Message("spread of the light in y"),
    "contrast_tangential": Message("tangential contrast at 50/mm"),
    "contrast_sagittal": Message("sagittal contrast at 50/mm"),
    "petzval_focus_um": Message("Petzval focus behind the sensor"),
    "sagittal_focus_um": Message("sagittal focus behind the sensor"),
    "tangential_focus_um": Message("tangential focus behind the sensor"),
    "real_sagittal_focus_um": Message("sagittal focus of real rays behind the sensor"),
    "real_tangential_focus_um": Message("tangential focus of real rays behind the sensor"),
    "distortion_percent": Message("distortion"),
    "axial_colour_um": Message("focus of red behind that of blue"),
    "r_squared": Message("R² against the Huygens sum"),
    "r_squared_narrow": Message("R² against the Huygens sum in the paper's window"),
    "numbers": Message("numbers that the method keeps"),
    "rays": Message("rays that the method traces"),
    "exact_database_error_waves": Message("error of the database with exact interpolation"),
    "table1_error_waves": Message("error of the database by the paper's table 1"),
    "linear_error_waves": Message("error of the database with linear interpolation"),
    "photo_psfs": Message("PSFs of the coarse picture"),
    "sharpening_db": Message("gain of sharpening"),
}


def measure_words(name: str) -> Message:
    """Return what a measure or a slider is called, its name in files where it has no other."""
    slider = SLIDERS_BY_KEY.get(name)
    return Message(slider.title) if slider else WORDS.get(name, Message(name))
