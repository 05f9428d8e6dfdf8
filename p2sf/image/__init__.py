"""Space-variant image formation: a picture through a lens."""

from p2sf.image.form import Forming, form_image, plan_lattice
from p2sf.image.noise import with_noise
from p2sf.image.preview import preview
from p2sf.image.progress import Progress

__all__ = ["Forming", "Progress", "form_image", "plan_lattice", "preview", "with_noise"]
