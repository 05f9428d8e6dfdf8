"""The set-up in space: glass with a quarter cut away, rays, the exaggerated wavefront, the PSF as a surface."""

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QProcess, QTimer
from PySide6.QtWidgets import QPushButton

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.scene3d import opengl_probe as probe
from p2sf_explorer.scene3d.scene import Scene3D
from p2sf_explorer.scene3d.widget import SceneView
from p2sf_explorer.state.scales import significant
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.readout import Readout

if TYPE_CHECKING:
    from p2sf_explorer.scene3d.renderer import Renderer

TIP = "3D: the elements up to their clear rims; the wavefront is drawn W·λ ahead of the sphere about the image point."
FILES = "Picture (*.png);;glTF scene (*.gltf);;OBJ scene (*.obj)"
PREPARING = "Preparing the 3D view; this takes some seconds, once."
FACTORS = "W × {front} along the rays · PSF × {psf} wide, height: {scale} · {wavelength} nm"
SCALES = {
    "linear": "brightness",
    "sqrt": "root of brightness",
    "log": "logarithm of brightness",
    "log8": "logarithm of brightness",
}


class SolidPanel:
    """Asks first, in a process of its own, whether OpenGL works, and loads the renderer only if it does."""

    def __init__(self, store: Store):
        self.widget, self._store = Card("3D", TIP), store
        self.view = SceneView(store, self.widget)
        self.factors = Readout(self.widget, pill=True, colour="text")
        self.save_button = QPushButton(tr("Save…"), self.widget)
        self.save_button.setObjectName("small")
        self.save_button.setToolTip(tr("Save the view as a picture, or the scene as glTF or OBJ"))
        self.save_button.clicked.connect(self._ask_save)
        self.save_button.setEnabled(False)
        self.widget.add_tool(self.save_button)
        self.widget.set_body(self.view)
        self.widget.add_footer(self.factors)
        self.process: QProcess | None = None
        self.renderer: Renderer | None = None

    @property
    def busy(self) -> bool:
        """Return whether the view is still being prepared."""
        return self.renderer is None and self.process is not None and not self.view.message_is_final

    def show(self, live: Live) -> None:
        """Show an answer, as soon as there is a renderer."""
        self.view.show_live(live)
        view: Scene3D = live.views["solid"].found
        factors = tr(
            FACTORS,
            front=f"{view.front.factor:g}",
            psf=f"{view.psf_surface.factor:g}",
            scale=tr(SCALES[live.state.display.psf_scale]),
            wavelength=significant(live.state.optics.wavelength_nm, 4),
        )
        self.factors.set_text(factors)
        if self.process is None:
            self._probe()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.view.restyle(theme)
        self.factors.restyle(theme)

    def save(self, path: str) -> bool:
        """Write the view (.png) or the scene (.gltf, .obj) and return True, or say why not."""
        try:
            if Path(path).suffix.lower() == ".png":
                self.view.save_picture(path)
            elif self.renderer:
                self.renderer.save(path)
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        self._store.said.emit(Message("Saved {name}", name=Path(path).name))
        return True

    def stop(self) -> None:
        """Free the graphics memory with the window."""
        if self.process:
            self.process.kill()
            self.process.waitForFinished()
        if self.renderer:
            self.view.set_renderer(None)
            self.renderer.close()

    def _probe(self) -> None:
        self.view.say(tr(PREPARING))
        self.process = QProcess(self.widget)
        self.process.finished.connect(self._on_probed)
        self.process.errorOccurred.connect(lambda _: self._on_probed(probe.NO_CONTEXT))
        program, argument = probe.command()
        self.process.start(program, [argument])
        QTimer.singleShot(0, load_renderer)  # while the other process asks for OpenGL

    def _on_probed(self, code: int, status: QProcess.ExitStatus = QProcess.ExitStatus.NormalExit) -> None:
        crashed = status == QProcess.ExitStatus.CrashExit
        sentence = probe.sentence(probe.NO_CONTEXT if crashed else code)
        if sentence:
            self.view.say(tr(sentence), final=True)
        else:
            QTimer.singleShot(0, self._load)

    def _load(self) -> None:
        make = load_renderer()
        if make is None:
            self.view.say(tr(probe.sentence(probe.NO_LIBRARY)), final=True)
            return
        self.renderer = make(self.view.pixels())
        self.view.set_renderer(self.renderer)
        self.save_button.setEnabled(True)

    def _ask_save(self) -> None:
        first = f"{Path(self._store.state.optics.lens).stem}.png"
        if path := ask_path(self.widget, tr("Save the 3D view"), first, tr(FILES)):
            self.save(path)


def load_renderer() -> "type[Renderer] | None":
    """Return the class of the renderer, None where its libraries are not installed; importing takes half a second."""
    try:
        from p2sf_explorer.scene3d.renderer import Renderer
    except ImportError:
        return None
    return Renderer
