"""Space-variant image formation: a picture through a lens."""

from p2sf.image.exposure import expose, raw_numbers
from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.preview import preview
from p2sf.image.progress import Progress

__all__ = ["Forming", "Progress", "expose", "form_image", "plan_lattice", "preview", "raw_numbers"]
