"""Find out whether OpenGL works, in a process of its own: where it is missing, the renderer ends its process.

``python -m p2sf_explorer.scene3d.opengl_probe`` renders eight pixels and returns 0, or something else. No Qt in here.
"""

import os
import sys

MISSING = (
    "3D needs OpenGL, and none works here; install a driver or Mesa's software renderer "
    "(apt-get install libegl1 libgl1-mesa-dri), then open this panel again"
)
NOT_INSTALLED = "3D needs pyvista, which is not installed; run pip install pyvista, then open this panel again"
NOT_IN_BUNDLE = "3D is not in this download; take the one with 3D in its name, then open this panel again"
OPTION = "--opengl-probe"  # of the bundle, which has no Python to run this file with
WORKS, NO_LIBRARY, NO_CONTEXT = 0, 3, 4
FROZEN = getattr(sys, "frozen", False)  # in a bundle of PyInstaller's


def main() -> int:
    """Render a small picture off screen; return 0 or the code of what is missing."""
    try:
        import vtkmodules.vtkRenderingOpenGL2 as gl
        from vtkmodules.vtkRenderingCore import vtkRenderWindow
    except ImportError:
        return NO_LIBRARY
    window = vtkRenderWindow()
    if not isinstance(window, gl.vtkOpenGLRenderWindow):
        return NO_CONTEXT
    window.SetOffScreenRendering(1)
    window.SetSize(8, 8)
    window.Render()
    # Without a context there are no capabilities to report, and taking the window down would end the process.
    works = "OpenGL" in window.ReportCapabilities()
    sys.stdout.flush()
    os._exit(WORKS if works else NO_CONTEXT)


def command() -> list[str]:
    """Return the command line that runs this file in a process of its own."""
    return [sys.executable, OPTION if FROZEN else __file__]


def sentence(code: int) -> str:
    """Return what the probe's exit code means, in English; nothing where OpenGL works."""
    return {WORKS: "", NO_LIBRARY: NOT_IN_BUNDLE if FROZEN else NOT_INSTALLED}.get(code, MISSING)


if __name__ == "__main__":
    sys.exit(main())
