"""The list of panels, with one entry that describes each panel completely. Uses no Qt."""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from p2sf.messages import Message

GROUPS = ("PSF", "Rays", "Aberrations", "Lens", "Tools")
FOLLOWS, REMAINS, OF_THE_LENS = "follows", "remains", "of the lens"


@dataclass(frozen=True)
class PanelEntry:
    """One panel, of the group of `GROUPS` among whose tabs it stands.

    ``handbook`` is the section of the theory it leads to; ``panel`` its module:class among the panels; ``view`` the
    module:function of its view in the explorer, if it has one. ``minus``: what A − B means for it, a module:function
    of two views, or why it has none; empty where `compare.comparison.difference` holds it. ``by_hand``: whether it
    follows waves added by hand, remains as it was, or shows data in which nobody expects them. ``aligned``: what it
    leaves out of a lens that is not symmetric. ``beside``: A and B stand side by side although nothing subtracts them.
    """

    group: str
    key: str
    title: str
    handbook: str
    panel: str
    view: str = ""
    minus: str | Message = ""
    by_hand: str = FOLLOWS
    aligned: Message | None = None
    beside: bool = False

    @property
    def has_two_sides(self) -> bool:
        """Return whether A and B can stand side by side; a panel that is asked for that then shows A alone."""
        return self.beside or not isinstance(self.minus, Message)


