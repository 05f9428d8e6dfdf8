"""The six coefficients by name: how each is written, what it is called, its shape over the pupil. No Qt in here."""

TERMS = ("w40", "w31", "w22", "w20", "wd", "w11")
NAMES = {"w40": "W40", "w31": "W31", "w22": "W22", "w20": "W20", "wd": "Wd", "w11": "W11"}
WORDS = {
    "w40": "spherical aberration",
    "w31": "coma",
    "w22": "astigmatism",
    "w20": "field curvature",
    "wd": "defocus",
    "w11": "distortion",
}
FORMULAS = {"w40": "ρ⁴", "w31": "ρ³ cos θ", "w22": "ρ² cos² θ", "w20": "ρ²", "wd": "ρ²", "w11": "ρ cos θ"}
FILLED = {"paraxial": "rays fill the paraxial entrance pupil", "stop": "rays fill the real stop"}
PUPIL_AXES = {
    "paraxial": ("ξ, pupil radii", "η, pupil radii (towards the field)"),
    "stop": ("ξ, stop radii", "η, stop radii (towards the field)"),
}
PLACES = {"paraxial": "place in the entrance pupil, pupil radii", "stop": "place in the stop, stop radii"}