REGISTRY = (
    PanelEntry("PSF", "psf", "PSF", "4.1", "psf:PsfPanel", "compute.finer:source"),
    PanelEntry(
        "PSF",
        "profiles",
        "Profiles",
        "6.3",
        "profiles:ProfilesPanel",
        "compute.views.profiles:profiles",
        minus="compare.differences:curves",
    ),
    PanelEntry(
        "PSF", "mtf", "MTF", "6.3", "mtf:MtfPanel", "compute.views.mtf:contrast", minus="compare.differences:curves"
    ),
    PanelEntry(
        "PSF",
        "through_focus",
        "Through focus",
        "3.3",
        "through_focus:ThroughFocusPanel",
        "compute.views.through_focus:strip",
        minus="compare.differences:strips",
    ),
    PanelEntry(
        "PSF",
        "matrix",
        "Matrix",
        "6.4",
        "matrix.panel:MatrixPanel",
        "compute.matrix.pictures:matrix",
        minus=Message("This is A: fields × A | B shows the pictures of both side by side."),
    ),
    PanelEntry(
        "PSF",
        "field_map",
        "Field map",
        "1.3",
        "field_map:FieldMapPanel",
        "compute.views.field_map:field_map",
        minus=Message("This is A: the pictures of A and of B have different windows; PSF shows A − B."),
    ),
    PanelEntry(
        "PSF",
        "beside",
        "Perfect lens",
        "9.2",
        "pixels:BesidePanel",
        "compute.views.pixels:beside",
        minus=Message("This is A: here it is compared with a perfect lens."),
        beside=True,
    ),
    PanelEntry(
        "PSF",
        "colour",
        "Colour",
        "9.1",
        "colour:ColourPanel",
        "compute.views.colour:question",
        minus=Message("This is A: one colour minus another is not a colour."),
        beside=True,
    ),
    PanelEntry(
        "Rays",
        "spot",
        "Spot",
        "8.3",
        "spot:SpotPanel",
        "compute.views.rays:spots",
        minus=Message("This is A: a spot diagram has positions, not amounts, to subtract; the fans show A − B."),
        beside=True,
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Rays",
        "ray_fan",
        "Ray fan",
        "8.3",
        "fans:RayFanPanel",
        "compute.views.rays:ray_errors",
        minus="compare.differences:curves",
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Rays",
        "opd_fan",
        "OPD fan",
        "4.3",
        "fans:OpdFanPanel",
        "compute.views.rays:path_errors",
        minus="compare.differences:curves",
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Rays",
        "performance",
        "Performance",
        "6.3",
        "performance:PerformancePanel",
        "compute.views.performance:performance",
        minus=Message("This is A: B has fields of its own, whose table is there with B on screen."),
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Aberrations",
        "coefficients",
        "Coefficients",
        "3.2",
        "coefficients.panel:CoefficientsPanel",
        "compute.views.seidel:six",
        aligned=Message(
            "These are the numbers of the lens without its tilts, decentres and irregularities, not of the picture."
        ),
    ),
    PanelEntry("Aberrations", "pupil", "Pupil", "3.1", "pupil:PupilPanel"),
    PanelEntry(
        "Aberrations",
        "seidel",
        "Seidel per surface",
        "3.2",
        "seidel:SeidelPanel",
        "compute.views.seidel:per_surface",
        minus="compare.differences:surfaces",
        by_hand=REMAINS,
        aligned=Message("Of the aligned lens: its tilts, decentres and irregularities have no part in these sums."),
    ),
    PanelEntry(
        "Aberrations",
        "zernike",
        "Zernike",
        "3.4",
        "zernike:ZernikePanel",
        "compute.views.zernike:zernike",
        minus="compare.differences:terms",
    ),
    PanelEntry(
        "Aberrations",
        "field",
        "Field curves",
        "8.3",
        "field:FieldPanel",
        "compute.views.field:field_curves",
        minus="compare.differences:field",
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Aberrations",
        "chromatic",
        "Chromatic shift",
        "8.3",
        "chromatic:ChromaticPanel",
        "compute.views.chromatic:chromatic",
        minus="compare.differences:colours",
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Lens",
        "layout",
        "Layout",
        "2.2",
        "layout.panel:LayoutPanel",
        "compute.views.rays:lens_drawn",
        minus=Message("This is A: two drawings of lenses have no difference to draw."),
        beside=True,
        by_hand=OF_THE_LENS,
    ),
    PanelEntry(
        "Lens",
        "lens",
        "Table",
        "1.1",
        "lens_table.panel:LensTablePanel",
        "compute.views.lens_table:rows",
        minus=Message("This is A: it is the lens that is edited here; the strip above names what differs."),
        by_hand=OF_THE_LENS,
    ),
    PanelEntry(
        "Lens",
        "misalign",
        "Misalign",
        "8.5",
        "misalign:MisalignPanel",
        "compute.views.lens_table:misalignment",
        minus=Message("This is A: it is the lens whose build is set here; the strip above names what differs."),
        by_hand=OF_THE_LENS,
    ),
    PanelEntry(
        "Lens",
        "first_order",
        "First order",
        "2.1",
        "first_order:FirstOrderPanel",
        "compute.views.first_order:first_order",
        minus="compare.differences:tables",
        aligned=Message("Of the aligned lens: paraxial rays leave out tilts, decentres and irregularities."),
    ),
    PanelEntry(
        "Lens",
        "curves",
        "Overlays",
        "6.5",
        "overlays:OverlaysPanel",
        "compute.matrix.overlays:overlay",
        minus=Message("This is A: there are many curves already; MTF and Field show A − B."),
    ),
    PanelEntry(
        "Lens",
        "ybar",
        "y–ȳ",
        "8.4",
        "ybar:YBarPanel",
        "compute.views.ybar:ybar",
        minus=Message("This is A: the points of the diagram are surfaces, and B has different ones."),
        by_hand=OF_THE_LENS,
        aligned=Message("Of the aligned lens: paraxial rays leave out tilts, decentres and irregularities."),
    ),
    PanelEntry(
        "Lens",
        "depth_of_field",
        "Depth of field",
        "10.3",
        "depth_of_field:DepthOfFieldPanel",
        "compute.views.depth_of_field:depth_of_field",
        minus=Message("This is A: the limits of sharpness are positions, not amounts, to subtract."),
        by_hand=REMAINS,
        aligned=Message("The paraxial curve and its limits are of the aligned lens; the exact rays are not."),
    ),
    PanelEntry(
        "Lens",
        "solid",
        "3D",
        "8.1",
        "solid:SolidPanel",
        "scene3d.scene:scene",
        minus=Message("This is A: solid bodies have no difference to show."),
    ),
    PanelEntry(
        "Tools",
        "image",
        "Image",
        "10.1",
        "image.panel:ImagePanel",
        "compute.views.image:question",
        minus=Message("This is A: a photograph cannot show negative light."),
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Tools",
        "measured",
        "Measured",
        "11.3",
        "measured:MeasuredPanel",
        "compute.views.measured:question",
        minus=Message("This is A: a picture is measured beside one lens."),
        by_hand=OF_THE_LENS,
    ),
    PanelEntry(
        "Tools",
        "tolerances",
        "Tolerances",
        "8.8",
        "tolerances.panel:TolerancesPanel",
        "compute.views.tolerances:question",
        minus=Message("This is A: a build is shown as A and the designed lens as B, and both have the same yield."),
    ),
    PanelEntry(
        "Tools",
        "database",
        "Database",
        "7.1",
        "database.panel:DatabasePanel",
        "compute.views.database:question",
        minus=Message("This is A: a database belongs to one lens."),
        by_hand=REMAINS,
    ),
    PanelEntry(
        "Tools",
        "accuracy",
        "Accuracy",
        "6.1",
        "accuracy:AccuracyPanel",
        minus=Message("This is A: each lens is measured against its own rays."),
        aligned=Message(
            "Seidel is of the aligned lens; the other methods include its tilts, decentres and irregularities."
        ),
    ),
    PanelEntry(
        "Tools",
        "import",
        "Import",
        "1.1",
        "import_report:ImportReportPanel",
        "compute.views.import_report:report",
        minus=Message("This is A: it is what was read from its file."),
        by_hand=OF_THE_LENS,
    ),
)
PANELS = {entry.key: entry for entry in REGISTRY}


def resolve(path: str) -> Any:
    """Return what a module:name within the explorer names; imported when first asked for."""
    module, name = path.split(":")
    return getattr(import_module(f"p2sf_explorer.{module}"), name)


def view_of(entry: PanelEntry) -> Callable[[Any], Any] | None:
    """Return the view function of an entry, None where it has none."""
    return resolve(entry.view) if entry.view else None


def difference_of(entry: PanelEntry) -> Callable[[Any, Any], Any] | Message | None:
    """Return what subtracts two views of a panel, or why nothing does; None if results have the difference."""
    return resolve(entry.minus) if entry.minus and isinstance(entry.minus, str) else entry.minus or None
